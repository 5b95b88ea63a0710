/// Packets through a world: planes, the top level, and the soups it places.
#pragma once

#include "accel/resolve_packet.h"

namespace trg::TRG_ISA {

/// Fewer rays than these enter another space one by one.
constexpr int kLeastEntering = 6;

/// Whether packets can be of use in the world.
TRG_FN bool takes_packets(const WorldIndex& index) {
    return index.triangle_test == TriangleTest::watertight && index.accel == AccelKind::bvh &&
           !index.placements.empty();
}

/// Ray k by itself through a placement.
template <bool kAny>
TRG_FN void search_alone(const Placement& placement, int k, RayPacket& packet,
                         PacketSearch& search) {
    const TracedRay& ray = lane_ray(packet, k);
    if constexpr (kAny) {
        if (placement_hides<CornerBlock>(placement, ray, search.t[k])) search.live &= ~(1u << k);
    } else {
        search_placement<CornerBlock>(placement, ray, search.ray[k]);
        search.t[k] = search.ray[k].t;
    }
}

/// Makes a packet of the rays of `among` in the space of a placed soup; the other rays of it are
/// copies of one of these. False when they do not go together there.
TRG_FN bool enter_placement(const Placement& placement, const RayPacket& packet, uint32_t among,
                            RayPacket& local) {
    Ray rays[kPacketRays];
    const int first = lowest_bit(among);
    for (int k = 0; k < kPacketRays; ++k) {
        const int from = (among >> k) & 1 ? k : first;
        const ExactRay ray = exact_ray(packet, from);
        rays[k].origin = rounded(point_into(placement.into, ray.origin_d));
        rays[k].direction = rounded(vector_into(placement.into, ray.direction_d));
        rays[k].t_min = packet.t_min[from];
        rays[k].t_max = packet.t_max[from];
    }
    return make_packet(rays, nullptr, reach_of(placement.soup->bounds), local);
}

/// The packet, itself or made in `local`, that walks a placement; null where rays go alone.
TRG_FN RayPacket* walker_of(const Placement& placement, RayPacket& packet, uint32_t among,
                            RayPacket* local) {
    if (!takes_packets(*placement.soup)) return nullptr;
    if (placement.identity) return &packet;
    if (placement.key_count > 0 || count_bits(among) < kLeastEntering) return nullptr;
    return enter_placement(placement, packet, among, *local) ? local : nullptr;
}

/// Searches a placement with the rays of `among`.
template <bool kAny>
TRG_FN void search_placement(const Placement& placement, RayPacket& packet, uint32_t among,
                             PacketSearch& search) {
    RayPacket local;
    RayPacket* const walker = walker_of(placement, packet, among, &local);
    if (walker && !kAny)
        for (Search& ray : search.ray) ray.current = &placement;
    if (walker) return search_soup<kAny>(*placement.soup, *walker, among, search);
    for (uint32_t left = among; left; left &= left - 1)
        search_alone<kAny>(placement, lowest_bit(left), packet, search);
    if (!kAny) shorten(search);
}

/// What a packet does in the top level.
template <bool kAny>
struct WorldVisit {
    const WorldIndex& index;
    RayPacket& packet;
    PacketSearch& search;

    void leaf(uint32_t k, uint32_t rays) const {
        search_placement<kAny>(index.placements[k], packet, rays, search);
    }
    /// Each ray walks the subtree by itself.
    void alone(NodeRef ref, uint32_t rays) const {
        for (uint32_t left = rays; left; left &= left - 1) walk_one(ref, lowest_bit(left));
        if (!kAny) shorten(search);
    }
    void walk_one(NodeRef ref, int k) const {
        const NodeTest<QuickBoxTest> test(bounds_of(lane_ray(packet, k)));
        float limit = search.t[k] * kFarFactor;
        walk_nodes<!kAny>({index.top.nodes.data(), ref}, test, &limit, [&](uint32_t leaf) {
            search_alone<kAny>(index.placements[leaf], k, packet, search);
            limit = search.t[k] * kFarFactor;
            return kAny && !((search.live >> k) & 1);
        });
    }
};

template <bool kAny>
TRG_FN void search_world(const WorldIndex& index, RayPacket& packet, PacketSearch& search) {
    for (const Placement& plane : index.unbounded)
        search_placement<kAny>(plane, packet, search.live, search);
    if (index.placements.size() == 1)
        return search_placement<kAny>(index.placements[0], packet, search.live, search);
    walk_packet<!kAny>(whole_of(index.top), packet, search.live, search,
                       WorldVisit<kAny>{index, packet, search});
}

TRG_FN void start_search(const RayPacket& packet, PacketSearch& search) {
    search.live = kWholePacket;
    for (int k = 0; k < kPacketRays; ++k) search.t[k] = packet.t_max[k];
    shorten(search);
}

/// Traces kPacketRays rays together (`times` may be null); false, with nothing done, when they do
/// not go together.
TRG_APART_FN bool closest_hits(const WorldIndex& index, const Ray* rays, const float* times,
                               Hit* hits) {
    RayPacket packet;
    if (!may_go_together(rays) || !make_packet(rays, times, index.reach, packet)) return false;
    PacketSearch search;
    start_search(packet, search);
    for (int k = 0; k < kPacketRays; ++k) search.ray[k] = start_search(packet.t_max[k]);
    search_world<false>(index, packet, search);
    resolve_hits(search, packet, hits);
    return true;
}

/// Likewise for any hits.
TRG_APART_FN bool are_hidden(const WorldIndex& index, const Ray* rays, const float* times,
                             uint8_t* hidden) {
    RayPacket packet;
    if (!may_go_together(rays) || !make_packet(rays, times, index.reach, packet)) return false;
    PacketSearch search;
    start_search(packet, search);
    search_world<true>(index, packet, search);
    for (int k = 0; k < kPacketRays; ++k) hidden[k] = !((search.live >> k) & 1);
    return true;
}

}  // namespace trg::TRG_ISA

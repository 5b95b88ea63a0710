/// Tracing of batches of rays; compiled once per instruction set.
#include "accel/kernels.h"
#include "accel/trace_packet.h"
#include "accel/trace_stream.h"
#include "accel/trace_world.h"

namespace trg::TRG_ISA {

/// The only soup of a world without instances, when packets can walk it; else null.
TRG_FN const Soup* packet_soup(const WorldIndex& index) {
    if (index.placements.size() != 1 || !index.unbounded.empty()) return nullptr;
    if (!index.placements[0].identity) return nullptr;
    const Soup& soup = *index.placements[0].soup;
    return takes_packets(soup) ? &soup : nullptr;
}

TRG_FN Hit resolve_hit(const Search& search, const ExactRay& ray) {
    if (search.prim < 0) return no_hit();
    const Barycentrics at =
        coordinates_of(*static_cast<const CornerBlock*>(search.block), search.lane, ray);
    const PrimOrigin origin = origin_of(*search.placement, search.prim);
    if (!(search.t < HUGE_VALF)) return no_hit();
    return {search.t, at.u, at.v, origin.triangle, origin.instance};
}

TRG_FN void start_search(const RayPacket& packet, PacketSearch& search) {
    search.live = kWholePacket;
    for (int k = 0; k < kPacketRays; ++k) search.t[k] = packet.t_max[k];
    shorten(search);
}

/// Traces kPacketRays rays together; false, with nothing done, when they do not go together.
TRG_FN bool closest_hits(const WorldIndex& index, const Soup& soup, const Ray* rays, Hit* hits) {
    RayPacket packet;
    if (!make_packet(rays, reach_of(soup.bounds), packet)) return false;
    PacketSearch search;
    start_search(packet, search);
    for (int k = 0; k < kPacketRays; ++k) {
        search.ray[k] = start_search(packet.t_max[k]);
        search.ray[k].current = index.placements.data();
    }
    search_soup<false>(soup, packet, kWholePacket, search);
    for (int k = 0; k < kPacketRays; ++k)
        hits[k] = resolve_hit(search.ray[k], exact_ray(packet, k));
    return true;
}

/// Likewise for any hits.
TRG_FN bool are_hidden(const Soup& soup, const Ray* rays, uint8_t* hidden) {
    RayPacket packet;
    if (!make_packet(rays, reach_of(soup.bounds), packet)) return false;
    PacketSearch search;
    start_search(packet, search);
    search_soup<true>(soup, packet, kWholePacket, search);
    for (int k = 0; k < kPacketRays; ++k) hidden[k] = !((search.live >> k) & 1);
    return true;
}

/// The nearest hits of a batch.
template <class Block>
struct ClosestQuery {
    static constexpr bool kAny = false;
    const WorldIndex& index;
    const Ray* rays;
    Hit* hits;

    void alone(int k) const { hits[k] = closest_hit<Block>(index, rays[k]); }
    bool together(const Soup& soup, int k) const {
        return closest_hits(index, soup, rays + k, hits + k);
    }
    bool test(const Placement& placement, StreamRay<Block>& ray) const {
        search_placement<Block>(placement, ray.world, ray.search);
        return false;
    }
    bool test(const Block& block, StreamRay<Block>& ray) const {
        test_closest(block, *ray.traced, ray.search);
        return false;
    }
    void finish(const StreamRay<Block>& ray, bool) const {
        hits[ray.number] = resolve_hit<Block>(ray.search, ray.world, ray.scale);
    }
};

/// Whether anything hides the rays of a batch.
template <class Block>
struct AnyQuery {
    static constexpr bool kAny = true;
    const WorldIndex& index;
    const Ray* rays;
    uint8_t* hidden;

    void alone(int k) const { hidden[k] = is_hidden<Block>(index, rays[k]); }
    bool together(const Soup& soup, int k) const { return are_hidden(soup, rays + k, hidden + k); }
    bool test(const Placement& placement, StreamRay<Block>& ray) const {
        return placement_hides<Block>(placement, ray.world, ray.search.t);
    }
    bool test(const Block& block, StreamRay<Block>& ray) const {
        return test_any(block, *ray.traced, ray.search.t);
    }
    void finish(const StreamRay<Block>& ray, bool met) const { hidden[ray.number] = met; }
};

/// Packets where rays go together; the others in turns where the world is large, else one by one.
template <class Block, class Query>
TRG_FN void trace_batch(const Query& query, int count) {
    const Soup* const soup = packet_soup(query.index);
    const bool streams = takes_streams(query.index);
    int waiting[kMostWaiting];
    int waiters = 0;
    for (int k = 0; k < count;) {
        const int end = count - k < kPacketRays ? count : k + kPacketRays;
        if (soup && end - k == kPacketRays && query.together(*soup, k)) {
            k = end;
            continue;
        }
        for (; k < end; ++k)
            if (streams)
                waiting[waiters++] = k;
            else
                query.alone(k);
        if (waiters > kMostWaiting - kPacketRays) {
            trace_stream<Block>(query, waiting, waiters);
            waiters = 0;
        }
    }
    trace_stream<Block>(query, waiting, waiters);
}

TRG_FN float time_of(const RayBatch& batch, int k) {
    return batch.times ? batch.times[k] : kMiddleTime;
}

template <class Block>
TRG_FN void trace_closest(const WorldIndex& index, const RayBatch& batch, Hit* hits) {
    if (!index.moving)
        return trace_batch<Block>(ClosestQuery<Block>{index, batch.rays, hits}, batch.count);
    for (int k = 0; k < batch.count; ++k)
        hits[k] = closest_hit<Block>(index, batch.rays[k], time_of(batch, k));
}

template <class Block>
TRG_FN void trace_any(const WorldIndex& index, const RayBatch& batch, uint8_t* hidden) {
    if (!index.moving)
        return trace_batch<Block>(AnyQuery<Block>{index, batch.rays, hidden}, batch.count);
    for (int k = 0; k < batch.count; ++k)
        hidden[k] = is_hidden<Block>(index, batch.rays[k], time_of(batch, k));
}

TRG_FN void find_closest(const WorldIndex& index, const RayBatch& batch, Hit* hits) {
    if (index.triangle_test == TriangleTest::classic)
        trace_closest<PlaneBlock>(index, batch, hits);
    else
        trace_closest<CornerBlock>(index, batch, hits);
}

TRG_FN void find_any(const WorldIndex& index, const RayBatch& batch, uint8_t* hidden) {
    if (index.triangle_test == TriangleTest::classic)
        trace_any<PlaneBlock>(index, batch, hidden);
    else
        trace_any<CornerBlock>(index, batch, hidden);
}

Kernels trace_kernels() {
    return {find_closest, find_any};
}

}  // namespace trg::TRG_ISA

/// Packets of rays through a world.
#pragma once

#include "accel/trace_world.h"
#include "accel/walk_packet.h"

namespace trg::TRG_ISA {

/// Whether packets can walk the soup: a tree over corners.
TRG_FN bool takes_packets(const Soup& soup) {
    return soup.accel == AccelKind::bvh && !soup.corner_blocks.empty() && soup.tree.root != kNoNode;
}

/// The largest extent of the box: what origins that lie close are small against.
TRG_FN float reach_of(const Bounds& box) {
    const Vec3 size = box.hi - box.lo;
    return std::fmax(size.x, std::fmax(size.y, size.z));
}

/// What a packet does in the tree of a soup. `kAny`: whether any hit will do.
template <bool kAny, bool kOneOrigin>
struct SoupVisit {
    const CornerBlock* blocks;
    const WideNode* nodes;
    RayPacket& packet;
    PacketSearch& search;

    /// The rays test the block.
    TRG_INLINE_METHOD void leaf(uint32_t k, uint32_t rays) const {
        const CornerBlock& block = blocks[k];
        if (count_bits(rays) >= kLeastTesters) {
            if constexpr (kAny)
                test_any<kOneOrigin>(block, packet, rays, search);
            else
                test_closest<kOneOrigin>(block, packet, rays, search);
        } else {
            for (uint32_t left = rays; left; left &= left - 1) test_one(block, lowest_bit(left));
        }
        if constexpr (!kAny) shorten(search);
    }
    TRG_INLINE_METHOD void test_one(const CornerBlock& block, int k) const {
        const TracedRay& ray = lane_ray(packet, k);
        if constexpr (kAny) {
            if (trg::TRG_ISA::test_any(block, ray, search.t[k])) search.live &= ~(1u << k);
        } else {
            trg::TRG_ISA::test_closest(block, ray, search.ray[k]);
            search.t[k] = search.ray[k].t;
        }
    }
    /// Each ray walks the subtree by itself.
    void alone(NodeRef ref, uint32_t rays) const {
        for (uint32_t left = rays; left; left &= left - 1) walk_one(ref, lowest_bit(left));
        if constexpr (!kAny) shorten(search);
    }
    void walk_one(NodeRef ref, int k) const {
        const TracedRay& ray = lane_ray(packet, k);
        const NodeTest<QuickBoxTest> test(bounds_of(ray));
        if constexpr (kAny) {
            const float limit = search.t[k] * kFarFactor;
            const bool met =
                walk_nodes<false>({nodes, ref}, test, &limit, [&](uint32_t leaf) TRG_INLINE_METHOD {
                    return trg::TRG_ISA::test_any(blocks[leaf], ray, search.t[k]);
                });
            if (met) search.live &= ~(1u << k);
        } else {
            Search& one = search.ray[k];
            walk_nodes<true>({nodes, ref}, test, &one.limit, [&](uint32_t leaf) {
                trg::TRG_ISA::test_closest(blocks[leaf], ray, one);
                return false;
            });
            search.t[k] = one.t;
        }
    }
};

template <bool kAny, bool kOneOrigin>
TRG_FN void search_soup(const Soup& soup, RayPacket& packet, uint32_t among, PacketSearch& search) {
    const SoupVisit<kAny, kOneOrigin> visit{soup.corner_blocks.data(), soup.tree.nodes.data(),
                                            packet, search};
    walk_packet<!kAny>(whole_of(soup.tree), packet, among, search, visit);
}

/// Searches a soup that takes packets with the rays of `among`.
template <bool kAny>
TRG_FN void search_soup(const Soup& soup, RayPacket& packet, uint32_t among, PacketSearch& search) {
    if (packet.spread == 0)
        search_soup<kAny, true>(soup, packet, among, search);
    else
        search_soup<kAny, false>(soup, packet, among, search);
}

}  // namespace trg::TRG_ISA

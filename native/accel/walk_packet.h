/// The way of sixteen rays through an eight-wide tree, together while some of them go together.
#pragma once

#include "accel/test_packet.h"

namespace trg::TRG_ISA {

constexpr uint32_t kWholePacket = (1u << kPacketRays) - 1;

/// Fewer rays than these meet a node or a leaf one by one.
constexpr int kLeastWalkers = 4;
constexpr int kLeastTesters = 7;

/// Subtrees still to be visited, the next one last: which rays meet their boxes, and where.
struct PacketStack {
    static constexpr int kSize = kMostLevels * (kWidth - 1) + kWidth;
    alignas(64) float entry[kSize][kPacketRays];
    NodeRef ref[kSize];
    uint32_t rays[kSize];
    int size = 0;
};

/// Children of a node from the farthest to the nearest.
struct ChildOrder {
    alignas(32) uint32_t key[kWidth];  // lane in the three lowest bits
    int count;
};

#if defined(__AVX2__)

TRG_INLINE_FN ChildOrder order_children(const ChildHits& hits) {
    ChildOrder order;
    _mm256_store_si256(reinterpret_cast<__m256i*>(order.key), sort_descending(child_keys(hits)));
    order.count = count_bits(hits.mask);
    return order;
}

#else

TRG_INLINE_FN ChildOrder order_children(const ChildHits& hits) {
    ChildOrder order;
    order.count = 0;
    for (uint32_t left = hits.mask; left; left &= left - 1) {
        const auto lane = static_cast<uint32_t>(lowest_bit(left));
        int at = order.count++;
        for (; at > 0 && hits.entry.v[order.key[at - 1]] < hits.entry.v[lane]; --at)
            order.key[at] = order.key[at - 1];
        order.key[at] = lane;
    }
    return order;
}

#endif

/// A packet at a node: the test of its beam, and the rays that are there.
struct PacketStep {
    const NodeTest<QuickBoxTest>& beam;
    const RayPacket& packet;
    uint32_t among;
};

/// Pushes child `lane` when rays of the step meet its box before `limit`.
TRG_INLINE_FN void push_child(const WideNode& node, int lane, const PacketStep& step,
                              const Float16& limit, PacketStack& stack) {
    const RayPacket& packet = step.packet;
    Float16 entry = load16(packet.t_min), exit = limit;
    for (int axis = 0; axis < 3; ++axis) {
        const int near = packet.bounds.sign[axis];
        const Float16 near_bound = splat16(node.bound[near][axis][lane]);
        const Float16 far_bound = splat16(node.bound[1 - near][axis][lane]);
        entry = max16(
            multiply_add(near_bound, load16(packet.inverse[axis]), load16(packet.near_shift[axis])),
            entry);
        exit = min16(multiply_add(far_bound, load16(packet.far_inverse[axis]),
                                  load16(packet.far_shift[axis])),
                     exit);
    }
    const uint32_t met = step.among & mask_less_equal(entry, exit);
    if (!met) return;
    store16(stack.entry[stack.size], entry);
    stack.ref[stack.size] = node.child[lane];
    stack.rays[stack.size++] = met;
}

TRG_INLINE_FN Float16 limits_of(const PacketSearch& search) {
    return load16(search.t) * splat16(kFarFactor);
}

/// Pushes the children of a node, the nearest last where `kSorted`.
template <bool kSorted>
TRG_INLINE_FN void visit_node(const WideNode& node, const PacketStep& step,
                              const PacketSearch& search, PacketStack& stack) {
    const ChildHits hits = step.beam.meet(node, search.farthest);
    const Float16 limit = limits_of(search);
    if (kSorted && (hits.mask & (hits.mask - 1))) {
        const ChildOrder order = order_children(hits);
        for (int k = 0; k < order.count; ++k)
            push_child(node, static_cast<int>(order.key[k] & 7), step, limit, stack);
        return;
    }
    for (uint32_t left = hits.mask; left; left &= left - 1)
        push_child(node, lowest_bit(left), step, limit, stack);
}

/// Takes the next subtree that rays still look for: these rays; 0 when none is left.
template <bool kSorted>
TRG_INLINE_FN uint32_t pop_subtree(const PacketSearch& search, PacketStack& stack) {
    while (stack.size > 0) {
        --stack.size;
        uint32_t rays = stack.rays[stack.size] & search.live;
        if (kSorted && rays)
            rays &= mask_less_equal(load16(stack.entry[stack.size]), limits_of(search));
        if (rays) return rays;
    }
    return 0;
}

/// Walks the tree with the rays of `among`. `visit.leaf(leaf, rays)` is told of leaves that some
/// rays meet, `visit.alone(ref, rays)` of subtrees that too few meet to go on together.
template <bool kSorted, class Visit>
TRG_FN void walk_packet(const Subtree& tree, const RayPacket& packet, uint32_t among,
                        const PacketSearch& search, const Visit& visit) {
    const NodeTest<QuickBoxTest> beam(packet.bounds);
    PacketStack stack;
    NodeRef ref = tree.root;
    for (uint32_t rays = among & search.live; rays;
         rays = pop_subtree<kSorted>(search, stack), ref = stack.ref[stack.size]) {
        if (ref & kLeafBit)
            visit.leaf(ref & ~kLeafBit, rays);
        else if (count_bits(rays) < kLeastWalkers)
            visit.alone(ref, rays);
        else
            visit_node<kSorted>(tree.nodes[ref], {beam, packet, rays}, search, stack);
    }
}

}  // namespace trg::TRG_ISA

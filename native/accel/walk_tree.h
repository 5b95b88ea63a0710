/// The way of a ray through an eight-wide tree.
#pragma once

#include "accel/traced_ray.h"

namespace trg::TRG_ISA {

/// Children whose boxes the ray meets before `limit`, and the distances at which it enters them.
struct ChildHits {
    uint32_t mask;
    Float8 entry;
};

TRG_FN ChildHits meet_children(const WideNode& node, const TracedRay& ray, float limit) {
    // Distances go first into min8 and max8: a NaN, from a ray within a face, is dropped there.
    Float8 entry = splat8(ray.t_min), exit = splat8(limit);
    for (int axis = 0; axis < 3; ++axis) {
        const Float8 origin = splat8(ray.origin[axis]);
        const Float8 near = load8(node.bound[ray.sign[axis]][axis]) - origin;
        const Float8 far = load8(node.bound[1 - ray.sign[axis]][axis]) - origin;
        entry = max8(near * splat8(ray.inverse[axis]), entry);
        exit = min8(far * splat8(ray.far_inverse[axis]), exit);
    }
    return {mask_less_equal(entry, exit), entry};
}

/// Subtrees still to be visited, the next one last, with the distances at which the ray enters them.
struct WalkStack {
    NodeRef ref[kStackSize];
    float entry[kStackSize];
    int size = 0;
};

#if defined(__AVX2__)

/// One layer of a sorting network: keeps the larger of each pair in the lanes of `kLarger`.
template <int kLarger>
TRG_FN __m256i exchange(__m256i keys, __m256i partners) {
    const __m256i smaller = _mm256_min_epi32(keys, partners);
    return _mm256_blend_epi32(smaller, _mm256_max_epi32(keys, partners), kLarger);
}

TRG_FN __m256i sort_descending(__m256i keys) {
    keys = exchange<0x55>(keys, _mm256_shuffle_epi32(keys, 0xb1));
    keys = exchange<0x33>(keys, _mm256_shuffle_epi32(keys, 0x1b));
    keys = exchange<0x55>(keys, _mm256_shuffle_epi32(keys, 0xb1));
    const __m256i reversed = _mm256_setr_epi32(7, 6, 5, 4, 3, 2, 1, 0);
    keys = exchange<0x0f>(keys, _mm256_permutevar8x32_epi32(keys, reversed));
    keys = exchange<0x33>(keys, _mm256_shuffle_epi32(keys, 0x4e));
    return exchange<0x55>(keys, _mm256_shuffle_epi32(keys, 0xb1));
}

/// Pushes the children of `hits`, the nearest last. Keys are the entry distances, whose three lowest
/// bits make room for the lane.
TRG_FN void push_sorted(const WideNode& node, const ChildHits& hits, WalkStack& stack) {
    const __m256i lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i bits = _mm256_andnot_si256(_mm256_set1_epi32(7), _mm256_castps_si256(hits.entry.v));
    const __m256i select = _mm256_sllv_epi32(_mm256_set1_epi32(static_cast<int>(hits.mask)),
                                             _mm256_sub_epi32(_mm256_set1_epi32(31), lanes));
    const __m256i missed = _mm256_andnot_si256(_mm256_srai_epi32(select, 31), _mm256_set1_epi32(-1));
    const __m256i keys = sort_descending(_mm256_or_si256(_mm256_or_si256(bits, lanes), missed));
    const __m256i children = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.child));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(stack.ref + stack.size),
                        _mm256_permutevar8x32_epi32(children, keys));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(stack.entry + stack.size),
                        _mm256_andnot_si256(_mm256_set1_epi32(7), keys));
    stack.size += count_bits(hits.mask);
}

#else

TRG_FN void push_sorted(const WideNode& node, const ChildHits& hits, WalkStack& stack) {
    const int first = stack.size;
    for (uint32_t left = hits.mask; left; left &= left - 1) {
        const int lane = lowest_bit(left);
        int at = stack.size++;
        for (; at > first && stack.entry[at - 1] < hits.entry.v[lane]; --at) {
            stack.entry[at] = stack.entry[at - 1];
            stack.ref[at] = stack.ref[at - 1];
        }
        stack.entry[at] = hits.entry.v[lane];
        stack.ref[at] = node.child[lane];
    }
}

#endif

/// Pushes the children of `hits` as they come, without distances.
TRG_FN void push_unsorted(const WideNode& node, const ChildHits& hits, WalkStack& stack) {
#if defined(__AVX512VL__)
    const __m256i children = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.child));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(stack.ref + stack.size),
                        _mm256_maskz_compress_epi32(static_cast<__mmask8>(hits.mask), children));
    stack.size += count_bits(hits.mask);
#else
    for (uint32_t left = hits.mask; left; left &= left - 1)
        stack.ref[stack.size++] = node.child[lowest_bit(left)];
#endif
}

/// Calls `visit(leaf)` for the leaves of the tree that the ray meets before `*limit`, which `visit`
/// may lower; nearest first where `kSorted`. Ends early, with true, when `visit` returns true.
template <bool kSorted, class Visit>
TRG_FN bool walk_tree(const Tree& tree, const TracedRay& ray, const float* limit, Visit visit) {
    if (tree.root == kNoNode) return false;
    const WideNode* nodes = tree.nodes.data();
    WalkStack stack;
    NodeRef ref = tree.root;
    for (;;) {
        if (ref & kLeafBit) {
            if (visit(ref & ~kLeafBit)) return true;
        } else {
            const WideNode& node = nodes[ref];
            const ChildHits hits = meet_children(node, ray, *limit);
            if (hits.mask && !(hits.mask & (hits.mask - 1))) {
                ref = node.child[lowest_bit(hits.mask)];
                continue;
            }
            if (kSorted && hits.mask) push_sorted(node, hits, stack);
            else if (hits.mask) push_unsorted(node, hits, stack);
        }
        do {
            if (stack.size == 0) return false;
            --stack.size;
        } while (kSorted && stack.entry[stack.size] > *limit);
        ref = stack.ref[stack.size];
    }
}

}  // namespace trg::TRG_ISA

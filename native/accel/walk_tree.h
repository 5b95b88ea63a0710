/// The way of a ray through an eight-wide tree.
#pragma once

#include "accel/traced_ray.h"

namespace trg::TRG_ISA {

/// Children whose boxes the ray meets before `limit`, and the distances at which it enters them.
struct ChildHits {
    uint32_t mask;
    Float8 entry;
};

/// What one ray or a beam of rays means to planes: per axis the origin and the inverse direction
/// that give the nearest and the farthest distance (of planes ahead).
struct RayBounds {
    float near_origin[3], far_origin[3];
    float near_inverse[3], far_inverse[3];
    int sign[3];
    float t_min;
};

TRG_FN RayBounds bounds_of(const TracedRay& ray) {
    RayBounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
        bounds.near_origin[axis] = bounds.far_origin[axis] = ray.origin[axis];
        bounds.near_inverse[axis] = bounds.far_inverse[axis] = ray.inverse[axis];
        bounds.sign[axis] = ray.sign[axis];
    }
    bounds.t_min = ray.t_min;
    return bounds;
}

/// Distances to planes as bound * inverse + shift: one step each. The shifts are moved apart by the
/// rounding of origin * inverse, the far side is raised by kFarFactor, so that no box is lost.
struct QuickBoxTest {
    Float8 inverse[3], far_inverse[3];
    Float8 near_shift[3], far_shift[3];

    /// False for rays whose origin * inverse is too large or not a number: parallel to an axis, or
    /// from very far.
    static bool fits(const RayBounds& ray) {
        constexpr float kLargest = 1e30f;
        bool fits = true;
        for (int axis = 0; axis < 3; ++axis)
            fits = fits & (std::fabs(ray.far_inverse[axis]) < kLargest) &
                   (std::fabs(ray.near_origin[axis] * ray.near_inverse[axis]) < kLargest) &
                   (std::fabs(ray.far_origin[axis] * ray.far_inverse[axis]) < kLargest);
        return fits;
    }
    QuickBoxTest() = default;
    TRG_INLINE_METHOD explicit QuickBoxTest(const RayBounds& ray) {
        for (int axis = 0; axis < 3; ++axis) {
            const float near = ray.near_origin[axis] * ray.near_inverse[axis];
            const float far = ray.far_origin[axis] * ray.far_inverse[axis];
            constexpr float kSlack = 4 * 0x1p-24f;
            inverse[axis] = splat8(ray.near_inverse[axis]);
            far_inverse[axis] = splat8(ray.far_inverse[axis] * kFarFactor);
            near_shift[axis] = splat8(-near - std::fabs(near) * kSlack);
            far_shift[axis] = splat8((-far + std::fabs(far) * kSlack) * kFarFactor);
        }
    }
    Float8 near_distance(Float8 bound, int axis) const {
        return multiply_add(bound, inverse[axis], near_shift[axis]);
    }
    Float8 far_distance(Float8 bound, int axis) const {
        return multiply_add(bound, far_inverse[axis], far_shift[axis]);
    }
};

/// Distances to planes as (bound - origin) * inverse: for every ray. A ray within a face gives NaN.
struct CarefulBoxTest {
    Float8 inverse[3], far_inverse[3], origin[3];

    explicit CarefulBoxTest(const RayBounds& ray) {
        for (int axis = 0; axis < 3; ++axis) {
            inverse[axis] = splat8(ray.near_inverse[axis]);
            far_inverse[axis] = splat8(ray.far_inverse[axis] * kFarFactor);
            origin[axis] = splat8(ray.near_origin[axis]);
        }
    }
    Float8 near_distance(Float8 bound, int axis) const {
        return (bound - origin[axis]) * inverse[axis];
    }
    Float8 far_distance(Float8 bound, int axis) const {
        return (bound - origin[axis]) * far_inverse[axis];
    }
};

/// A box test with what else a node needs: the range of the ray and which planes are near.
template <class BoxTest>
struct NodeTest {
    BoxTest box;
    Float8 t_min;
    int near[3];

    NodeTest() = default;
    explicit NodeTest(const RayBounds& ray)
        : box(ray), t_min(splat8(ray.t_min)), near{ray.sign[0], ray.sign[1], ray.sign[2]} {}

    TRG_INLINE_METHOD ChildHits meet(const WideNode& node, float limit) const {
        // Distances go first into min8 and max8, where a NaN is dropped.
        Float8 entry = t_min, exit = splat8(limit);
        for (int axis = 0; axis < 3; ++axis) {
            const Float8 near_bound = load8(node.bound[near[axis]][axis]);
            const Float8 far_bound = load8(node.bound[1 - near[axis]][axis]);
            entry = max8(box.near_distance(near_bound, axis), entry);
            exit = min8(box.far_distance(far_bound, axis), exit);
        }
        return {mask_less_equal(entry, exit), entry};
    }
};

/// Subtrees still to be visited, the next one last, with the distances at which the ray enters
/// them.
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

/// The least of eight unsigned numbers.
TRG_FN uint32_t least_of(__m256i keys) {
    __m128i least = _mm_min_epu32(_mm256_castsi256_si128(keys), _mm256_extracti128_si256(keys, 1));
    least = _mm_min_epu32(least, _mm_shuffle_epi32(least, 0x4e));
    least = _mm_min_epu32(least, _mm_shuffle_epi32(least, 0xb1));
    return static_cast<uint32_t>(_mm_cvtsi128_si32(least));
}

/// Keys of the children of `hits`: their entry distances, whose three lowest bits make room for the
/// lane; all bits where the ray misses.
TRG_INLINE_FN __m256i child_keys(const ChildHits& hits) {
    const __m256i lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i bits =
        _mm256_andnot_si256(_mm256_set1_epi32(7), _mm256_castps_si256(hits.entry.v));
    const __m256i select = _mm256_sllv_epi32(_mm256_set1_epi32(static_cast<int>(hits.mask)),
                                             _mm256_sub_epi32(_mm256_set1_epi32(31), lanes));
    const __m256i missed =
        _mm256_andnot_si256(_mm256_srai_epi32(select, 31), _mm256_set1_epi32(-1));
    return _mm256_or_si256(_mm256_or_si256(bits, lanes), missed);
}

/// The nearest child of `hits`; the others are pushed, the next nearest last.
TRG_INLINE_FN NodeRef push_all_but_nearest(const WideNode& node, const ChildHits& hits,
                                           WalkStack& stack) {
    const __m256i keys = child_keys(hits);
    const NodeRef nearest = node.child[least_of(keys) & 7];

    const __m256i sorted = sort_descending(keys);
    const __m256i children = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.child));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(stack.ref + stack.size),
                        _mm256_permutevar8x32_epi32(children, sorted));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(stack.entry + stack.size),
                        _mm256_andnot_si256(_mm256_set1_epi32(7), sorted));
    stack.size += count_bits(hits.mask) - 1;
    return nearest;
}

#else

TRG_INLINE_FN NodeRef push_all_but_nearest(const WideNode& node, const ChildHits& hits,
                                           WalkStack& stack) {
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
    return stack.ref[--stack.size];
}

#endif

/// Any child of `hits`; the others are pushed as they come, without distances.
TRG_INLINE_FN NodeRef push_all_but_one(const WideNode& node, const ChildHits& hits,
                                       WalkStack& stack) {
#if defined(__AVX512VL__)
    const __m256i children = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.child));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(stack.ref + stack.size),
                        _mm256_maskz_compress_epi32(static_cast<__mmask8>(hits.mask), children));
    stack.size += count_bits(hits.mask);
#else
    for (uint32_t left = hits.mask; left; left &= left - 1)
        stack.ref[stack.size++] = node.child[lowest_bit(left)];
#endif
    return stack.ref[--stack.size];
}

/// A tree, or the part of it below `root`.
struct Subtree {
    const WideNode* nodes;
    NodeRef root;
};

TRG_FN Subtree whole_of(const Tree& tree) {
    return {tree.nodes.data(), tree.root};
}

template <bool kSorted, class BoxTest, class Visit>
TRG_FN bool walk_nodes(const Subtree& tree, const NodeTest<BoxTest>& test, const float* limit,
                       const Visit& visit) {
    const WideNode* nodes = tree.nodes;
    WalkStack stack;
    NodeRef ref = tree.root;
    for (;;) {
        if (ref & kLeafBit) {
            if (visit(ref & ~kLeafBit)) return true;
        } else {
            const WideNode& node = nodes[ref];
            const ChildHits hits = test.meet(node, *limit);
            if (hits.mask) {
                if (!(hits.mask & (hits.mask - 1)))
                    ref = node.child[lowest_bit(hits.mask)];
                else if (kSorted)
                    ref = push_all_but_nearest(node, hits, stack);
                else
                    ref = push_all_but_one(node, hits, stack);
                continue;
            }
        }
        do {
            if (stack.size == 0) return false;
            --stack.size;
        } while (kSorted && stack.entry[stack.size] > *limit);
        ref = stack.ref[stack.size];
    }
}

/// Calls `visit(leaf)` for the leaves of the tree that the ray meets before `*limit`, which `visit`
/// may lower; nearest first where `kSorted`. Ends early, with true, when `visit` returns true.
template <bool kSorted, class Visit>
TRG_INLINE_FN bool walk_tree_here(const Tree& tree, const TracedRay& ray, const float* limit,
                                  const Visit& visit) {
    if (tree.root == kNoNode) return false;
    const RayBounds bounds = bounds_of(ray);
    if (QuickBoxTest::fits(bounds))
        return walk_nodes<kSorted>(whole_of(tree), NodeTest<QuickBoxTest>(bounds), limit, visit);
    return walk_nodes<kSorted>(whole_of(tree), NodeTest<CarefulBoxTest>(bounds), limit, visit);
}

/// The same where it may be a call.
template <bool kSorted, class Visit>
TRG_FN bool walk_tree(const Tree& tree, const TracedRay& ray, const float* limit, Visit visit) {
    return walk_tree_here<kSorted>(tree, ray, limit, visit);
}

}  // namespace trg::TRG_ISA

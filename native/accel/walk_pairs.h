/// The way of a ray through the paper's tree of boxes in pairs.
#pragma once

#include "accel/traced_ray.h"

namespace trg::TRG_ISA {

constexpr int kPairStack = 40;

/// Distance at which the ray enters the box before `limit`; HUGE_VALF when it does not.
TRG_FN float enter_box(const PairNode& node, const TracedRay& ray, float limit) {
    float entry = ray.t_min, exit = limit;
    for (int axis = 0; axis < 3; ++axis) {
        const int near = ray.sign[axis];
        const float a = (node.bound[near][axis] - ray.origin[axis]) * ray.inverse[axis];
        const float b =
            (node.bound[1 - near][axis] - ray.origin[axis]) * (ray.inverse[axis] * kFarFactor);
        // Written so that the NaN of a ray within a face changes nothing.
        if (a > entry) entry = a;
        if (b < exit) exit = b;
    }
    return entry <= exit ? entry : HUGE_VALF;
}

/// Calls `visit(leaf)` for the leaves that the ray meets before `*limit`, the nearer child first.
template <class Visit>
TRG_FN bool walk_pairs(const PairTree& tree, const TracedRay& ray, const float* limit,
                       Visit visit) {
    const PairNode* nodes = tree.nodes.data();
    uint32_t stack[kPairStack];
    float entries[kPairStack];
    int size = 0;
    uint32_t at = 0;
    if (enter_box(nodes[0], ray, *limit) == HUGE_VALF) return false;
    for (;;) {
        const PairNode& node = nodes[at];
        if (node.leaf) {
            if (visit(node.first)) return true;
        } else {
            const float a = enter_box(nodes[node.first], ray, *limit);
            const float b = enter_box(nodes[node.first + 1], ray, *limit);
            const uint32_t nearer = node.first + (b < a ? 1 : 0);
            const float first = b < a ? b : a, second = b < a ? a : b;
            if (second != HUGE_VALF) {
                stack[size] = nearer == node.first ? node.first + 1 : node.first;
                entries[size++] = second;
            }
            if (first != HUGE_VALF) {
                at = nearer;
                continue;
            }
        }
        do {
            if (size == 0) return false;
            --size;
        } while (entries[size] > *limit);
        at = stack[size];
    }
}

}  // namespace trg::TRG_ISA

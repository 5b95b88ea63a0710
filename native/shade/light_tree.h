/// A tree over many emitters: descending it draws one of them about as often as its light matters
/// at a point (Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights").
#pragma once

#include "shade/frame.h"

namespace trg {

/// Emitters of one branch: where they are, which way they shine and how strongly. The cone about
/// `axis` holds the emitters' own axes; beyond it light reaches on by another angle.
struct LightNode {
    Vec3 low, high;
    Vec3 axis;
    float power;
    float cos_spread, sin_spread;  // of the cone of axes
    float cos_reach;               // of how far beyond it light goes
    bool two_sided;
    int32_t parent;   // -1: the root
    int32_t second;   // the first child comes right after its parent; -1: a leaf
    int32_t emitter;  // of a leaf: a light, or ~k for emissive triangle k
};

struct LightTreeView {
    const LightNode* nodes;     // null: there is no tree
    const int32_t* first_leaf;  // by instance: where its triangles begin in `leaves`, or -1
    const int32_t* leaves;      // node of a triangle, or -1
    float share;                // how often the tree is asked at all
    bool has_extended;          // bounce rays can see some of its lights
};

/// Cosine of the larger of a - b and 0, for angles between 0 and pi.
TRG_FN float cos_difference(float cos_a, float sin_a, float cos_b, float sin_b) {
    return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}

TRG_FN float sine_of(float cosine) {
    return std::sqrt(larger(0.0f, 1.0f - cosine * cosine));
}

/// About how much light the node sends to a surface at `p` of normal `n` (null: that may face any
/// way); 0 only where none can arrive.
TRG_FN float node_importance(const LightNode& node, Vec3 p, Vec3 n) {
    const Vec3 to = (node.low + node.high) * 0.5f - p;
    const Vec3 half = (node.high - node.low) * 0.5f;
    const float r2 = dot(half, half), d2 = dot(to, to);
    const float falloff = node.power / larger(larger(d2, r2), 1e-30f);
    if (!(d2 > r2 * 1.00001f)) return falloff;
    const Vec3 wi = to * (1.0f / std::sqrt(d2));
    // The sphere around the box is seen within an angle whose sine is r / d.
    const float sin_box = std::sqrt(r2 / d2), cos_box = std::sqrt(1.0f - r2 / d2);
    float cos_axis = -dot(node.axis, wi);
    if (node.two_sided) cos_axis = std::fabs(cos_axis);
    const float cos_out =
        cos_difference(cos_axis, sine_of(cos_axis), node.cos_spread, node.sin_spread);
    const float cos_emitted = cos_difference(cos_out, sine_of(cos_out), cos_box, sin_box);
    if (cos_emitted < node.cos_reach) return 0.0f;
    float arriving = 1.0f;
    if (!is_black(n)) {
        const float cos_n = dot(n, wi);
        arriving = cos_difference(cos_n, sine_of(cos_n), cos_box, sin_box);
        if (!(arriving > 0.0f)) return 0.0f;
    }
    return falloff * arriving * larger(cos_emitted, 1e-3f);
}

/// Chance of going on to the first child; below 0 when neither can send light.
TRG_FN float first_chance(const LightTreeView& tree, int32_t node, Vec3 p, Vec3 n) {
    const float a = node_importance(tree.nodes[node + 1], p, n);
    const float b = node_importance(tree.nodes[tree.nodes[node].second], p, n);
    const float sum = a + b;
    if (!(sum > 0.0f)) return -1.0f;
    return std::isfinite(sum) ? a / sum : 0.5f;
}

struct TreeChoice {
    int32_t node;  // a leaf
    float chance;  // 0: nothing arrives
};

/// Draws a leaf by two raw numbers, the second for the deep levels.
TRG_FN TreeChoice sample_tree(const LightTreeView& tree, Vec3 p, Vec3 n, const uint32_t bits[2]) {
    constexpr int kLevelsOfANumber = 12;
    float u = static_cast<float>(bits[0] >> 8) * 5.9604644775390625e-8f;
    float chance = tree.share;
    int32_t node = 0;
    for (int level = 0; tree.nodes[node].second >= 0; ++level) {
        if (level == kLevelsOfANumber)
            u = static_cast<float>(bits[1] >> 8) * 5.9604644775390625e-8f;
        const float first = first_chance(tree, node, p, n);
        if (first < 0.0f) return {0, 0.0f};
        if (u < first) {
            u = smaller(u / first, 0.99999994f);
            chance *= first;
            node = node + 1;
        } else {
            u = smaller((u - first) / (1.0f - first), 0.99999994f);
            chance *= 1.0f - first;
            node = tree.nodes[node].second;
        }
    }
    return {node, chance};
}

/// How likely sample_tree ends at the leaf `node`.
TRG_FN float tree_chance(const LightTreeView& tree, int32_t node, Vec3 p, Vec3 n) {
    float chance = tree.share;
    while (tree.nodes[node].parent >= 0) {
        const int32_t parent = tree.nodes[node].parent;
        const float first = first_chance(tree, parent, p, n);
        if (first < 0.0f) return 0.0f;
        chance *= node == parent + 1 ? first : 1.0f - first;
        node = parent;
    }
    return chance;
}

/// True when the ray passes the node's box before `t_max`. A point on its surface counts.
TRG_FN bool ray_meets_node(const LightNode& node, Vec3 origin, Vec3 direction, float t_max) {
    const float o[3] = {origin.x, origin.y, origin.z};
    const float d[3] = {direction.x, direction.y, direction.z};
    const float low[3] = {node.low.x, node.low.y, node.low.z};
    const float high[3] = {node.high.x, node.high.y, node.high.z};
    float enter = 0.0f, leave = t_max;
    for (int axis = 0; axis < 3; ++axis) {
        const float scale = 1.0f / d[axis];
        const float a = (low[axis] - o[axis]) * scale, b = (high[axis] - o[axis]) * scale;
        // A number that is none (0 times infinity) leaves the interval as it is.
        enter = larger(smaller(a, b), enter);
        leave = smaller(larger(a, b) * 1.000001f, leave);
    }
    return enter <= leave;
}

}  // namespace trg

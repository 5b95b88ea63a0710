/// Which emitters direct light is sampled from, and how often.
#pragma once

#include <vector>

#include "scene/light_tree.h"
#include "scene/scene.h"

namespace trg {

/// Storage behind an EmitterView.
struct EmitterTables {
    std::vector<int32_t> always, pool, extended;
    std::vector<uint32_t> pool_limits, triangle_limits;
    std::vector<float> pool_shares, extended_shares;
    std::vector<EmissiveTriangle> triangles;
    float triangle_density = 0.0f;
    std::vector<LightNode> tree;  // where there are more than kMostListed emitters
    std::vector<int32_t> first_leaf, leaves;
    float tree_share = 0.0f;
    bool tree_has_extended = false;
    bool endless = false;  // a plane emits: bounce rays find it, nobody can sample it
};

/// Up to so many lights and emissive triangles are chosen from a list by power, more by the tree.
constexpr size_t kMostListed = 8;

/// Suns, the four strongest of them, get a sample at every point; everything else shares one
/// sample, chosen by power. Emissive triangles are chosen by area times luminance. Many emitters
/// go into a tree, but for suns beyond the fourth and lights with the paper's falloff.
EmitterTables build_emitters(const Scene& scene);

/// `tables`, which must outlive the view.
EmitterView view_emitters(const EmitterTables& tables);

}  // namespace trg

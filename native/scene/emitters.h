/// Which emitters direct light is sampled from, and how often.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace trg {

/// Storage behind an EmitterView.
struct EmitterTables {
    std::vector<int32_t> always, pool, extended;
    std::vector<uint32_t> pool_limits, triangle_limits;
    std::vector<float> pool_shares, extended_shares;
    std::vector<EmissiveTriangle> triangles;
    float triangle_density = 0.0f;
    bool endless = false;  // a plane emits: bounce rays find it, nobody can sample it
};

/// Suns, the four strongest of them, get a sample at every point; everything else shares one
/// sample, chosen by power. Emissive triangles are chosen by area times luminance.
EmitterTables build_emitters(const Scene& scene);

/// `tables`, which must outlive the view.
EmitterView view_emitters(const EmitterTables& tables);

}  // namespace trg

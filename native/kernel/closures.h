/// Materials that are mixtures: at every hit one of the rows scatters, chosen by its weight before
/// any direction is, so that the mean is the mixture.
#pragma once

#include "kernel/look_up.h"
#include "kernel/path_queues.h"

namespace trg {

/// How much of the surface `s` is there.
template <uint32_t F>
TRG_FN float alpha_of(const SceneView& scene, const Surface& s, Vec3 wo) {
    const Material& m = scene.materials[s.material];
    if constexpr (has(F, kTextures))
        if (m.alpha_texture >= 0) {
            LookUp look{scene, s, wo, false, {}, {}};
            return clamp01(look_up<F>(&look, m.alpha_texture).x);
        }
    return m.alpha;
}

template <uint32_t F>
TRG_FN float closure_weight(LookUp* look, const Material& part) {
    if constexpr (has(F, kTextures))
        if (part.weight_texture >= 0) return larger(0.0f, look_up<F>(look, part.weight_texture).x);
    return part.weight;
}

/// The row that scatters at the point, drawn by `u`; `scale` is its weight over the chance of it,
/// given that the surface is there.
template <uint32_t F>
TRG_FN int32_t choose_closure(LookUp* look, float u, float* scale) {
    const int32_t row = look->surface.material;
    const Material& whole = look->scene.materials[row];
    *scale = 1.0f;
    if (whole.mix_count == 0) return row;
    int32_t chosen = whole.mix_first;
    float sum = 0.0f;
    for (int32_t k = 0; k < whole.mix_count; ++k) {
        const float weight = closure_weight<F>(look, look->scene.materials[whole.mix_first + k]);
        if (!(weight > 0.0f)) continue;
        sum += weight;
        const float share = weight / sum;
        const bool taken = u < share;
        if (taken) chosen = whole.mix_first + k;
        u = smaller(taken ? u / share : (u - share) / (1.0f - share), kBelowOne);
    }
    const float there = alpha_of<F>(look->scene, look->surface, look->wo);
    *scale = there > 0.0f ? sum / there : 0.0f;
    return chosen;
}

}  // namespace trg

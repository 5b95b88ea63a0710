/// The isotropic GGX distribution in the local frame of the shading normal (Walter et al. 2007),
/// with Smith masking and sampling of visible normals.
#pragma once

#include "shade/frame.h"

namespace trg {

/// Below this alpha a surface is an ideal mirror or interface.
constexpr float kSmoothAlpha = 1e-3f;

/// D(h). Written with the components of `h`, so that it keeps its digits at small alpha.
TRG_FN float ggx_density(Vec3 h, float alpha) {
    const float a2 = alpha * alpha;
    const float q = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
    return a2 / (kPi * q * q);
}

/// 1 + 2 Lambda(w), where Lambda is Smith's auxiliary function; infinite at grazing.
TRG_FN float ggx_slope(Vec3 w, float alpha) {
    return std::sqrt(w.z * w.z + alpha * alpha * (w.x * w.x + w.y * w.y)) / std::fabs(w.z);
}

/// A normal that `wo` (above the surface) sees, with density 2 D (wo.h) / (wo.z (1 + slope(wo))):
/// spherical caps, Dupuy and Benyoub 2023.
TRG_FN Vec3 sample_visible_normal(Vec3 wo, float alpha, float u, float v) {
    const Vec3 stretched = normalize(Vec3{alpha * wo.x, alpha * wo.y, wo.z});
    const SineCosine phi = sine_cosine_of_turn(u);
    const float z = (1.0f - v) * (1.0f + stretched.z) - stretched.z;
    const float r = std::sqrt(larger(0.0f, (1.0f - z) * (1.0f + z)));
    const Vec3 h{r * phi.cosine + stretched.x, r * phi.sine + stretched.y, z + stretched.z};
    return normalize(Vec3{alpha * h.x, alpha * h.y, larger(h.z, 0.0f)});
}

/// Whether an interface of `eta` bends light so little that its refraction can only be sampled; all
/// of it then gets through, unmasked.
TRG_FN bool is_thin_step(float alpha, float eta) {
    return alpha * std::fabs(eta - 1.0f) < 1e-5f;
}

}  // namespace trg

/// Shading normals that would mirror the viewer into the surface.
#pragma once

#include "shade/material.h"

namespace trg {

/// Cosine to the geometric normal that a mirrored direction keeps, where the viewer has twice it.
constexpr float kHorizon = 0.01f;

/// Whether some of `m` reflects or refracts by facets.
TRG_FN bool has_facets(const Material& m) {
    return m.metallic > 0.0f || m.transmission > 0.0f || m.coat > 0.0f || m.gloss_ior != 1.0f;
}

/// The shading normal `n` bent towards the geometric normal `ng` just until the mirror image of
/// `wo` is at the horizon; `n` itself where it already is above. All are unit; `wo` is on the side
/// of both. The result is unit and `wo` is on its side.
/// With m = n + k ng the condition 2 (wo.m) (m.ng) = (wo.ng + horizon) m.m is a quadratic in k.
TRG_FN Vec3 bend_to_horizon(Vec3 n, Vec3 ng, Vec3 wo) {
    const float cosine = dot(wo, n), flat = dot(wo, ng), tilt = dot(n, ng);
    const float horizon = smaller(kHorizon, 0.5f * flat);
    const float missing = flat + horizon - 2.0f * cosine * tilt;
    if (!(missing > 0.0f)) return n;
    const float a = flat - horizon, b = cosine - tilt * horizon;
    const float root = std::sqrt(b * b + a * missing);
    // One root written in two ways, of which one does not cancel.
    const Vec3 bent = b > 0.0f ? n * (b + root) + ng * missing : n * a + ng * (root - b);
    const Vec3 unit = normalize_safe(bent);
    return dot(wo, unit) > 0.0f ? unit : ng;
}

}  // namespace trg

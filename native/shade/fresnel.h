/// Share of light that a smooth interface reflects.
#pragma once

#include "base/vec3.h"

namespace trg {

/// Unpolarised reflectance of a dielectric seen at cosine `c` >= 0; `eta` is the index of the far
/// side over that of the near one. The factored form loses no digits near eta = 1.
/// `g` receives eta times the cosine of the refracted ray, 0 under total reflection.
TRG_FN float fresnel_dielectric(float c, float eta, float* g) {
    const float m = (eta - 1.0f) * (eta + 1.0f);
    const float g2 = m + c * c;
    *g = 0.0f;
    if (!(g2 > 0.0f)) return eta == 1.0f ? 0.0f : 1.0f;
    *g = std::sqrt(g2);
    const float sum = c + *g, eta2 = m + 1.0f;
    const float rs = m / (sum * sum);
    const float rp = m * ((eta2 + 1.0f) * c * c - 1.0f) / ((eta2 * c + *g) * (eta2 * c + *g));
    return 0.5f * (rs * rs + rp * rp);
}

TRG_FN float fresnel_dielectric(float c, float eta) {
    float g;
    return fresnel_dielectric(c, eta, &g);
}

/// Schlick's (1994) reflectance of a metal whose reflectance at normal incidence is `f0`.
TRG_FN Vec3 fresnel_schlick(Vec3 f0, float c) {
    const float a = c < 1.0f ? 1.0f - c : 0.0f;
    const float a5 = a * a * a * a * a;
    return {f0.x + (1.0f - f0.x) * a5, f0.y + (1.0f - f0.y) * a5, f0.z + (1.0f - f0.z) * a5};
}

/// Mean of fresnel_dielectric over the hemisphere of the near side, weighted by the cosine.
/// Midpoint rule in the square of the cosine, refined enough for 1e-5; meant for set-up.
TRG_FN float mean_fresnel_dielectric(float eta) {
    constexpr int kSteps = 4096;
    float sum = 0.0f;
    for (int block = 0; block < kSteps; block += 64) {
        float part = 0.0f;
        for (int k = block; k < block + 64; ++k)
            part += fresnel_dielectric(std::sqrt((static_cast<float>(k) + 0.5f) * (1.0f / kSteps)),
                                       eta);
        sum += part;
    }
    return sum * (1.0f / kSteps);
}

}  // namespace trg

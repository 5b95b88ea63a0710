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

/// Reflectance at normal incidence of an index of refraction.
TRG_FN float f0_of_ior(float ior) {
    const float root = (ior - 1.0f) / (ior + 1.0f);
    return root * root;
}

/// The index, not below 1, that reflects `f0` at normal incidence.
TRG_FN float ior_of_f0(float f0) {
    const float root = std::sqrt(f0 < 0.99f ? f0 : 0.99f);
    return (1.0f + root) / (1.0f - root);
}

/// A metal by its colour at normal incidence and a dip towards grazing angles.
struct MetalFresnel {
    Vec3 f0;
    Vec3 dip;       // subtracted as dip c (1 - c)^6
    float grazing;  // 1: white at grazing angles, 0: f0 everywhere
};

/// Schlick's reflectance (1994), multiplied by `tint` at the cosine 1/7, about 82 degrees: F82-tint
/// of Kutz, Hasan and Edmondson 2021, "Novel aspects of the Adobe Standard Material".
TRG_FN MetalFresnel make_metal_fresnel(Vec3 f0, Vec3 tint, float grazing) {
    constexpr float kFive = 0.46266436f, kSix = 0.39656944f;  // powers of 6/7
    const Vec3 one{1.0f, 1.0f, 1.0f};
    tint = {tint.x < 1.0f ? tint.x : 1.0f, tint.y < 1.0f ? tint.y : 1.0f,
            tint.z < 1.0f ? tint.z : 1.0f};
    const Vec3 schlick = f0 + (one - f0) * (kFive * grazing);
    return {f0, schlick * (one - tint) * (7.0f / kSix), grazing};
}

TRG_FN Vec3 fresnel_metal(const MetalFresnel& metal, float c) {
    const float a = c < 1.0f ? 1.0f - c : 0.0f;
    const float a5 = a * a * a * a * a;
    const Vec3 one{1.0f, 1.0f, 1.0f};
    return metal.f0 + (one - metal.f0) * (a5 * metal.grazing) - metal.dip * (c * a5 * a);
}

/// Mean of fresnel_metal over the hemisphere, weighted by the cosine.
TRG_FN Vec3 mean_fresnel_metal(const MetalFresnel& metal) {
    const Vec3 one{1.0f, 1.0f, 1.0f};
    return metal.f0 + (one - metal.f0) * (metal.grazing / 21.0f) - metal.dip * (1.0f / 126.0f);
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

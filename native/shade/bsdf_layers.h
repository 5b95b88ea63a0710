/// Scattering that only some materials have: the sheen on top and a rough diffuse base.
#pragma once

#include "shade/frame.h"

namespace trg {

/// Light scattered by fibres on the surface: a linearly transformed cosine seen from one direction
/// (Zeltner, Burley and Chiang 2022, "Practical Multiple-Scattering Sheen Using Linearly
/// Transformed Cosines"), by the rational fits that MaterialX publishes for its tables.
struct Sheen {
    float a, b;          // of the matrix that takes directions back to the plain cosine
    float cosine, sine;  // azimuth of the viewer
    float albedo;
};

TRG_FN Sheen make_sheen(Vec3 wo, float roughness) {
    const float x = clamp01(wo.z), y = larger(roughness, 0.01f);
    const float spread = y * (0.0206607f + 1.58491f * y) / (0.0379424f + y * (1.32227f + y));
    const float middle =
        y * (-0.193854f + y * (-1.14885f + y * (1.7932f - 0.95943f * y * y))) / (0.046391f + y);
    const float offset =
        y * (0.000654023f + (-0.0207818f + 0.119681f * y) * y) / (1.26264f + y * (-1.92021f + y));
    const float t = (x - middle) / spread;
    Sheen sheen;
    sheen.albedo = clamp01(std::exp(-0.5f * t * t) / (spread * std::sqrt(2.0f * kPi)) + offset);
    sheen.a = (2.58126f * x + 0.813703f * y) * y / (1.0f + 0.310327f * x * x + 2.60994f * x * y);
    sheen.b = std::sqrt(1.0f - x) * (y - 1.0f) * y * y * y /
              (0.0000254053f + 1.71228f * x - 1.71506f * x * y + 1.34174f * y * y);
    const float flat = std::sqrt(wo.x * wo.x + wo.y * wo.y);
    sheen.cosine = flat > 0.0f ? wo.x / flat : 1.0f;
    sheen.sine = flat > 0.0f ? wo.y / flat : 0.0f;
    return sheen;
}

/// Density of `wi`, whose integral over the upper hemisphere is 1.
TRG_FN float eval_sheen(const Sheen& s, Vec3 wi) {
    const float x = s.cosine * wi.x + s.sine * wi.y, y = s.cosine * wi.y - s.sine * wi.x;
    const float p = s.a * x + s.b * wi.z, q = s.a * y;
    const float square = p * p + q * q + wi.z * wi.z;
    const float ratio = s.a / square;
    return wi.z > 0.0f ? kInvPi * wi.z * ratio * ratio : 0.0f;
}

/// A direction with density eval_sheen.
TRG_FN Vec3 sample_sheen(const Sheen& s, float u, float v) {
    const Vec3 c = sample_cosine(u, v);
    const Vec3 w = normalize(Vec3{c.x - c.z * s.b, c.y, c.z * s.a});
    return {s.cosine * w.x - s.sine * w.y, s.sine * w.x + s.cosine * w.y, w.z};
}

/// Fujii's variant of Oren and Nayar's rough diffuse surface with the light that is scattered more
/// than once (OpenPBR surface specification 1.1, section "Glossy-diffuse slab"). b = 0: Lambert.
struct RoughDiffuse {
    float a, b;
    Vec3 repeated;  // of light scattered again, for one viewer
};

/// Integral over the hemisphere of the angular term of RoughDiffuse, at cosine `c`.
TRG_FN float rough_diffuse_tail(float c) {
    const float sine = std::sqrt(larger(0.0f, 1.0f - c * c));
    const float third = 2.0f / 3.0f;
    if (c < 1e-4f) return 0.5f * kPi - third - c;
    return sine * (std::acos(smaller(c, 1.0f)) - third - sine * c) +
           third * (sine / c) * (1.0f - sine * sine * sine);
}

TRG_FN RoughDiffuse make_rough_diffuse(Vec3 color, float cosine, float roughness) {
    if (!(roughness > 1e-5f)) return {kInvPi, 0.0f, {0.0f, 0.0f, 0.0f}};
    const float a = 1.0f / (kPi + roughness * (0.5f * kPi - 2.0f / 3.0f)), b = roughness * a;
    const float mean = a * kPi + b * (2.0f * kPi - 5.6f) / 3.0f;
    const float gone = 1.0f - (a * kPi + b * rough_diffuse_tail(cosine));
    const float scale = kInvPi * gone * mean / (1.0f - mean), lost = 1.0f - mean;
    return {a,
            b,
            {scale * color.x * color.x / (1.0f - color.x * lost),
             scale * color.y * color.y / (1.0f - color.y * lost),
             scale * color.z * color.z / (1.0f - color.z * lost)}};
}

/// Value times |cos wi|, before the colour: Cycles gives repeated light the colour once more.
TRG_FN Vec3 eval_rough_diffuse(const RoughDiffuse& d, Vec3 wo, Vec3 wi) {
    const float plain = d.a * wi.z;
    if (d.b == 0.0f) return {plain, plain, plain};
    float t = dot(wi, wo) - wi.z * wo.z;
    if (t > 0.0f) t /= larger(wi.z, wo.z);
    const float once = d.a + d.b * t;
    const float gone = 1.0f - (d.a * kPi + d.b * rough_diffuse_tail(wi.z));
    return (Vec3{once, once, once} + d.repeated * gone) * wi.z;
}

}  // namespace trg

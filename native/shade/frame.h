/// Small tools of shading: local frames, luminance, safe normalisation, simple distributions.
#pragma once

#include "base/vec3.h"

namespace trg {

constexpr float kPi = 3.14159265358979f;
constexpr float kInvPi = 0.318309886183791f;

/// The larger and the smaller of two numbers; the second where either is not a number.
TRG_FN float larger(float a, float b) {
    return a > b ? a : b;
}
TRG_FN float smaller(float a, float b) {
    return a < b ? a : b;
}

/// Right-handed unit axes; `n` is the local z.
struct Frame {
    Vec3 s, t, n;
};

/// Axes around the unit vector `n` (Duff et al. 2017).
TRG_FN Frame make_frame(Vec3 n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    return {
        {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

TRG_FN Vec3 to_local(const Frame& f, Vec3 w) {
    return {dot(w, f.s), dot(w, f.t), dot(w, f.n)};
}
TRG_FN Vec3 to_world(const Frame& f, Vec3 w) {
    return f.s * w.x + f.t * w.y + f.n * w.z;
}

/// Rec.709 luminance.
TRG_FN float luminance(Vec3 c) {
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}
TRG_FN float max_component(Vec3 c) {
    return larger(c.x, larger(c.y, c.z));
}
TRG_FN Vec3 absolute(Vec3 a) {
    return {std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)};
}
TRG_FN bool is_black(Vec3 c) {
    return c.x == 0.0f && c.y == 0.0f && c.z == 0.0f;
}
TRG_FN float clamp01(float x) {
    return x < 0.0f ? 0.0f : (x > 1.0f ? 1.0f : x);
}

/// `a` scaled to length 1 without overflow or underflow; the null vector when `a` is null or holds
/// a number that is not finite.
TRG_FN Vec3 normalize_safe(Vec3 a) {
    const float square = dot(a, a);
    if (square > 1e-20f && square < 1e20f) return a * (1.0f / std::sqrt(square));
    const float size = max_component(absolute(a));
    if (!(size > 0.0f) || !is_finite(a)) return {0.0f, 0.0f, 0.0f};
    const Vec3 scaled{a.x / size, a.y / size, a.z / size};
    return scaled / length(scaled);
}

struct SineCosine {
    float sine, cosine;
};

/// Of an angle between -pi/4 and pi/4, to within 8e-8: minimax polynomials.
TRG_FN SineCosine sine_cosine(float x) {
    const float z = x * x;
    const float sine = x + x * z * (-0.166666552f + z * (0.008332178f + z * -0.000195172339f));
    const float cosine =
        (1.0f - 0.5f * z) + z * z * (0.0416666456f + z * (-0.00138873665f + z * 2.44383791e-05f));
    return {sine, cosine};
}

/// Of `u` full turns, 0 to 1.
TRG_FN SineCosine sine_cosine_of_turn(float u) {
    const int quarter = static_cast<int>(4.0f * u + 0.5f);
    const SineCosine rest = sine_cosine(2.0f * kPi * (u - 0.25f * static_cast<float>(quarter)));
    const bool odd = (quarter & 1) != 0;
    const float sine = odd ? rest.cosine : rest.sine, cosine = odd ? rest.sine : rest.cosine;
    return {(quarter & 2) != 0 ? -sine : sine, ((quarter + 1) & 2) != 0 ? -cosine : cosine};
}

/// A point of the unit disc, uniform by area (Shirley and Chiu 1997).
TRG_FN void sample_disc(float u, float v, float* x, float* y) {
    const float a = 2.0f * u - 1.0f, b = 2.0f * v - 1.0f;
    if (a == 0.0f && b == 0.0f) {
        *x = *y = 0.0f;
        return;
    }
    const bool wide = std::fabs(a) > std::fabs(b);
    const float r = wide ? a : b;
    const SineCosine turn = sine_cosine(0.25f * kPi * (wide ? b / a : a / b));
    *x = r * (wide ? turn.cosine : turn.sine);
    *y = r * (wide ? turn.sine : turn.cosine);
}

/// A local direction with density cos / pi.
TRG_FN Vec3 sample_cosine(float u, float v) {
    float x, y;
    sample_disc(u, v, &x, &y);
    return {x, y, std::sqrt(larger(0.0f, 1.0f - x * x - y * y))};
}

/// Share of the first of two sampling techniques by the power heuristic (Veach and Guibas 1995).
TRG_FN float power_heuristic(float pdf, float other_pdf) {
    if (!(pdf > 0.0f)) return 0.0f;
    const float ratio = other_pdf / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

}  // namespace trg

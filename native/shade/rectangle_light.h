/// Rectangles as seen from a point: their solid angle, and directions to them even by solid angle
/// (Urena, Fajardo and King 2013, "An Area-Preserving Parametrization for Spherical Rectangles").
#pragma once

#include "shade/frame.h"
#include "shade/sampler.h"

namespace trg {

/// A rectangle in axes along its sides, seen from the origin, which lies `height` before its plane.
struct SeenRectangle {
    float x0, x1, y0, y1;
    float height;
    float solid_angle;
};

/// Solid angle of the triangle (a, b, c) as an angle's tangent: `up` over `across` is that of its
/// half (van Oosterom and Strackee 1983). `up` is the triple product of the corners.
struct HalfAngle {
    float up, across;
};

TRG_FN float triangle_across(Vec3 a, Vec3 b, Vec3 c) {
    const float la = length(a), lb = length(b), lc = length(c);
    return la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la;
}

/// The angle of two halves together, each of at most pi: exact however small it is.
TRG_FN float add_half_angles(HalfAngle a, HalfAngle b) {
    const float up = a.up * b.across + a.across * b.up, across = a.across * b.across - a.up * b.up;
    const float sum = std::atan2(up, across);
    return sum < 0.0f ? kPi : sum;  // rounding where they fill all that lies before a plane
}

/// Fills in the solid angle of `r`.
TRG_FN void measure_rectangle(SeenRectangle* r) {
    // No product overflows in units of the largest length.
    const float scale = 1.0f / larger(larger(std::fabs(r->x0 + r->x1), std::fabs(r->y0 + r->y1)),
                                      larger(r->x1 - r->x0, larger(r->y1 - r->y0, r->height)));
    const float x0 = r->x0 * scale, x1 = r->x1 * scale, y0 = r->y0 * scale, y1 = r->y1 * scale;
    const float h = r->height * scale;
    const Vec3 a{x0, y0, h}, b{x1, y0, h}, c{x1, y1, h}, d{x0, y1, h};
    const float up = (x1 - x0) * (y1 - y0) * h;
    r->solid_angle =
        2.0f * add_half_angles({up, triangle_across(a, b, c)}, {up, triangle_across(a, c, d)});
}

TRG_FN float acos_held(float cosine) {
    return std::acos(cosine < -1.0f ? -1.0f : (cosine > 1.0f ? 1.0f : cosine));
}

/// A point of the rectangle, even by solid angle; held to its sides where rounding would leave it.
TRG_FN void sample_rectangle(const SeenRectangle& r, Sample2 even, float* x, float* y) {
    const float h2 = r.height * r.height;
    const float n0 = -r.y0 / std::sqrt(r.y0 * r.y0 + h2);
    const float n2 = r.y1 / std::sqrt(r.y1 * r.y1 + h2), n3 = -r.x0 / std::sqrt(r.x0 * r.x0 + h2);
    // The strip up to x fills the angle `even.u` of the whole.
    const float rest = 2.0f * kPi - acos_held(-n2 * n3) - acos_held(-n3 * n0);
    const float angle = even.u * r.solid_angle + rest;
    const float f = (std::cos(angle) * n0 - n2) / std::sin(angle);
    const float beside = larger(f * f - h2 / (r.y0 * r.y0 + h2), 0.0f);
    const float across = std::copysign(r.height / std::sqrt(larger(beside, 1e-30f)), f);
    *x = smaller(larger(across, r.x0), r.x1);
    const float away = std::sqrt(*x * *x + h2);
    const float s0 = r.y0 / std::sqrt(away * away + r.y0 * r.y0);
    const float s1 = r.y1 / std::sqrt(away * away + r.y1 * r.y1);
    const float s = s0 + even.v * (s1 - s0);
    const float up = s * away / std::sqrt(larger(1.0f - s * s, 1e-30f));
    *y = smaller(larger(up, r.y0), r.y1);
}

}  // namespace trg

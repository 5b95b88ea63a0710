/// Rays against the unit sphere and the plane z = 0, in double, and the coordinates on them.
#pragma once

#include "geom/transform.h"

namespace trg {

constexpr double kTwoPi = 6.283185307179586476925;

struct Roots {
    double near, far;  // near <= far; NaN when there are none
};

/// A root of |o + t d| = 1 made exact by one step of Newton's method.
TRG_FN double polish_root(Vec3d o, Vec3d d, double t) {
    const Vec3d p = o + d * t;
    const double slope = 2.0 * dot(p, d), value = dot(p, p) - 1.0;
    const double step = value / slope;
    // At a tangent the slope vanishes and the root is as good as it gets.
    return std::fabs(value) < 1e-3 * std::fabs(slope * t) ? t - step : t;
}

/// Where o + t d meets the unit sphere. The origin is first moved to the point of the line that is
/// nearest to the centre, so that nothing cancels when it is far (Haines et al. 2019).
TRG_FN Roots meet_sphere(Vec3d o, Vec3d d) {
    const double dd = dot(d, d), middle = -dot(o, d) / dd;
    const Vec3d q = o + d * middle;
    const double square = (1.0 - dot(q, q)) / dd;
    if (!(square >= 0)) return {NAN, NAN};
    const double half = std::sqrt(square);
    return {polish_root(o, d, middle - half), polish_root(o, d, middle + half)};
}

/// Where o + t d meets z = 0; infinite or NaN when it runs along it.
TRG_FN double meet_plane(Vec3d o, Vec3d d) {
    return -o.z / d.z;
}

struct ShapeCoordinates {
    double u, v;
};

/// Of a point of the sphere: u turns about z from -y towards x, v rises from the lower pole to the
/// upper one, both from 0 to 1.
TRG_FN ShapeCoordinates sphere_coordinates(Vec3d p) {
    const double u = std::atan2(p.x, -p.y) / kTwoPi;
    const double height = std::atan2(p.z, std::sqrt(p.x * p.x + p.y * p.y));
    return {u < 0 ? u + 1.0 : u, 0.5 + height * (2.0 / kTwoPi)};
}

/// A point evenly spread over the sphere, from two numbers evenly spread over [0, 1).
TRG_FN Vec3d even_sphere_point(double a, double b) {
    const double z = 1.0 - 2.0 * a, across = std::sqrt(1.0 - z * z), angle = kTwoPi * b;
    return {across * std::cos(angle), across * std::sin(angle), z};
}

/// How much thinner than over an unstretched sphere of the same volume such points lie, by area,
/// where the sphere placed by `placed` has the (not unit) normal `n`, its inverse transpose's.
TRG_FN float sphere_density(const Transform& placed, Vec3d n) {
    return static_cast<float>(1.0 /
                              (std::cbrt(std::fabs(determinant(placed))) * std::sqrt(dot(n, n))));
}

}  // namespace trg

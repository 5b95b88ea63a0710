/// Ray against a sphere or a plane, in double; every instruction set gives the same bits.
#pragma once

#include "accel/test_watertight.h"
#include "accel/traced_ray.h"
#include "geom/shapes.h"

namespace trg::TRG_ISA {

struct ShapeRay {
    Vec3d origin, direction;
};

/// From the world to the space of a placement that moves.
TRG_RARE_FN InverseMap into_at(const Placement& placement, float time) {
    return inverse_map(transform_at(placement.keys, placement.key_count, time));
}

TRG_FN ShapeRay enter_shape(const Placement& placement, const TracedRay& ray) {
    if (placement.key_count > 0) {
        const InverseMap into = into_at(placement, ray.time);
        return {point_into(into, ray.origin_d), vector_into(into, ray.direction_d)};
    }
    if (placement.identity) return {ray.origin_d, ray.direction_d};
    return {point_into(placement.into, ray.origin_d), vector_into(placement.into, ray.direction_d)};
}

TRG_INLINE_FN Roots meet_shape(const Placement& placement, const TracedRay& ray) {
    const ShapeRay local = enter_shape(placement, ray);
    if (placement.soup->shape == Shape::sphere) return meet_sphere(local.origin, local.direction);
    return {meet_plane(local.origin, local.direction), NAN};
}

template <class AnySearch>
TRG_FN void test_closest(const Placement& placement, const TracedRay& ray, AnySearch& search) {
    const Roots roots = meet_shape(placement, ray);
    for (const double root : {roots.near, roots.far}) {
        const auto t = static_cast<float>(root);
        if (!(t > ray.t_min && improves(search, t, 0))) continue;
        record_hit(search, t, nullptr, 0, 0);
        return;
    }
}

TRG_FN bool test_any(const Placement& placement, const TracedRay& ray, float t_max) {
    const Roots roots = meet_shape(placement, ray);
    const auto near = static_cast<float>(roots.near), far = static_cast<float>(roots.far);
    return (near > ray.t_min && near < t_max) || (far > ray.t_min && far < t_max);
}

/// `x` held within the range of floats.
TRG_FN float finite_float(double x) {
    constexpr double kMost = 3.4028234663852886e38;
    return static_cast<float>(x < -kMost ? -kMost : x > kMost ? kMost : x);
}

/// Coordinates on the shape (geom/shapes.h) at distance `t`; of a plane they are its own x and y,
/// finite however far away the point is.
TRG_FN Barycentrics coordinates_of(const Placement& placement, const TracedRay& ray, float t) {
    const ShapeRay local = enter_shape(placement, ray);
    const Vec3d p = local.origin + local.direction * t;
    if (placement.soup->shape == Shape::plane) return {finite_float(p.x), finite_float(p.y)};
    const ShapeCoordinates at = sphere_coordinates(p);
    return {static_cast<float>(at.u), static_cast<float>(at.v)};
}

}  // namespace trg::TRG_ISA

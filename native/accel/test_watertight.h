/// Ray against eight triangles, without leaks at edges and vertices.
///
/// A triangle is met when the exact edge functions D.(A x B) of its corners relative to the ray's
/// origin agree in sign, or are zero. They are computed in double, and a bound of the rounding
/// error counts as zero: so the triangle that a ray exactly meets is never missed, at an edge or at
/// a corner where many meet. A float version in sheared space (Woop, Benthin, Wald 2013) goes
/// first; its own bound leaves only the lanes near an edge to the doubles. The distance is that of
/// the plane through the first corner, in double.
#pragma once

#include "accel/traced_ray.h"
#include "accel/triangle_block.h"

namespace trg::TRG_ISA {

/// Lanes that may be hit, and of those the ones that surely are (as far as edges go).
struct LaneMasks {
    uint32_t possible, certain;
};

/// X and Y of a corner relative to the origin, sheared so that the ray runs along the third axis.
struct ShearedCorner {
    Float8 x, y, z;
};

TRG_FN ShearedCorner shear_corner(const float (&corner)[3][kWidth], const TracedRay& ray) {
    const Float8 z = load8(corner[ray.kz]) - splat8(ray.origin[ray.kz]);
    const Float8 x = load8(corner[ray.kx]) - splat8(ray.origin[ray.kx]);
    const Float8 y = load8(corner[ray.ky]) - splat8(ray.origin[ray.ky]);
    return {subtract_product(x, splat8(ray.shear_x), z),
            subtract_product(y, splat8(ray.shear_y), z), z};
}

TRG_FN Float8 edge_function(const ShearedCorner& a, const ShearedCorner& b) {
    return subtract_product(a.x * b.y, a.y, b.x);
}

TRG_INLINE_FN LaneMasks filter_lanes(const CornerBlock& block, const TracedRay& ray) {
    const ShearedCorner a = shear_corner(block.corner[0], ray);
    const ShearedCorner b = shear_corner(block.corner[1], ray);
    const ShearedCorner c = shear_corner(block.corner[2], ray);
    const Float8 u = edge_function(b, c), v = edge_function(c, a), w = edge_function(a, b);

    // |error| <= 2^-24 m (16 m + 24 r), m the largest |x|, |y| and r the largest |z| of the
    // corners; the constant term keeps products that underflow on the safe side.
    const Float8 m = max_abs8(max_abs8(max_abs8(a.x, a.y), max_abs8(b.x, b.y)), max_abs8(c.x, c.y));
    const Float8 r = max_abs8(max_abs8(a.z, b.z), c.z);
    const Float8 bound = multiply_add(m * splat8(28 * 0x1p-24f), m + r, splat8(1e-36f));

    const Float8 least = min8(min8(u, v), w), most = max8(max8(u, v), w), minus = negate8(bound);
    return {mask_less_equal(minus, least) | mask_less_equal(most, bound),
            mask_less(bound, least) | mask_less(most, minus)};
}

TRG_FN Vec3d corner_of(const CornerBlock& block, int corner, int lane) {
    return {block.corner[corner][0][lane], block.corner[corner][1][lane],
            block.corner[corner][2][lane]};
}

struct EdgeFunctions {
    double u, v, w;
};

/// The corners of one triangle relative to the origin of a ray, and its edges.
struct RelativeCorners {
    Vec3d a, b, c;
    Vec3d bc, ca, ab;
};

TRG_FN RelativeCorners relative_corners(const CornerBlock& block, int lane, const ExactRay& ray) {
    const Vec3d a = corner_of(block, 0, lane), b = corner_of(block, 1, lane);
    const Vec3d c = corner_of(block, 2, lane);
    return {a - ray.origin_d, b - ray.origin_d, c - ray.origin_d, c - b, a - c, b - a};
}

TRG_INLINE_FN EdgeFunctions edge_functions(const RelativeCorners& p, Vec3d direction) {
    // B x C = B x (C - B): edges do not cancel, however far the triangle is.
    return {dot(direction, cross(p.b, p.bc)), dot(direction, cross(p.c, p.ca)),
            dot(direction, cross(p.a, p.ab))};
}

TRG_FN double larger_of(double a, double b) {
    return a > b ? a : b;
}

TRG_FN double largest_component(Vec3d v) {
    return larger_of(larger_of(std::fabs(v.x), std::fabs(v.y)), std::fabs(v.z));
}

TRG_FN double largest_of(Vec3d a, Vec3d b, Vec3d c) {
    return larger_of(larger_of(largest_component(a), largest_component(b)), largest_component(c));
}

/// Whether the exact edge functions may agree in sign.
TRG_FN bool is_inside(const RelativeCorners& p, Vec3d direction) {
    const EdgeFunctions e = edge_functions(p, direction);
    const Vec3d d = direction;
    const double bound = 20 * 0x1p-53 * (std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z)) *
                         largest_of(p.a, p.b, p.c) * largest_of(p.bc, p.ca, p.ab);
    return (e.u >= -bound && e.v >= -bound && e.w >= -bound) ||
           (e.u <= bound && e.v <= bound && e.w <= bound);
}

/// Distance to the plane of a lane's triangle; NaN or infinite when the ray runs within it.
TRG_FN double plane_distance(const CornerBlock& block, int lane, const ExactRay& ray) {
    const Vec3d p0 = corner_of(block, 0, lane);
    const Vec3d n = cross(corner_of(block, 1, lane) - p0, corner_of(block, 2, lane) - p0);
    return dot(n, p0 - ray.origin_d) / dot(n, ray.direction_d);
}

/// `t` no nearer and no farther than the corners: rays almost within the plane have no better
/// answer. What rounding alone puts beyond them stays, so that no filter has a say in the distance.
TRG_FN double within_corners(double t, const RelativeCorners& p, Vec3d direction) {
    const double scale = 1.0 / dot(direction, direction);
    const double a = dot(p.a, direction) * scale, b = dot(p.b, direction) * scale;
    const double c = dot(p.c, direction) * scale;
    const double near_ab = a < b ? a : b, far_ab = a < b ? b : a;
    const double near = near_ab < c ? near_ab : c, far = far_ab > c ? far_ab : c;
    const double size = std::fmax(std::fabs(near), std::fabs(far)) * 0x1p-28;
    return t < near - size ? near : t > far + size ? far : t;
}

/// Distance to a lane near whose edge the ray passes, `t` being its plane's; NaN when it is not
/// met.
TRG_RARE_FN float edge_distance(const CornerBlock& block, int lane, double t, const ExactRay& ray) {
    const RelativeCorners corners = relative_corners(block, lane, ray);
    if (!std::isfinite(t) || !is_inside(corners, ray.direction_d)) return NAN;
    return static_cast<float>(within_corners(t, corners, ray.direction_d));
}

/// Distance to a possible lane; NaN when it is not met after all.
TRG_FN float lane_distance(const CornerBlock& block, int lane, bool certain, const ExactRay& ray) {
    const double t = plane_distance(block, lane, ray);
    return certain ? static_cast<float>(t) : edge_distance(block, lane, t, ray);
}

template <class AnySearch>
TRG_FN void test_closest(const CornerBlock& block, const TracedRay& ray, AnySearch& search) {
    const LaneMasks lanes = filter_lanes(block, ray);
    for (uint32_t left = lanes.possible; left; left &= left - 1) {
        const int lane = lowest_bit(left);
        const float t = lane_distance(block, lane, (lanes.certain >> lane) & 1, ray);
        if (t > ray.t_min && improves(search, t, block.prim[lane]))
            record_hit(search, t, &block, lane, block.prim[lane]);
    }
}

TRG_INLINE_FN bool test_any(const CornerBlock& block, const TracedRay& ray, float t_max) {
    const LaneMasks lanes = filter_lanes(block, ray);
    for (uint32_t left = lanes.possible; left; left &= left - 1) {
        const int lane = lowest_bit(left);
        const float t = lane_distance(block, lane, (lanes.certain >> lane) & 1, ray);
        if (t > ray.t_min && t < t_max) return true;
    }
    return false;
}

struct Barycentrics {
    float u, v;
};

TRG_INLINE_FN float unit_range(double x) {
    return static_cast<float>(x < 0 ? 0 : x > 1 ? 1 : x);
}

TRG_INLINE_FN Barycentrics coordinates_of(const EdgeFunctions& e) {
    const double sum = e.u + e.v + e.w;
    if (sum == 0) return {0.0f, 0.0f};
    return {unit_range(e.v / sum), unit_range(e.w / sum)};
}

TRG_FN Barycentrics coordinates_of(const CornerBlock& block, int lane, const ExactRay& ray) {
    return coordinates_of(edge_functions(relative_corners(block, lane, ray), ray.direction_d));
}

}  // namespace trg::TRG_ISA

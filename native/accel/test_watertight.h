/// Ray against eight triangles, without leaks at edges and vertices.
///
/// Inside is told by the signs of the edge functions D.(A x B) of the corners relative to the ray's
/// origin, in double: swapping A and B flips the sign and nothing else, so two triangles that share
/// an edge always agree about it. A float version in sheared space (Woop, Benthin, Wald 2013) goes
/// first; its error bound leaves only the lanes near an edge to the doubles. The distance is that of
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
    return {subtract_product(x, splat8(ray.shear_x), z), subtract_product(y, splat8(ray.shear_y), z),
            z};
}

TRG_FN Float8 edge_function(const ShearedCorner& a, const ShearedCorner& b) {
    return subtract_product(a.x * b.y, a.y, b.x);
}

TRG_FN LaneMasks filter_lanes(const CornerBlock& block, const TracedRay& ray) {
    const ShearedCorner a = shear_corner(block.corner[0], ray);
    const ShearedCorner b = shear_corner(block.corner[1], ray);
    const ShearedCorner c = shear_corner(block.corner[2], ray);
    const Float8 u = edge_function(b, c), v = edge_function(c, a), w = edge_function(a, b);

    // |error| <= 2^-24 m (16 m + 20 r), m the largest |x|, |y| and r the largest |z| of the corners;
    // the constant term keeps products that underflow on the safe side.
    const Float8 m = max_abs8(max_abs8(max_abs8(a.x, a.y), max_abs8(b.x, b.y)), max_abs8(c.x, c.y));
    const Float8 r = max_abs8(max_abs8(a.z, b.z), c.z);
    const Float8 bound = multiply_add(m * splat8(24 * 0x1p-24f), m + r, splat8(1e-36f));

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

TRG_FN EdgeFunctions edge_functions(const CornerBlock& block, int lane, const TracedRay& ray) {
    const Vec3d a = corner_of(block, 0, lane) - ray.origin_d;
    const Vec3d b = corner_of(block, 1, lane) - ray.origin_d;
    const Vec3d c = corner_of(block, 2, lane) - ray.origin_d;
    return {dot(ray.direction_d, cross(b, c)), dot(ray.direction_d, cross(c, a)),
            dot(ray.direction_d, cross(a, b))};
}

TRG_FN bool is_inside(const EdgeFunctions& e) {
    return (e.u >= 0 && e.v >= 0 && e.w >= 0) || (e.u <= 0 && e.v <= 0 && e.w <= 0);
}

/// Distance to the plane of a lane's triangle; NaN or infinite when the ray runs within it.
TRG_FN float plane_distance(const CornerBlock& block, int lane, const TracedRay& ray) {
    const Vec3d p0 = corner_of(block, 0, lane);
    const Vec3d n = cross(corner_of(block, 1, lane) - p0, corner_of(block, 2, lane) - p0);
    return static_cast<float>(dot(n, p0 - ray.origin_d) / dot(n, ray.direction_d));
}

TRG_FN void test_closest(const CornerBlock& block, const TracedRay& ray, Search& search) {
    const LaneMasks lanes = filter_lanes(block, ray);
    for (uint32_t left = lanes.possible; left; left &= left - 1) {
        const int lane = lowest_bit(left);
        const float t = plane_distance(block, lane, ray);
        if (!(t > ray.t_min) || !improves(search, t, block.prim[lane])) continue;
        const bool certain = (lanes.certain >> lane) & 1;
        if (!certain && !is_inside(edge_functions(block, lane, ray))) continue;
        record_hit(search, t, &block, lane, block.prim[lane]);
    }
}

TRG_FN bool test_any(const CornerBlock& block, const TracedRay& ray, float t_max) {
    const LaneMasks lanes = filter_lanes(block, ray);
    for (uint32_t left = lanes.possible; left; left &= left - 1) {
        const int lane = lowest_bit(left);
        const float t = plane_distance(block, lane, ray);
        if (!(t > ray.t_min && t < t_max)) continue;
        const bool certain = (lanes.certain >> lane) & 1;
        if (certain || is_inside(edge_functions(block, lane, ray))) return true;
    }
    return false;
}

struct Barycentrics {
    float u, v;
};

TRG_FN Barycentrics coordinates_of(const CornerBlock& block, int lane, const TracedRay& ray) {
    const EdgeFunctions e = edge_functions(block, lane, ray);
    const double scale = 1.0 / (e.u + e.v + e.w);
    return {static_cast<float>(e.v * scale), static_cast<float>(e.w * scale)};
}

}  // namespace trg::TRG_ISA

#include "accel/triangle_block.h"

#include <cmath>
#include <limits>

namespace trg {

namespace {

constexpr float kLargestCoordinate = 1e18f;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

bool is_sound(Vec3 p) {
    // Written so that NaN fails.
    return std::fabs(p.x) <= kLargestCoordinate && std::fabs(p.y) <= kLargestCoordinate &&
           std::fabs(p.z) <= kLargestCoordinate;
}

void put_vector(float (&rows)[3][kWidth], int lane, Vec3d v) {
    rows[0][lane] = static_cast<float>(v.x);
    rows[1][lane] = static_cast<float>(v.y);
    rows[2][lane] = static_cast<float>(v.z);
}

}  // namespace

bool is_sound(const TriangleCorners& triangle) {
    for (const Vec3& p : triangle.p)
        if (!is_sound(p)) return false;
    const Vec3d p0 = to_double(triangle.p[0]);
    const Vec3d n = cross(to_double(triangle.p[1]) - p0, to_double(triangle.p[2]) - p0);
    return dot(n, n) > 0;
}

CornerBlock empty_corner_block() {
    CornerBlock block;
    for (auto& corner : block.corner)
        for (auto& axis : corner)
            for (float& value : axis) value = kNaN;
    for (int32_t& prim : block.prim) prim = -1;
    return block;
}

void put_triangle(CornerBlock& block, int lane, const TriangleCorners& triangle, int32_t prim) {
    for (int k = 0; k < 3; ++k) {
        block.corner[k][0][lane] = triangle.p[k].x;
        block.corner[k][1][lane] = triangle.p[k].y;
        block.corner[k][2][lane] = triangle.p[k].z;
    }
    block.prim[lane] = prim;
}

PlaneBlock empty_plane_block() {
    PlaneBlock block{};
    for (float& value : block.distance) value = kNaN;
    for (int32_t& prim : block.prim) prim = -1;
    return block;
}

void put_triangle(PlaneBlock& block, int lane, const TriangleCorners& triangle, int32_t prim) {
    const Vec3d p0 = to_double(triangle.p[0]);
    const Vec3d e1 = to_double(triangle.p[1]) - p0, e2 = to_double(triangle.p[2]) - p0;
    const Vec3d across = cross(e1, e2);
    const double area2 = dot(across, across);
    const Vec3d n = across * (1 / std::sqrt(area2));
    const Vec3d u = cross(e2, across) * (1 / area2), v = cross(across, e1) * (1 / area2);
    put_vector(block.normal, lane, n);
    put_vector(block.u_axis, lane, u);
    put_vector(block.v_axis, lane, v);
    block.distance[lane] = static_cast<float>(-dot(n, p0));
    block.u_origin[lane] = static_cast<float>(dot(u, p0));
    block.v_origin[lane] = static_cast<float>(dot(v, p0));
    block.prim[lane] = prim;
}

}  // namespace trg

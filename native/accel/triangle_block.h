/// Eight triangles side by side: what one step of the SIMD triangle tests takes.
#pragma once

#include <cstdint>

#include "accel/wide_node.h"
#include "accel/world.h"

namespace trg {

/// Corners as they are, for the watertight test. Missing triangles have NaN corners and prim -1.
struct alignas(64) CornerBlock {
    float corner[3][3][kWidth];  // corner, axis, lane
    int32_t prim[kWidth];
};

/// The record of the TRG paper: plane N.P + D = 0 and the coordinates u = U1.P - u0, v = V1.P - v0,
/// computed in double.
struct alignas(64) PlaneBlock {
    float normal[3][kWidth], distance[kWidth];
    float u_axis[3][kWidth], u_origin[kWidth];
    float v_axis[3][kWidth], v_origin[kWidth];
    int32_t prim[kWidth];
};

struct TriangleCorners {
    Vec3 p[3];
};

/// True when the triangle can be hit: coordinates finite and at most 1e18, area not zero.
bool is_sound(const TriangleCorners& triangle);

CornerBlock empty_corner_block();
void put_triangle(CornerBlock& block, int lane, const TriangleCorners& triangle, int32_t prim);

PlaneBlock empty_plane_block();
void put_triangle(PlaneBlock& block, int lane, const TriangleCorners& triangle, int32_t prim);

}  // namespace trg

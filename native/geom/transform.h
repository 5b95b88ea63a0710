/// Affine maps of space, 3 x 4, row-major: what places a mesh in the world.
#pragma once

#include "base/vec3.h"

namespace trg {

struct Transform {
    float m[3][4];
};

TRG_FN Transform identity_transform() {
    return {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
}

TRG_FN bool is_identity(const Transform& a) {
    const Transform one = identity_transform();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            if (a.m[row][column] != one.m[row][column]) return false;
    return true;
}

TRG_FN Vec3 transform_vector(const Transform& a, Vec3 v) {
    return {a.m[0][0] * v.x + a.m[0][1] * v.y + a.m[0][2] * v.z,
            a.m[1][0] * v.x + a.m[1][1] * v.y + a.m[1][2] * v.z,
            a.m[2][0] * v.x + a.m[2][1] * v.y + a.m[2][2] * v.z};
}

TRG_FN Vec3 transform_point(const Transform& a, Vec3 p) {
    return transform_vector(a, p) + Vec3{a.m[0][3], a.m[1][3], a.m[2][3]};
}

/// `n` times the transpose of the linear part of `a`: with a = world to object this takes an object
/// normal to world space (not normalised).
TRG_FN Vec3 transform_transposed(const Transform& a, Vec3 n) {
    return {a.m[0][0] * n.x + a.m[1][0] * n.y + a.m[2][0] * n.z,
            a.m[0][1] * n.x + a.m[1][1] * n.y + a.m[2][1] * n.z,
            a.m[0][2] * n.x + a.m[1][2] * n.y + a.m[2][2] * n.z};
}

/// Determinant of the linear part, in double; negative for a mirroring map.
TRG_FN double determinant(const Transform& a) {
    const Vec3d r0{a.m[0][0], a.m[0][1], a.m[0][2]};
    const Vec3d r1{a.m[1][0], a.m[1][1], a.m[1][2]};
    const Vec3d r2{a.m[2][0], a.m[2][1], a.m[2][2]};
    return dot(r0, cross(r1, r2));
}

/// The inverse map, computed in double. The determinant must not be zero.
TRG_FN Transform inverse(const Transform& a) {
    const Vec3d r0{a.m[0][0], a.m[0][1], a.m[0][2]};
    const Vec3d r1{a.m[1][0], a.m[1][1], a.m[1][2]};
    const Vec3d r2{a.m[2][0], a.m[2][1], a.m[2][2]};
    const double scale = 1.0 / dot(r0, cross(r1, r2));
    const Vec3d c0 = cross(r1, r2) * scale, c1 = cross(r2, r0) * scale, c2 = cross(r0, r1) * scale;
    const double columns[3][3] = {{c0.x, c1.x, c2.x}, {c0.y, c1.y, c2.y}, {c0.z, c1.z, c2.z}};
    Transform result;
    for (int row = 0; row < 3; ++row) {
        double shift = 0;
        for (int k = 0; k < 3; ++k) {
            result.m[row][k] = static_cast<float>(columns[row][k]);
            shift -= columns[row][k] * a.m[k][3];
        }
        result.m[row][3] = static_cast<float>(shift);
    }
    return result;
}

/// The inverse map in double, with the translation apart, so that a small object far from the
/// origin keeps its precision.
struct InverseMap {
    double m[3][3];
    double translation[3];
};

/// The determinant of `a` must not be zero.
TRG_FN InverseMap inverse_map(const Transform& a) {
    const Vec3d r0{a.m[0][0], a.m[0][1], a.m[0][2]}, r1{a.m[1][0], a.m[1][1], a.m[1][2]};
    const Vec3d r2{a.m[2][0], a.m[2][1], a.m[2][2]};
    const double scale = 1.0 / dot(r0, cross(r1, r2));
    const Vec3d c[3] = {cross(r1, r2) * scale, cross(r2, r0) * scale, cross(r0, r1) * scale};
    InverseMap map;
    for (int k = 0; k < 3; ++k) {
        map.m[0][k] = c[k].x;
        map.m[1][k] = c[k].y;
        map.m[2][k] = c[k].z;
        map.translation[k] = a.m[k][3];
    }
    return map;
}

TRG_FN Vec3d vector_into(const InverseMap& map, Vec3d v) {
    const auto& m = map.m;
    return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
            m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
            m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}

TRG_FN Vec3d point_into(const InverseMap& map, Vec3d p) {
    return vector_into(map, p - Vec3d{map.translation[0], map.translation[1], map.translation[2]});
}

}  // namespace trg

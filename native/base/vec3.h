/// Vectors of three numbers, in float for data and in double for exact decisions.
#pragma once

#include <cmath>

#include "base/config.h"

namespace trg {

struct Vec3 {
    float x, y, z;
};

struct Vec3d {
    double x, y, z;
};

TRG_FN Vec3 operator+(Vec3 a, Vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
TRG_FN Vec3 operator-(Vec3 a, Vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
TRG_FN Vec3 operator-(Vec3 a) {
    return {-a.x, -a.y, -a.z};
}
TRG_FN Vec3 operator*(Vec3 a, Vec3 b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
TRG_FN Vec3 operator*(Vec3 a, float s) {
    return {a.x * s, a.y * s, a.z * s};
}
TRG_FN Vec3 operator*(float s, Vec3 a) {
    return a * s;
}
TRG_FN Vec3 operator/(Vec3 a, float s) {
    return a * (1.0f / s);
}
TRG_FN float dot(Vec3 a, Vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
TRG_FN Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
TRG_FN float length(Vec3 a) {
    return std::sqrt(dot(a, a));
}
/// `a` scaled to length 1; NaN for the null vector.
TRG_FN Vec3 normalize(Vec3 a) {
    return a / length(a);
}
TRG_FN bool is_finite(Vec3 a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

TRG_FN Vec3d to_double(Vec3 a) {
    return {a.x, a.y, a.z};
}
TRG_FN Vec3 to_float(Vec3d a) {
    return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}
TRG_FN Vec3d operator+(Vec3d a, Vec3d b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
TRG_FN Vec3d operator-(Vec3d a, Vec3d b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
TRG_FN Vec3d operator*(Vec3d a, double s) {
    return {a.x * s, a.y * s, a.z * s};
}
TRG_FN double dot(Vec3d a, Vec3d b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
TRG_FN Vec3d cross(Vec3d a, Vec3d b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace trg

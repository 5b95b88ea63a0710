/// Rays and what they hit: the plain records that cross from shading to acceleration and back.
#pragma once

#include <cstdint>
#include <limits>

#include "base/vec3.h"

namespace trg {

/// Points origin + t direction with t_min < t < t_max; a t_min below 0 counts as 0. `direction`
/// need not be unit.
struct Ray {
    Vec3 origin;
    float t_min;
    Vec3 direction;
    float t_max;
};

/// The nearest triangle: P = (1 - u - v) P0 + u P1 + v P2. A miss has t = inf, indices -1.
struct Hit {
    float t, u, v;
    int32_t triangle, instance;
};

TRG_FN Hit no_hit() {
    return {std::numeric_limits<float>::infinity(), 0.0f, 0.0f, -1, -1};
}

/// False when a number is not finite (an infinite t_max is allowed) or the direction is null:
/// such rays hit nothing.
TRG_FN bool is_traceable(const Ray& ray) {
    // Zero times a number is zero unless the number is infinite or NaN.
    const Vec3 o = ray.origin * 0.0f, d = ray.direction * 0.0f;
    const float zero = ((o.x + o.y) + (o.z + d.x)) + ((d.y + d.z) + ray.t_min * 0.0f);
    const bool directed = (ray.direction.x != 0) | (ray.direction.y != 0) | (ray.direction.z != 0);
    return (zero == 0) & directed & (ray.t_max > ray.t_min);
}

/// The mask of rays that meet every instance.
constexpr uint8_t kEveryRay = 0xff;

/// When one ray travels, 0 to 1 while the shutter is open, and the bits of instances that it meets.
struct RayTag {
    float time = 0.5f;
    uint8_t mask = kEveryRay;
};

/// What is told of rays beside where they go, one each: when they travel (null: in the middle of
/// the shutter), and the bits of instances that they meet (null: all).
struct RayTags {
    const float* times = nullptr;
    const uint8_t* masks = nullptr;
};

}  // namespace trg

/// A ray made ready for boxes and triangles of one space, and the best hit found so far.
#pragma once

#include <cmath>

#include "accel/wide8.h"
#include "accel/world_index.h"
#include "geom/motion.h"
#include "geom/ray.h"

namespace trg::TRG_ISA {

/// 1 + 2 gamma_3 and a little: how much a far plane's distance is raised so that rounding never
/// culls a box that the ray touches (Ize 2013; Pharr et al., Physically Based Rendering, 6.8).
constexpr float kFarFactor = 1.0000006f;

/// Origin and direction as exact decisions take them.
struct ExactRay {
    Vec3d origin_d, direction_d;
};

struct TracedRay : ExactRay {
    float origin[3], direction[3];
    float inverse[3];  // 1 / direction
    int sign[3];       // 1 where the direction is negative: the high plane is near
    float t_min;
    float time;              // 0 to 1 while the shutter is open
    uint8_t mask;            // of instances that it meets
    int kx, ky, kz;          // kz: the axis along which the direction is longest
    float shear_x, shear_y;  // direction[kx], direction[ky] over direction[kz]
};

TRG_INLINE_FN TracedRay prepare_ray(Vec3 origin, Vec3 direction, float t_min) {
    TracedRay ray;
    const float o[3] = {origin.x, origin.y, origin.z};
    const float d[3] = {direction.x, direction.y, direction.z};
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = o[axis];
        ray.direction[axis] = d[axis];
        ray.inverse[axis] = 1.0f / d[axis];
        ray.sign[axis] = std::signbit(d[axis]) ? 1 : 0;
    }
    ray.t_min = t_min;
    ray.time = kMiddleTime;
    ray.mask = kEveryRay;
    // Without branches: which axis is longest is anyone's guess.
    constexpr int kNext[4] = {1, 2, 0, 0};
    const float x = std::fabs(d[0]), y = std::fabs(d[1]), z = std::fabs(d[2]);
    const int y_over_x = y > x, z_over_both = (z > x) & (z > y);
    ray.kz = (z_over_both << 1) | (y_over_x & ~z_over_both);
    ray.kx = kNext[ray.kz];
    ray.ky = kNext[ray.kx];
    ray.shear_x = d[ray.kx] * ray.inverse[ray.kz];
    ray.shear_y = d[ray.ky] * ray.inverse[ray.kz];
    ray.origin_d = to_double(origin);
    ray.direction_d = to_double(direction);
    return ray;
}

/// The best hit so far. `limit` is what boxes must not lie beyond: t raised by kFarFactor, so that
/// of two equal hits the one with the lower number is always found.
struct Search {
    float t;
    float limit;
    int32_t prim;
    int32_t lane;
    const void* block;
    const Placement* placement;  // of the best hit
    const Placement* current;    // being searched
};

TRG_FN Search start_search(float t_max) {
    return {t_max, t_max * kFarFactor, -1, 0, nullptr, nullptr, nullptr};
}

TRG_FN PrimOrigin origin_of(const Placement& placement, int32_t prim) {
    if (placement.instance >= 0) return {placement.instance, prim};
    return placement.soup->origins[prim];
}

/// True when `prim` of the current placement comes before the best hit in (instance, triangle).
TRG_FN bool comes_first(const Search& search, int32_t prim) {
    if (search.prim < 0) return false;
    const PrimOrigin a = origin_of(*search.current, prim);
    const PrimOrigin b = origin_of(*search.placement, search.prim);
    return a.instance != b.instance ? a.instance < b.instance : a.triangle < b.triangle;
}

/// True when a hit at `t` would replace the best one.
TRG_FN bool improves(const Search& search, float t, int32_t prim) {
    return t < search.t || (t == search.t && comes_first(search, prim));
}

/// A search for what comes after a known hit, in the order of (t, instance, triangle).
struct SearchBeyond : Search {
    float after;
    PrimOrigin met;
};

TRG_FN bool improves(const SearchBeyond& search, float t, int32_t prim) {
    if (t == search.after) {
        const PrimOrigin at = origin_of(*search.current, prim);
        if (at.instance < search.met.instance ||
            (at.instance == search.met.instance && at.triangle <= search.met.triangle))
            return false;
    }
    return improves(static_cast<const Search&>(search), t, prim);
}

TRG_FN void record_hit(Search& search, float t, const void* block, int lane, int32_t prim) {
    search.t = t;
    search.limit = t * kFarFactor;
    search.prim = prim;
    search.lane = lane;
    search.block = block;
    search.placement = search.current;
}

}  // namespace trg::TRG_ISA

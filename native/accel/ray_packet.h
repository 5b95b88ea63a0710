/// Sixteen rays that go much the same way, traced together.
///
/// The tree is walked once for all of them: the beam that holds them discards children, then each
/// ray is tested by itself; triangles are met with the same exact decisions as by a ray alone.
#pragma once

#include "accel/walk_tree.h"
#include "accel/wide16.h"

namespace trg::TRG_ISA {

constexpr int kPacketRays = 16;
constexpr int kPacketGroups = kPacketRays / kWidth;

/// Rays side by side. What the float filter needs is relative to `centre`, a point among the
/// origins: a directed line is its (scaled) direction D and its moment D x (origin - centre).
struct alignas(64) RayPacket {
    float origin[3][kPacketRays], direction[3][kPacketRays];
    float line[3][kPacketRays], moment[3][kPacketRays];
    float t_min[kPacketRays], t_max[kPacketRays];
    // Distances to planes, as QuickBoxTest has them.
    float inverse[3][kPacketRays], far_inverse[3][kPacketRays];
    float near_shift[3][kPacketRays], far_shift[3][kPacketRays];
    float centre[3];
    float line_low[3], line_high[3];      // of `line`
    float moment_low[3], moment_high[3];  // of `moment`
    float spread;                         // largest component of an origin - centre
    float line_length;                    // largest |x| + |y| + |z| of `line`
    RayBounds bounds;
    const float* times;  // of each ray; null: all in the middle of the shutter
    uint32_t ready;      // bits of the rays in `alone`
    TracedRay alone[kPacketRays];
};

/// Ray k as rays alone are; made when first asked for.
TRG_INLINE_FN const TracedRay& lane_ray(RayPacket& packet, int k) {
    if (!((packet.ready >> k) & 1)) {
        packet.ready |= 1u << k;
        packet.alone[k] =
            prepare_ray({packet.origin[0][k], packet.origin[1][k], packet.origin[2][k]},
                        {packet.direction[0][k], packet.direction[1][k], packet.direction[2][k]},
                        packet.t_min[k]);
        if (packet.times) packet.alone[k].time = packet.times[k];
    }
    return packet.alone[k];
}

/// The least and the largest of the eight numbers of each ray, in the order of Ray.
struct RayExtent {
    alignas(32) float low[kWidth], high[kWidth];
    bool finite;
};

TRG_FN RayExtent extent_of(const Ray* rays) {
    static_assert(sizeof(Ray) == kWidth * sizeof(float), "a ray is one row of eight");
    const Float8 zero = splat8(0.0f);
    Float8 low = load_row(&rays[0].origin.x), high = low, sum = zero;
    for (int k = 0; k < kPacketRays; ++k) {
        const Float8 row = load_row(&rays[k].origin.x);
        low = min8(row, low);
        high = max8(row, high);
        sum = multiply_add(row, zero, sum);
    }
    RayExtent extent;
    alignas(32) float check[kWidth];
    store8(extent.low, low);
    store8(extent.high, high);
    store8(check, sum);
    // Zero times a number is zero unless it is infinite or NaN; t_max, the last, may be infinite.
    extent.finite = true;
    for (int k = 0; k + 1 < kWidth; ++k) extent.finite = extent.finite & (check[k] == 0);
    return extent;
}

/// How far origins and slopes may lie apart in a packet that is worth its while; `reach` is the
/// size of the scene.
struct Coherence {
    float slope = 0.35f;
    float origin = 1.0f / 24;
};

/// Whether rays of this extent go the same way along each axis, with ordinary numbers.
TRG_FN bool has_one_octant(const RayExtent& extent) {
    constexpr float kLargest = 1e12f, kFarthest = 1e15f;
    bool same = extent.finite;
    for (int axis = 0; axis < 3; ++axis) {
        const float low = extent.low[4 + axis], high = extent.high[4 + axis];
        const float nearest = low > 0 ? low : -high, farthest = low > 0 ? high : -low;
        same = same & ((low > 0) | (high < 0)) & (nearest > 1 / kLargest) & (farthest < kLargest) &
               (std::fabs(extent.low[axis]) < kFarthest) &
               (std::fabs(extent.high[axis]) < kFarthest);
    }
    return same;
}

/// Whether rays of this extent go about the same way, from about the same place.
TRG_FN bool is_narrow(const RayExtent& extent, float reach) {
    const Coherence most;
    float longest = 0, widest = 0, apart = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const float low = extent.low[4 + axis], high = extent.high[4 + axis];
        longest = std::fmax(longest, std::fmax(std::fabs(low), std::fabs(high)));
        widest = std::fmax(widest, high - low);
        apart = std::fmax(apart, extent.high[axis] - extent.low[axis]);
    }
    return (widest <= most.slope * longest) & (apart <= most.origin * reach);
}

/// The range of distances at which the rays can cross planes: of each axis the origins and inverse
/// directions that give the nearest and the farthest.
TRG_FN RayBounds bounds_of(const RayExtent& extent) {
    RayBounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
        const float low = extent.low[4 + axis], high = extent.high[4 + axis];
        const int negative = low > 0 ? 0 : 1;
        bounds.sign[axis] = negative;
        bounds.near_origin[axis] = negative ? extent.low[axis] : extent.high[axis];
        bounds.far_origin[axis] = negative ? extent.high[axis] : extent.low[axis];
        bounds.near_inverse[axis] = 1.0f / (negative ? low : high);
        bounds.far_inverse[axis] = 1.0f / (negative ? high : low);
    }
    bounds.t_min = extent.low[3] > 0 ? extent.low[3] : 0.0f;
    return bounds;
}

/// The least and the largest of sixteen numbers.
TRG_FN void range_of(const float (&row)[kPacketRays], float* low, float* high) {
    float least = row[0], most = row[0];
    for (int k = 1; k < kPacketRays; ++k) {
        least = row[k] < least ? row[k] : least;
        most = row[k] > most ? row[k] : most;
    }
    *low = least;
    *high = most;
}

/// Directions scaled by a power of two to components of at most 2, and moments about the centre.
TRG_FN void fill_lines(RayPacket& packet, const RayExtent& extent) {
    float longest = 0;
    packet.spread = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const float low = std::fabs(extent.low[4 + axis]), high = std::fabs(extent.high[4 + axis]);
        longest = std::fmax(longest, std::fmax(low, high));
        packet.centre[axis] = packet.origin[axis][0];
        packet.spread = std::fmax(packet.spread, extent.high[axis] - extent.low[axis]);
    }
    const float scale = std::ldexp(1.0f, -std::ilogb(longest));
    packet.line_length = 0;
    for (int axis = 0; axis < 3; ++axis) {
        for (int k = 0; k < kPacketRays; ++k)
            packet.line[axis][k] = packet.direction[axis][k] * scale;
        const float low = extent.low[4 + axis] * scale, high = extent.high[4 + axis] * scale;
        packet.line_low[axis] = low;
        packet.line_high[axis] = high;
        packet.line_length += std::fmax(std::fabs(low), std::fabs(high));
    }
    if (packet.spread == 0) return;
    for (int axis = 0; axis < 3; ++axis) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        for (int k = 0; k < kPacketRays; ++k)
            packet.moment[axis][k] = packet.line[a][k] * (packet.origin[b][k] - packet.centre[b]) -
                                     packet.line[b][k] * (packet.origin[a][k] - packet.centre[a]);
        range_of(packet.moment[axis], &packet.moment_low[axis], &packet.moment_high[axis]);
    }
}

/// Readies the test of each ray against boxes.
TRG_FN void fill_box_test(RayPacket& packet) {
    constexpr float kSlack = 4 * 0x1p-24f;
    for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < kPacketRays; ++k) {
            const float inverse = 1.0f / packet.direction[axis][k];
            const float shift = packet.origin[axis][k] * inverse;
            const float slack = std::fabs(shift) * kSlack;
            packet.inverse[axis][k] = inverse;
            packet.far_inverse[axis][k] = inverse * kFarFactor;
            packet.near_shift[axis][k] = -shift - slack;
            packet.far_shift[axis][k] = (-shift + slack) * kFarFactor;
        }
}

/// False, at little cost, where a few of the rays show that all do not go the same way.
TRG_INLINE_FN bool may_go_together(const Ray* rays) {
    const Vec3 a = rays[0].direction;
    bool may = true;
    for (const int k : {kPacketRays / 3, 2 * kPacketRays / 3, kPacketRays - 1}) {
        const Vec3 b = rays[k].direction;
        may = may & (a.x * b.x > 0) & (a.y * b.y > 0) & (a.z * b.z > 0);
    }
    return may;
}

/// Makes a packet of rays[0..kPacketRays), each of which is traceable; false when it cannot be one:
/// or when they are too far apart for a world as large as `reach`. `times`, kept, may be null.
TRG_FN bool make_packet(const Ray* rays, const float* times, float reach, RayPacket& packet) {
    const RayExtent extent = extent_of(rays);
    if (!has_one_octant(extent) || !is_narrow(extent, reach)) return false;
    bool open = true;
    for (int k = 0; k < kPacketRays; ++k) {
        const Ray& ray = rays[k];
        packet.origin[0][k] = ray.origin.x;
        packet.origin[1][k] = ray.origin.y;
        packet.origin[2][k] = ray.origin.z;
        packet.direction[0][k] = ray.direction.x;
        packet.direction[1][k] = ray.direction.y;
        packet.direction[2][k] = ray.direction.z;
        packet.t_min[k] = ray.t_min > 0 ? ray.t_min : 0.0f;
        packet.t_max[k] = ray.t_max;
        open = open & (ray.t_max > packet.t_min[k]);
    }
    if (!open) return false;
    packet.times = times;
    packet.ready = 0;
    packet.bounds = bounds_of(extent);
    if (!QuickBoxTest::fits(packet.bounds)) return false;
    fill_box_test(packet);
    fill_lines(packet, extent);
    return true;
}

}  // namespace trg::TRG_ISA

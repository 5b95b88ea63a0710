/// Sixteen rays against eight triangles: the watertight test, its float filter in Pluecker's form.
///
/// A triangle's edges and their moments are computed once for all rays. The beam of the rays
/// discards most triangles; for the others an edge function is a dot product per ray (Shevtsov et
/// al. 2007 go the same way for a kd-tree). Which hits count, and where, is decided as for a ray
/// alone.
#pragma once

#include "accel/ray_packet.h"
#include "accel/test_watertight.h"

namespace trg::TRG_ISA {

/// The best hits of a packet so far, or which of its rays have met anything.
struct PacketSearch {
    alignas(64) float t[kPacketRays];  // how far each ray looks
    Search ray[kPacketRays];
    uint32_t live;   // rays that still look
    float farthest;  // how far boxes may lie: the largest t, raised by kFarFactor
};

/// Sets `farthest` again after some t became smaller.
TRG_FN void shorten(PacketSearch& search) {
    float farthest = search.t[0];
    for (int k = 1; k < kPacketRays; ++k)
        farthest = search.t[k] > farthest ? search.t[k] : farthest;
    search.farthest = farthest * kFarFactor;
}

TRG_FN ExactRay exact_ray(const RayPacket& packet, int k) {
    return {{packet.origin[0][k], packet.origin[1][k], packet.origin[2][k]},
            {packet.direction[0][k], packet.direction[1][k], packet.direction[2][k]}};
}

/// Edges of eight triangles, and their moments about the packet's centre: edge k is opposite corner
/// k. An edge function is line . moment - edge . (moment of the line), exact within `bound`.
struct BlockEdges {
    alignas(64) float edge[3][3][kWidth];
    float moment[3][3][kWidth];
    float bound[kWidth];
};

struct Vec8 {
    Float8 v[3];
};

TRG_FN Vec8 difference(const float (&a)[3][kWidth], const float (&b)[3][kWidth]) {
    Vec8 d;
    for (int axis = 0; axis < 3; ++axis) d.v[axis] = load8(a[axis]) - load8(b[axis]);
    return d;
}

TRG_FN Vec8 cross(const Vec8& a, const Vec8& b) {
    return {{subtract_product(a.v[1] * b.v[2], a.v[2], b.v[1]),
             subtract_product(a.v[2] * b.v[0], a.v[0], b.v[2]),
             subtract_product(a.v[0] * b.v[1], a.v[1], b.v[0])}};
}

TRG_FN Float8 largest(const Vec8& a, Float8 start) {
    return max_abs8(max_abs8(a.v[0], a.v[1]), max_abs8(a.v[2], start));
}

/// What an edge function of the packet's lines can be: its middle and how far it may be off.
struct EdgeRange {
    Float8 middle, radius;
};

/// Adds the range of (range of the numbers low..high) * v.
TRG_FN void add_range(EdgeRange* sum, Float8 v, float low, float high) {
    // Rounding of middle and radius is a few units of the largest of the numbers.
    const float middle = 0.5f * (low + high);
    const float radius = 0.5f * (high - low) + 0x1p-22f * std::fabs(middle);
    sum->middle = multiply_add(v, splat8(middle), sum->middle);
    sum->radius = multiply_add(abs8(v), splat8(radius), sum->radius);
}

/// Fills `edges`; returns the triangles that the beam of the packet may meet.
template <bool kOneOrigin>
TRG_FN uint32_t relate_block(const CornerBlock& block, const RayPacket& packet, BlockEdges& edges) {
    const Float8 zero = splat8(0.0f);
    Float8 reach = splat8(packet.spread), size = zero;
    Float8 least = splat8(HUGE_VALF), most = splat8(-HUGE_VALF);
    for (int k = 0; k < 3; ++k) {
        const int from = (k + 1) % 3, to = (k + 2) % 3;
        Vec8 corner;
        for (int axis = 0; axis < 3; ++axis)
            corner.v[axis] = load8(block.corner[from][axis]) - splat8(packet.centre[axis]);
        const Vec8 edge = difference(block.corner[to], block.corner[from]);
        const Vec8 moment = cross(corner, edge);
        reach = largest(corner, reach);
        size = largest(edge, size);
        EdgeRange range{zero, zero};
        for (int axis = 0; axis < 3; ++axis) {
            store8(edges.edge[k][axis], edge.v[axis]);
            store8(edges.moment[k][axis], moment.v[axis]);
            add_range(&range, moment.v[axis], packet.line_low[axis], packet.line_high[axis]);
            if (!kOneOrigin)
                add_range(&range, edge.v[axis], -packet.moment_high[axis],
                          -packet.moment_low[axis]);
        }
        least = min8(range.middle + range.radius, least);
        most = max8(range.middle - range.radius, most);
    }
    // |error| <= 48 * 2^-24 times the lengths of line, edge and way to it; twice that for the beam.
    const Float8 unit = splat8(64 * 0x1p-24f * packet.line_length);
    const Float8 bound = multiply_add(unit * (reach + splat8(packet.spread)), size, splat8(1e-36f));
    store8(edges.bound, bound);
    const Float8 wide = bound + bound;
    return mask_less_equal(negate8(wide), least) | mask_less_equal(most, wide);
}

/// The rays of a group of eight that may pass inside a triangle, and those that surely do.
struct GroupMasks {
    int group;
    uint32_t possible, certain;
};

/// Which of the eight rays of group `group` pass triangle `lane` inside.
template <bool kOneOrigin>
TRG_INLINE_FN GroupMasks filter_rays(const BlockEdges& edges, int lane, const RayPacket& packet,
                                     int group) {
    const int first = group * kWidth;
    Float8 value[3];
    for (int k = 0; k < 3; ++k) {
        value[k] = splat8(edges.moment[k][0][lane]) * load8(packet.line[0] + first);
        for (int axis = 1; axis < 3; ++axis)
            value[k] = multiply_add(splat8(edges.moment[k][axis][lane]),
                                    load8(packet.line[axis] + first), value[k]);
        if (kOneOrigin) continue;
        for (int axis = 0; axis < 3; ++axis)
            value[k] = subtract_product(value[k], splat8(edges.edge[k][axis][lane]),
                                        load8(packet.moment[axis] + first));
    }
    const Float8 least = min8(min8(value[0], value[1]), value[2]);
    const Float8 most = max8(max8(value[0], value[1]), value[2]);
    const Float8 bound = splat8(edges.bound[lane]), minus = splat8(-edges.bound[lane]);
    return {group, mask_less_equal(minus, least) | mask_less_equal(most, bound),
            mask_less(bound, least) | mask_less(most, minus)};
}

/// One triangle of a block.
struct LaneOf {
    const CornerBlock& block;
    int lane;
};

struct PlaneOfLane {
    Vec3d normal, point;
};

TRG_FN PlaneOfLane plane_of(const CornerBlock& block, int lane) {
    const Vec3d p0 = corner_of(block, 0, lane);
    return {cross(corner_of(block, 1, lane) - p0, corner_of(block, 2, lane) - p0), p0};
}

/// Distances of a group's rays to a plane, step by step as plane_distance has them.
TRG_FN void plane_distances(const PlaneOfLane& plane, const RayPacket& packet, int group,
                            float (&t)[kWidth]) {
    const Vec3d n = plane.normal, p = plane.point;
    for (int k = 0; k < kWidth; ++k) {
        const int ray = group * kWidth + k;
        const Vec3d way{p.x - packet.origin[0][ray], p.y - packet.origin[1][ray],
                        p.z - packet.origin[2][ray]};
        const Vec3d direction{packet.direction[0][ray], packet.direction[1][ray],
                              packet.direction[2][ray]};
        t[k] = static_cast<float>(dot(n, way) / dot(n, direction));
    }
}

/// Distances along the rays of a group.
struct GroupDistances {
    alignas(32) float t[kWidth];
};

/// The rays of a group that meet triangle `lane` in front of `before` (or there), with their
/// distances.
TRG_FN uint32_t meet_rays(const LaneOf& triangle, const GroupMasks& rays, const RayPacket& packet,
                          const float* before, GroupDistances& distances) {
    float (&t)[kWidth] = distances.t;
    const int group = rays.group;
    plane_distances(plane_of(triangle.block, triangle.lane), packet, group, t);
    const int first = group * kWidth;
    for (uint32_t left = rays.possible & ~rays.certain; left; left &= left - 1) {
        const int k = lowest_bit(left);
        t[k] = lane_distance(triangle.block, triangle.lane, false, exact_ray(packet, first + k));
    }
    const Float8 at = load8(t);
    return rays.possible & mask_less(load8(packet.t_min + first), at) &
           mask_less_equal(at, load8(before + first));
}

/// Tests those rays of a packet whose bits are set in `among`.
template <bool kOneOrigin>
TRG_FN void test_closest(const CornerBlock& block, const RayPacket& packet, uint32_t among,
                         PacketSearch& search) {
    BlockEdges edges;
    for (uint32_t lanes = relate_block<kOneOrigin>(block, packet, edges); lanes;
         lanes &= lanes - 1) {
        const int lane = lowest_bit(lanes);
        for (int group = 0; group < kPacketGroups; ++group) {
            GroupMasks rays = filter_rays<kOneOrigin>(edges, lane, packet, group);
            rays.possible &= among >> (group * kWidth);
            if (!rays.possible) continue;
            GroupDistances distances;
            const float (&t)[kWidth] = distances.t;
            uint32_t met = meet_rays({block, lane}, rays, packet, search.t, distances);
            for (; met; met &= met - 1) {
                const int k = lowest_bit(met), ray = group * kWidth + k;
                if (!improves(search.ray[ray], t[k], block.prim[lane])) continue;
                record_hit(search.ray[ray], t[k], &block, lane, block.prim[lane]);
                search.t[ray] = t[k];
            }
        }
    }
}

/// Takes those rays from the living that meet a triangle of the block.
template <bool kOneOrigin>
TRG_FN void test_any(const CornerBlock& block, const RayPacket& packet, uint32_t among,
                     PacketSearch& search) {
    BlockEdges edges;
    for (uint32_t lanes = relate_block<kOneOrigin>(block, packet, edges); lanes;
         lanes &= lanes - 1) {
        const int lane = lowest_bit(lanes);
        for (int group = 0; group < kPacketGroups; ++group) {
            GroupMasks rays = filter_rays<kOneOrigin>(edges, lane, packet, group);
            rays.possible &= (among & search.live) >> (group * kWidth);
            if (!rays.possible) continue;
            GroupDistances distances;
            const float (&t)[kWidth] = distances.t;
            const uint32_t met = meet_rays({block, lane}, rays, packet, search.t, distances) &
                                 mask_less(load8(t), load8(search.t + group * kWidth));
            search.live &= ~(met << (group * kWidth));
        }
    }
}

}  // namespace trg::TRG_ISA

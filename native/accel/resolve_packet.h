/// From the best hits of a packet to what is told of them.
#pragma once

#include "accel/trace_packet.h"

namespace trg::TRG_ISA {

/// Triangles met and the rays that met them, in the triangles' spaces, side by side.
struct HitLanes {
    double corner[3][3][kPacketRays];  // corner, axis, ray
    double origin[3][kPacketRays], direction[3][kPacketRays];
    alignas(64) float u[kPacketRays], v[kPacketRays];
};

TRG_INLINE_FN Vec3d lane_of(const double (&rows)[3][kPacketRays], int k) {
    return {rows[0][k], rows[1][k], rows[2][k]};
}

TRG_INLINE_FN void put_lane(double (&rows)[3][kPacketRays], int k, Vec3d v) {
    rows[0][k] = v.x;
    rows[1][k] = v.y;
    rows[2][k] = v.z;
}

/// Fills lane k; with zeros where no triangle was met.
TRG_FN void put_hit(const Search& search, const RayPacket& packet, int k, HitLanes& lanes) {
    const Vec3d zero{0, 0, 0};
    ExactRay ray = exact_ray(packet, k);
    if (search.block && !search.placement->identity) {
        const InverseMap& into = search.placement->into;
        ray = {to_double(rounded(point_into(into, ray.origin_d))),
               to_double(rounded(vector_into(into, ray.direction_d)))};
    }
    put_lane(lanes.origin, k, ray.origin_d);
    put_lane(lanes.direction, k, ray.direction_d);
    const auto* block = static_cast<const CornerBlock*>(search.block);
    for (int corner = 0; corner < 3; ++corner)
        put_lane(lanes.corner[corner], k, block ? corner_of(*block, corner, search.lane) : zero);
}

/// Coordinates of all hits, step by step as coordinates_of has them for one.
TRG_FN void fill_coordinates(HitLanes& lanes) {
    for (int k = 0; k < kPacketRays; ++k) {
        const Vec3d a = lane_of(lanes.corner[0], k), b = lane_of(lanes.corner[1], k);
        const Vec3d c = lane_of(lanes.corner[2], k), origin = lane_of(lanes.origin, k);
        const RelativeCorners corners{a - origin, b - origin, c - origin, c - b, a - c, b - a};
        const Barycentrics at =
            coordinates_of(edge_functions(corners, lane_of(lanes.direction, k)));
        lanes.u[k] = at.u;
        lanes.v[k] = at.v;
    }
}

/// The hit of ray k, whose coordinates are there where it met a triangle that stands still.
TRG_FN Hit resolve_hit(const Search& search, const HitLanes& lanes, RayPacket& packet, int k) {
    if (search.prim < 0) return no_hit();
    const Placement& placement = *search.placement;
    if (!search.block || placement.key_count > 0)
        return resolve_hit<CornerBlock>(search, lane_ray(packet, k), 1.0f);
    if (!(search.t < HUGE_VALF)) return no_hit();
    const PrimOrigin origin = origin_of(placement, search.prim);
    return {search.t, lanes.u[k], lanes.v[k], origin.triangle, origin.instance};
}

TRG_FN void resolve_hits(const PacketSearch& search, RayPacket& packet, Hit* hits) {
    HitLanes lanes;
    for (int k = 0; k < kPacketRays; ++k) put_hit(search.ray[k], packet, k, lanes);
    fill_coordinates(lanes);
    for (int k = 0; k < kPacketRays; ++k) hits[k] = resolve_hit(search.ray[k], lanes, packet, k);
}

}  // namespace trg::TRG_ISA

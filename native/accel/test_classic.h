/// Ray against eight triangles as the TRG paper has it: plane, then two dot products for u and v.
/// Rays at a shared edge may slip through; the watertight test is the default.
#pragma once

#include "accel/test_watertight.h"
#include "accel/traced_ray.h"
#include "accel/triangle_block.h"

namespace trg::TRG_ISA {

struct PlaneHits {
    Float8 t, u, v;
};

TRG_FN Float8 dot8(const float (&rows)[3][kWidth], const float (&v)[3], Float8 start) {
    const Float8 x = multiply_add(load8(rows[0]), splat8(v[0]), start);
    return multiply_add(load8(rows[2]), splat8(v[2]),
                        multiply_add(load8(rows[1]), splat8(v[1]), x));
}

TRG_FN PlaneHits meet_planes(const PlaneBlock& block, const TracedRay& ray) {
    const Float8 zero = splat8(0.0f);
    const Float8 height = dot8(block.normal, ray.origin, load8(block.distance));
    const Float8 t = negate8(height / dot8(block.normal, ray.direction, zero));
    const Float8 u0 = dot8(block.u_axis, ray.origin, negate8(load8(block.u_origin)));
    const Float8 v0 = dot8(block.v_axis, ray.origin, negate8(load8(block.v_origin)));
    return {t, multiply_add(t, dot8(block.u_axis, ray.direction, zero), u0),
            multiply_add(t, dot8(block.v_axis, ray.direction, zero), v0)};
}

TRG_FN uint32_t lanes_inside(const PlaneHits& hits, float t_min, float t_max) {
    const Float8 zero = splat8(0.0f);
    return mask_less_equal(zero, hits.u) & mask_less_equal(zero, hits.v) &
           mask_less_equal(hits.u + hits.v, splat8(1.0f)) & mask_less(splat8(t_min), hits.t) &
           mask_less_equal(hits.t, splat8(t_max));
}

template <class AnySearch>
TRG_FN void test_closest(const PlaneBlock& block, const TracedRay& ray, AnySearch& search) {
    const PlaneHits hits = meet_planes(block, ray);
    uint32_t left = lanes_inside(hits, ray.t_min, search.t);
    if (!left) return;
    float t[kWidth];
    store8(t, hits.t);
    for (; left; left &= left - 1) {
        const int lane = lowest_bit(left);
        if (improves(search, t[lane], block.prim[lane]))
            record_hit(search, t[lane], &block, lane, block.prim[lane]);
    }
}

TRG_FN bool test_any(const PlaneBlock& block, const TracedRay& ray, float t_max) {
    const PlaneHits hits = meet_planes(block, ray);
    return (lanes_inside(hits, ray.t_min, t_max) & mask_less(hits.t, splat8(t_max))) != 0;
}

TRG_FN Barycentrics coordinates_of(const PlaneBlock& block, int lane, const TracedRay& ray) {
    const PlaneHits hits = meet_planes(block, ray);
    float u[kWidth], v[kWidth];
    store8(u, hits.u);
    store8(v, hits.v);
    return {u[lane], v[lane]};
}

}  // namespace trg::TRG_ISA

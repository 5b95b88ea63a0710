/// Boxes as two rows of four floats, for the inner loops of tree building.
#pragma once

#include "accel/split.h"
#include "base/float4.h"

namespace trg {

/// A box as two rows; the fourth column means nothing.
struct Box4 {
    Float4 lo, hi;
};

TRG_FN Box4 empty_box() {
    return {splat4(HUGE_VALF), splat4(-HUGE_VALF)};
}

TRG_FN Box4 united(const Box4& a, const Box4& b) {
    return {min4(a.lo, b.lo), max4(a.hi, b.hi)};
}

TRG_FN Box4 rows_of(const PrimRef& ref) {
    return {load4(&ref.lo.x), load4(&ref.hi.x)};
}

TRG_FN Bounds bounds_of(const Box4& box) {
    float lo[4], hi[4];
    store4(lo, box.lo);
    store4(hi, box.hi);
    return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
}

/// Half the surface; finite for the coordinates that sound triangles have.
TRG_FN float half_area_of(const Box4& box) {
    float d[4];
    store4(d, box.hi - box.lo);
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

/// What a part of a tree costs: its surface times the blocks that its items fill.
TRG_FN double cost_of(const Box4& box, int64_t items, int block_width) {
    return half_area_of(box) * static_cast<double>((items + block_width - 1) / block_width);
}

/// Boxes of a range while it grows; the fourth number of a high corner is the item's need.
struct Extent {
    Box4 box;
    Box4 centres;
    Float4 need;
};

TRG_FN Extent empty_extent() {
    return {empty_box(), empty_box(), splat4(0)};
}

TRG_FN void grow(Extent* extent, const Box4& box) {
    const Float4 centre = box.lo + box.hi;
    extent->box = united(extent->box, box);
    extent->centres = united(extent->centres, Box4{centre, centre});
    extent->need = extent->need + box.hi;
}

TRG_FN PrimRange range_of(int64_t begin, int64_t end, const Extent& extent) {
    float need[4];
    store4(need, extent.need);
    return {begin, end, bounds_of(extent.box), bounds_of(extent.centres), need[3], 0};
}

}  // namespace trg

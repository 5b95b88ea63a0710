/// Bins of doubled box centres along the three axes, and the cheapest plane between two of them.
#pragma once

#include "accel/box4.h"

namespace trg {

constexpr int kMostBins = 32;

/// How doubled centres map to bins; along an axis without extent all go to bin 0.
struct Binning {
    Float4 low, scale, last;
    int count;
};

struct Bins {
    Box4 box[kMostBins][3];               // by bin and axis
    alignas(16) int items[kMostBins][4];  // of each bin along each axis; the fourth means nothing
};

/// The first bin of the right side, along one axis; axis -1: there is no plane.
struct BinPlane {
    double cost = HUGE_VAL;
    int axis = -1;
    int bin = 0;
};

Binning binning_of(const PrimRange& range);

/// The bins of a range, filled by several threads when it is long. Does not depend on how many.
void fill_bins(const PrimRef* refs, const PrimRange& range, const Binning& binning, int threads,
               Bins* bins);

/// The cheapest plane that leaves neither side empty: the boxes' surfaces times the blocks that
/// their items fill.
BinPlane choose_plane(const Bins& bins, int bin_count, const Bounds& whole, int block_width);

/// Boxes on both sides of a plane.
struct SideBoxes {
    Box4 left, right;
};
SideBoxes boxes_beside(const Bins& bins, int bin_count, const BinPlane& plane);

}  // namespace trg

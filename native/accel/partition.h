/// Reordering a range of references so that those on one side of a plane come first.
#pragma once

#include "accel/bins.h"

namespace trg {

/// Where a plane divides doubled centres: left is (centre - low) * scale < bin along `axis`.
struct CentrePlane {
    int axis;
    float low, scale, bin;
    bool with_needs;  // whether needs are summed
};

/// Puts the left references of `range` before the right ones and returns both halves without their
/// boxes. Does not depend on the number of threads.
void partition_range(PrimRef* refs, const PrimRange& range, const CentrePlane& plane, int threads,
                     PrimRange halves[2]);

}  // namespace trg

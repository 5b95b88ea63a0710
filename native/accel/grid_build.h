/// Grids over references: which items lie in which block of which cell.
#pragma once

#include "accel/grid.h"

namespace trg {

/// Items in runs of at most kWidth: block k holds items[begin[k]] to items[begin[k + 1]].
struct BlockItems {
    std::vector<int32_t> items;
    std::vector<int64_t> begin;  // one more than there are blocks
};

/// Cuts [first, last) into runs.
void cut_into_runs(BlockItems& runs, int64_t first, int64_t last);

/// Lays `index` over the references within `bounds` and returns its blocks. With `divide`, cells
/// where a finer grid is expected to be quicker get one. Does not depend on `threads`.
BlockItems build_grid(const PrimRefs& refs, const Bounds& bounds, bool divide, int threads,
                      GridIndex* index);

}  // namespace trg

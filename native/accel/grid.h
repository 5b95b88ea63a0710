/// A regular grid over boxes; each cell lists the items that touch it.
#pragma once

#include <vector>

#include "accel/split.h"

namespace trg {

/// Cells count in x first, then y, then z. Cell c has the blocks cell_begin[c] to cell_begin[c + 1].
struct Grid {
    int32_t size[3] = {0, 0, 0};
    double low[3] = {0, 0, 0};
    double cell[3] = {0, 0, 0};
    std::vector<uint32_t> cell_begin;
};

/// The items of every cell in a row: cell c has items[begin[c]] to items[begin[c + 1]].
struct CellLists {
    std::vector<int64_t> begin;
    std::vector<int32_t> items;
};

/// A grid of about two cells an item over `bounds`, padded so that no item lies on its border.
Grid lay_grid(const Bounds& bounds, int64_t item_count);

/// The indices of the references that touch each cell, closed and widened by 1e-4 of a cell, in
/// ascending order. Sets of references are capped at 2^31 entries: throws length_error above.
CellLists list_cells(const Grid& grid, const std::vector<PrimRef>& refs);

}  // namespace trg

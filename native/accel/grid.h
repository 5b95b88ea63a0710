/// Regular grids over boxes, some of them within cells of others; each cell lists the items that
/// touch it.
#pragma once

#include <vector>

#include "accel/split.h"

namespace trg {

/// What entering a finer grid costs, in tests of a block.
constexpr double kEnterCost = 3.0;

/// Cells count in x first, then y, then z; the grid's first cell is `first_cell` of its index.
struct Grid {
    int32_t size[3] = {0, 0, 0};
    int64_t first_cell = 0;
    double low[3] = {0, 0, 0};
    double cell[3] = {0, 0, 0};
};

TRG_FN int64_t cell_count(const Grid& grid) {
    return int64_t{grid.size[0]} * grid.size[1] * grid.size[2];
}

/// Blocks of one cell; cells with the same items have the same ones. With `end` kDivided, the cell
/// has a finer grid instead, number `begin`.
struct BlockRange {
    uint32_t begin, end;
};
constexpr uint32_t kDivided = 0xffffffffu;

/// Grid 0 and the finer ones within its cells and theirs; `cells` are those of all in a row.
struct GridIndex {
    std::vector<Grid> grids;
    std::vector<BlockRange> cells;
};

/// Grids within each other, at most.
constexpr int kMostGridLevels = 4;

/// The items of every cell in a row: cell c has items[begin[c]] to items[begin[c + 1]].
struct CellLists {
    std::vector<int64_t> begin;
    std::vector<int32_t> items;
};

/// A grid over `bounds`, padded so that no item lies on its border, with about `cells` cells.
Grid lay_grid(const Bounds& bounds, double cells);

/// What a ray that crosses the whole grid is expected to cost, in block tests, when the items are
/// `refs`: a random line meets a convex cell as often as the cell's share of the box's surface.
double expected_cost(const Grid& grid, const PrimRefs& refs);

/// The resolution at which `expected_cost` is least, searched by doubling and halving.
Grid best_grid(const Bounds& bounds, const PrimRefs& refs);

/// A coarser grid whose full cells are meant to be divided again.
Grid best_outer_grid(const Bounds& bounds, const PrimRefs& refs);

/// Box of cell `cell` of the grid.
Bounds cell_bounds(const Grid& grid, int64_t cell);

/// The indices of the references that touch each cell, closed and widened by 1e-4 of a cell, in
/// ascending order. Throws length_error above 2^31 entries.
CellLists list_cells(const Grid& grid, const PrimRefs& refs);

}  // namespace trg

#include "accel/grid_build.h"

#include <algorithm>

#include "accel/wide_node.h"
#include "base/parallel.h"

namespace trg {

namespace {

/// Cells with fewer items are never divided.
constexpr int64_t kFewItems = 2 * kWidth;
/// A finer grid must be expected to cost less than this share of the cell's blocks.
constexpr double kWorthwhile = 0.8;

/// A finer grid with the items of its cells, as indices of references; no cells: not worthwhile.
struct Division {
    Grid grid;
    CellLists lists;
};

Division divide_cell(const Bounds& box, const std::vector<PrimRef>& refs, const int32_t* items,
                     int64_t count) {
    std::vector<PrimRef> inside;
    inside.reserve(count);
    for (int64_t k = 0; k < count; ++k) inside.push_back(refs[items[k]]);
    Division division;
    const Grid grid = best_grid(box, inside);
    const double blocks = static_cast<double>((count + kWidth - 1) / kWidth);
    if (kEnterCost + expected_cost(grid, inside) > kWorthwhile * blocks) return division;
    division.grid = grid;
    division.lists = list_cells(grid, inside);
    for (int32_t& item : division.lists.items) item = items[item];
    return division;
}

std::vector<Division> divide_cells(const Grid& outer, const CellLists& lists,
                                   const std::vector<PrimRef>& refs, int threads) {
    std::vector<Division> divisions(cell_count(outer));
    parallel_for(cell_count(outer), 64, threads, [&](int64_t begin, int64_t end) {
        for (int64_t cell = begin; cell < end; ++cell) {
            const int64_t first = lists.begin[cell], count = lists.begin[cell + 1] - first;
            if (count < kFewItems) continue;
            divisions[cell] =
                divide_cell(cell_bounds(outer, cell), refs, lists.items.data() + first, count);
        }
    });
    return divisions;
}

/// Appends the cells of `lists`, whose items are indices of references.
void append_cells(const CellLists& lists, GridIndex* index, BlockItems* runs) {
    const auto shift = static_cast<int64_t>(runs->items.size());
    runs->items.insert(runs->items.end(), lists.items.begin(), lists.items.end());
    for (size_t cell = 0; cell + 1 < lists.begin.size(); ++cell) {
        cut_into_runs(*runs, shift + lists.begin[cell], shift + lists.begin[cell + 1]);
        index->cell_begin.push_back(static_cast<uint32_t>(runs->begin.size() - 1));
    }
}

/// `lists` without the items of the cells that were divided.
CellLists without_divided(const CellLists& lists, const std::vector<Division>& divisions) {
    CellLists left;
    left.begin.assign(1, 0);
    for (size_t cell = 0; cell < divisions.size(); ++cell) {
        if (divisions[cell].lists.begin.empty())
            left.items.insert(left.items.end(), lists.items.begin() + lists.begin[cell],
                              lists.items.begin() + lists.begin[cell + 1]);
        left.begin.push_back(static_cast<int64_t>(left.items.size()));
    }
    return left;
}

void add_divided(const CellLists& lists, const std::vector<PrimRef>& refs, int threads,
                 GridIndex* index, BlockItems* runs) {
    std::vector<Division> divisions = divide_cells(index->outer, lists, refs, threads);
    append_cells(without_divided(lists, divisions), index, runs);
    index->inner_of_cell.assign(divisions.size(), -1);
    for (size_t cell = 0; cell < divisions.size(); ++cell) {
        Division& division = divisions[cell];
        if (division.lists.begin.empty()) continue;
        index->inner_of_cell[cell] = static_cast<int32_t>(index->inner.size());
        division.grid.first_cell = static_cast<int64_t>(index->cell_begin.size()) - 1;
        index->inner.push_back(division.grid);
        append_cells(division.lists, index, runs);
        division = {};
    }
}

}  // namespace

void cut_into_runs(BlockItems& runs, int64_t first, int64_t last) {
    for (int64_t at = first; at < last; at += kWidth)
        runs.begin.push_back(std::min<int64_t>(at + kWidth, last));
}

BlockItems build_grid(const std::vector<PrimRef>& refs, const Bounds& bounds, bool divide, int threads,
                      GridIndex* index) {
    index->outer = divide ? best_outer_grid(bounds, refs) : best_grid(bounds, refs);
    BlockItems runs;
    runs.begin.assign(1, 0);
    index->cell_begin.assign(1, 0);
    const CellLists lists = list_cells(index->outer, refs);
    if (divide) add_divided(lists, refs, threads, index, &runs);
    else append_cells(lists, index, &runs);
    for (int32_t& item : runs.items) item = refs[item].item;
    return runs;
}

}  // namespace trg

#include "accel/grid_build.h"

#include <algorithm>
#include <unordered_map>

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

/// Blocks that exist already, by their items: long triangles give many cells the same list.
class KnownLists {
  public:
    /// The blocks with exactly these items; new ones are appended to `runs`.
    BlockRange find_or_add(const int32_t* items, int64_t count, BlockItems* runs) {
        const auto next = static_cast<uint32_t>(runs->begin.size() - 1);
        if (count == 0) return {next, next};
        uint64_t hash = 1469598103934665603u;
        for (int64_t k = 0; k < count; ++k)
            hash = (hash ^ static_cast<uint32_t>(items[k])) * 1099511628211u;
        const auto [known, is_new] = known_.try_emplace(hash, BlockRange{next, next});
        if (!is_new && holds(known->second, items, count, *runs)) return known->second;
        runs->items.insert(runs->items.end(), items, items + count);
        const auto last = static_cast<int64_t>(runs->items.size());
        cut_into_runs(*runs, last - count, last);
        const BlockRange added{next, static_cast<uint32_t>(runs->begin.size() - 1)};
        if (is_new) known->second = added;
        return added;
    }

  private:
    static bool holds(const BlockRange& range, const int32_t* items, int64_t count,
                      const BlockItems& runs) {
        const int64_t first = runs.begin[range.begin], last = runs.begin[range.end];
        return last - first == count && std::equal(items, items + count, &runs.items[first]);
    }

    std::unordered_map<uint64_t, BlockRange> known_;
};

/// Appends the cells of `lists`, whose items are indices of references.
void append_cells(const CellLists& lists, KnownLists* known, GridIndex* index, BlockItems* runs) {
    for (size_t cell = 0; cell + 1 < lists.begin.size(); ++cell) {
        const int64_t first = lists.begin[cell], count = lists.begin[cell + 1] - first;
        index->cells.push_back(known->find_or_add(lists.items.data() + first, count, runs));
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
    KnownLists known;
    append_cells(without_divided(lists, divisions), &known, index, runs);
    index->inner_of_cell.assign(divisions.size(), -1);
    for (size_t cell = 0; cell < divisions.size(); ++cell) {
        Division& division = divisions[cell];
        if (division.lists.begin.empty()) continue;
        index->inner_of_cell[cell] = static_cast<int32_t>(index->inner.size());
        division.grid.first_cell = static_cast<int64_t>(index->cells.size());
        index->inner.push_back(division.grid);
        append_cells(division.lists, &known, index, runs);
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
    const CellLists lists = list_cells(index->outer, refs);
    KnownLists known;
    if (divide) add_divided(lists, refs, threads, index, &runs);
    else append_cells(lists, &known, index, &runs);
    for (int32_t& item : runs.items) item = refs[item].item;
    return runs;
}

}  // namespace trg

#include "accel/grid_build.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "accel/wide_node.h"
#include "base/parallel.h"

namespace trg {

namespace {

/// Cells with fewer items are never divided.
constexpr int64_t kFewItems = 2 * kWidth;
/// Where the boxes of a cell's items are this large a part of it in the mean, it is left whole.
constexpr double kMostOverlap = 0.5;
/// A finer grid may list an item this often in the mean: what overlaps cannot be divided.
constexpr int64_t kMostCopies = 6;
/// A finer grid must be expected to cost less than this share of the cell's blocks.
constexpr double kWorthwhile = 0.8;

/// A grid with the items of its cells, as indices of references, and the finer grids of some of
/// them. A grid of no cells was not worthwhile.
struct Division {
    Grid grid;
    CellLists lists;
    int64_t items = 0;            // in all of it
    std::vector<Division> inner;  // by cell; empty when no cell has one
};

bool is_divided(const Division& division) {
    return !division.lists.begin.empty();
}

/// Where both boxes are; they meet.
Bounds common(const Bounds& a, const Bounds& b) {
    return {{max_of(a.lo.x, b.lo.x), max_of(a.lo.y, b.lo.y), max_of(a.lo.z, b.lo.z)},
            {min_of(a.hi.x, b.hi.x), min_of(a.hi.y, b.hi.y), min_of(a.hi.z, b.hi.z)}};
}

/// Whether most lines through `box` meet the boxes of most references, so that nothing can be
/// gained by dividing it.
bool is_overlapping(const Bounds& box, const PrimRefs& refs) {
    double sum = 0;
    for (const PrimRef& ref : refs) sum += half_area(common(box, box_of(ref)));
    return sum > kMostOverlap * half_area(box) * static_cast<double>(refs.size());
}

void divide_cells(Division* division, const PrimRefs& refs, int level, int threads);

Division divide_cell(const Bounds& box, const PrimRefs& refs, const int32_t* items, int64_t count,
                     int level) {
    PrimRefs inside;
    inside.reserve(count);
    Bounds held = empty_bounds();
    for (int64_t k = 0; k < count; ++k) {
        inside.push_back(refs[items[k]]);
        held = united(held, box_of(inside.back()));
    }
    Division division;
    const Bounds tight = common(box, held);
    if (is_overlapping(tight, inside)) return division;
    const Grid grid = best_grid(tight, inside);
    const double blocks = static_cast<double>((count + kWidth - 1) / kWidth);
    if (kEnterCost + expected_cost(grid, inside) > kWorthwhile * blocks) return division;
    CellLists lists = list_cells(grid, inside);
    if (static_cast<int64_t>(lists.items.size()) > kMostCopies * count) return division;
    division.grid = grid;
    division.lists = std::move(lists);
    division.items = count;
    for (int32_t& item : division.lists.items) item = items[item];
    divide_cells(&division, refs, level + 1, 1);
    return division;
}

/// Divides the full cells of `division`, itself at `level`.
void divide_cells(Division* division, const PrimRefs& refs, int level, int threads) {
    const CellLists& lists = division->lists;
    const int64_t cells = cell_count(division->grid);
    int64_t fullest = 0;
    for (int64_t cell = 0; cell < cells; ++cell)
        fullest = std::max(fullest, lists.begin[cell + 1] - lists.begin[cell]);
    if (level >= kMostGridLevels || fullest < kFewItems) return;
    const int64_t most = division->items / 2;
    division->inner.resize(cells);
    parallel_for(cells, 64, threads, [&](int64_t begin, int64_t end) {
        for (int64_t cell = begin; cell < end; ++cell) {
            const int64_t first = lists.begin[cell], count = lists.begin[cell + 1] - first;
            // A cell that holds most of what was divided would be divided for ever.
            if (count < kFewItems || (level > 1 && count > most)) continue;
            division->inner[cell] = divide_cell(cell_bounds(division->grid, cell), refs,
                                                lists.items.data() + first, count, level);
        }
    });
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

/// Appends the grid with all that is in its cells; returns its number.
uint32_t append_division(const Division& division, KnownLists* known, GridIndex* index,
                         BlockItems* runs) {
    const auto number = static_cast<uint32_t>(index->grids.size());
    const size_t first_cell = index->cells.size();
    index->grids.push_back(division.grid);
    index->grids.back().first_cell = static_cast<int64_t>(first_cell);
    const CellLists& lists = division.lists;
    index->cells.resize(first_cell + lists.begin.size() - 1);
    for (size_t cell = 0; cell + 1 < lists.begin.size(); ++cell) {
        const bool divided = !division.inner.empty() && is_divided(division.inner[cell]);
        const int64_t first = lists.begin[cell], count = lists.begin[cell + 1] - first;
        // Sought before it is stored: appending moves the cells.
        const BlockRange range =
            divided
                ? BlockRange{append_division(division.inner[cell], known, index, runs), kDivided}
                : known->find_or_add(lists.items.data() + first, count, runs);
        index->cells[first_cell + cell] = range;
    }
    return number;
}

}  // namespace

void cut_into_runs(BlockItems& runs, int64_t first, int64_t last) {
    for (int64_t at = first; at < last; at += kWidth)
        runs.begin.push_back(std::min<int64_t>(at + kWidth, last));
}

BlockItems build_grid(const PrimRefs& refs, const Bounds& bounds, bool divide, int threads,
                      GridIndex* index) {
    Division whole;
    const bool hopeless = divide && is_overlapping(bounds, refs);
    whole.grid = hopeless ? lay_grid(bounds, 1)
                 : divide ? best_outer_grid(bounds, refs)
                          : best_grid(bounds, refs);
    whole.lists = list_cells(whole.grid, refs);
    if (divide && !hopeless) divide_cells(&whole, refs, 1, threads);
    BlockItems runs;
    runs.begin.assign(1, 0);
    KnownLists known;
    append_division(whole, &known, index, &runs);
    for (int32_t& item : runs.items) item = refs[item].item;
    return runs;
}

}  // namespace trg

#include "accel/grid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "accel/wide_node.h"

namespace trg {

namespace {

constexpr double kPadding = 1e-5;       // of the extent, besides a few units in the last place
constexpr double kClosedMargin = 1e-4;  // of a cell
constexpr int kMostCellsAlong = 1024;
constexpr int64_t kMostEntries = int64_t{1} << 31;
constexpr double kMostCellsPerItem = 16, kMostEntriesPerItem = 32;

/// What one step to the next cell costs, in tests of a block.
constexpr double kStepCost = 0.6;
/// The same for crossing a finer grid with n items, per cube root of n.
constexpr double kInnerCost = 1.2;

struct CellRange {
    int low[3], high[3];
};

CellRange cells_of(const Grid& grid, const Bounds& box) {
    const float lo[3] = {box.lo.x, box.lo.y, box.lo.z}, hi[3] = {box.hi.x, box.hi.y, box.hi.z};
    CellRange range;
    for (int axis = 0; axis < 3; ++axis) {
        const double first = (lo[axis] - grid.low[axis]) / grid.cell[axis] - kClosedMargin;
        const double last = (hi[axis] - grid.low[axis]) / grid.cell[axis] + kClosedMargin;
        const double most = grid.size[axis] - 1;
        range.low[axis] = static_cast<int>(std::clamp(std::floor(first), 0.0, most));
        range.high[axis] = static_cast<int>(std::clamp(std::floor(last), 0.0, most));
    }
    return range;
}

int64_t cells_in(const CellRange& range) {
    int64_t cells = 1;
    for (int axis = 0; axis < 3; ++axis) cells *= range.high[axis] - range.low[axis] + 1;
    return cells;
}

template <class Visit>
void for_each_cell(const Grid& grid, const CellRange& range, Visit visit) {
    for (int z = range.low[2]; z <= range.high[2]; ++z)
        for (int y = range.low[1]; y <= range.high[1]; ++y)
            for (int x = range.low[0]; x <= range.high[0]; ++x)
                visit((int64_t{z} * grid.size[1] + y) * grid.size[0] + x);
}

int64_t count_entries(const Grid& grid, const PrimRefs& refs) {
    int64_t entries = 0;
    for (const PrimRef& ref : refs) entries += cells_in(cells_of(grid, box_of(ref)));
    return entries;
}

std::vector<uint32_t> count_items(const Grid& grid, const PrimRefs& refs) {
    std::vector<uint32_t> counts(cell_count(grid), 0);
    for (const PrimRef& ref : refs)
        for_each_cell(grid, cells_of(grid, box_of(ref)), [&](int64_t cell) { ++counts[cell]; });
    return counts;
}

/// How many cells a random line through the grid's box meets: the sum of the cells' shares.
double share_of_cell(const Grid& grid) {
    const double* c = grid.cell;
    const double x = c[0] * grid.size[0], y = c[1] * grid.size[1], z = c[2] * grid.size[2];
    return (c[0] * c[1] + c[1] * c[2] + c[2] * c[0]) / (x * y + y * z + z * x);
}

double blocks_for(uint32_t items) {
    return static_cast<double>((items + kWidth - 1) / kWidth);
}

/// Sum over cells of `cost_of(items)`, weighed by how often a line meets a cell; infinite where the
/// lists would grow out of proportion.
template <class CostOf>
double cost_of_grid(const Grid& grid, const PrimRefs& refs, CostOf cost_of) {
    const auto most = static_cast<int64_t>(kMostEntriesPerItem * static_cast<double>(refs.size()));
    if (count_entries(grid, refs) > most) return HUGE_VAL;
    double sum = kStepCost * static_cast<double>(cell_count(grid));
    for (uint32_t items : count_items(grid, refs)) sum += cost_of(items);
    return sum * share_of_cell(grid);
}

double cost_when_divided(uint32_t items) {
    const double whole = blocks_for(items);
    return std::min(whole, kEnterCost + kInnerCost * std::cbrt(static_cast<double>(items)));
}

/// The grid of least `cost(grid)` among those with 2^k times `first` cells, one cell if none will
/// do.
template <class Cost>
Grid search_grid(const Bounds& bounds, double first, double most, Cost cost) {
    Grid best = lay_grid(bounds, first);
    double least = cost(best);
    for (const double factor : {2.0, 0.5}) {
        bool improved = false;
        for (double cells = first * factor; cells <= most && cells >= 1; cells *= factor) {
            const Grid grid = lay_grid(bounds, cells);
            const double now = cost(grid);
            const bool hopeless = now == HUGE_VAL && factor < 1;
            if (hopeless) continue;
            if (!(now < least)) break;
            best = grid;
            least = now;
            improved = true;
        }
        if (improved) break;
    }
    if (least == HUGE_VAL) return lay_grid(bounds, 1);
    return best;
}

}  // namespace

Grid lay_grid(const Bounds& bounds, double cells) {
    Grid grid;
    const float lo[3] = {bounds.lo.x, bounds.lo.y, bounds.lo.z};
    const float hi[3] = {bounds.hi.x, bounds.hi.y, bounds.hi.z};
    double extent[3], largest = 0;
    for (int axis = 0; axis < 3; ++axis) {
        extent[axis] = static_cast<double>(hi[axis]) - lo[axis];
        largest = std::max(largest, extent[axis]);
    }
    double volume = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double magnitude = std::max(std::fabs(lo[axis]), std::fabs(hi[axis]));
        const double pad = kPadding * largest + 4 * magnitude * 0x1p-23 + 1e-37;
        grid.low[axis] = lo[axis] - pad;
        extent[axis] += 2 * pad;
        volume *= extent[axis];
    }
    // Cubes as large as a flat box has room for are many.
    const double edge = cells > 1 ? std::cbrt(volume / cells) : HUGE_VAL;
    for (int axis = 0; axis < 3; ++axis) {
        const double along = std::clamp(extent[axis] / edge, 1.0, double{kMostCellsAlong});
        grid.size[axis] = static_cast<int32_t>(along);
        grid.cell[axis] = extent[axis] / grid.size[axis];
    }
    return grid;
}

double expected_cost(const Grid& grid, const PrimRefs& refs) {
    return cost_of_grid(grid, refs, blocks_for);
}

Grid best_grid(const Bounds& bounds, const PrimRefs& refs) {
    const auto items = static_cast<double>(refs.size());
    return search_grid(bounds, items, kMostCellsPerItem * items + 64,
                       [&](const Grid& grid) { return expected_cost(grid, refs); });
}

Grid best_outer_grid(const Bounds& bounds, const PrimRefs& refs) {
    const auto items = static_cast<double>(refs.size());
    return search_grid(bounds, std::max(1.0, items / 8), items + 64, [&](const Grid& grid) {
        return cost_of_grid(grid, refs, cost_when_divided);
    });
}

Bounds cell_bounds(const Grid& grid, int64_t cell) {
    const int64_t at[3] = {cell % grid.size[0], cell / grid.size[0] % grid.size[1],
                           cell / (int64_t{grid.size[0]} * grid.size[1])};
    float lo[3], hi[3];
    for (int axis = 0; axis < 3; ++axis) {
        // Wider by more than an item's margin, so that rounding to float loses nothing.
        const double low = grid.low[axis] + static_cast<double>(at[axis]) * grid.cell[axis];
        const double margin = 2 * kClosedMargin * grid.cell[axis];
        lo[axis] = static_cast<float>(low - margin);
        hi[axis] = static_cast<float>(low + grid.cell[axis] + margin);
    }
    return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
}

CellLists list_cells(const Grid& grid, const PrimRefs& refs) {
    if (count_entries(grid, refs) > kMostEntries)
        throw std::length_error("the grid grows too large");
    const int64_t cells = cell_count(grid);
    CellLists lists;
    lists.begin.assign(cells + 1, 0);
    for (const PrimRef& ref : refs)
        for_each_cell(grid, cells_of(grid, box_of(ref)),
                      [&](int64_t cell) { ++lists.begin[cell + 1]; });
    for (int64_t cell = 0; cell < cells; ++cell) lists.begin[cell + 1] += lists.begin[cell];

    lists.items.resize(lists.begin[cells]);
    std::vector<int64_t> at(lists.begin.begin(), lists.begin.end() - 1);
    for (size_t k = 0; k < refs.size(); ++k)
        for_each_cell(grid, cells_of(grid, box_of(refs[k])),
                      [&](int64_t cell) { lists.items[at[cell]++] = static_cast<int32_t>(k); });
    return lists;
}

}  // namespace trg

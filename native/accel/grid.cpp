#include "accel/grid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trg {

namespace {

constexpr double kPadding = 1e-5;        // of the extent, besides a few units in the last place
constexpr double kClosedMargin = 1e-4;   // of a cell
constexpr double kCellsPerItem = 2.0;
constexpr int kMostCellsAlong = 256;
constexpr int64_t kMostEntries = int64_t{1} << 31;

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

template <class Visit>
void for_each_cell(const Grid& grid, const CellRange& range, Visit visit) {
    for (int z = range.low[2]; z <= range.high[2]; ++z)
        for (int y = range.low[1]; y <= range.high[1]; ++y)
            for (int x = range.low[0]; x <= range.high[0]; ++x)
                visit((int64_t{z} * grid.size[1] + y) * grid.size[0] + x);
}

}  // namespace

Grid lay_grid(const Bounds& bounds, int64_t item_count) {
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
    const double edge = std::cbrt(volume / (kCellsPerItem * static_cast<double>(item_count)));
    for (int axis = 0; axis < 3; ++axis) {
        const double cells = std::clamp(extent[axis] / edge, 1.0, double{kMostCellsAlong});
        grid.size[axis] = static_cast<int32_t>(cells);
        grid.cell[axis] = extent[axis] / grid.size[axis];
    }
    return grid;
}

CellLists list_cells(const Grid& grid, const std::vector<PrimRef>& refs) {
    const int64_t cell_count = int64_t{grid.size[0]} * grid.size[1] * grid.size[2];
    CellLists lists;
    lists.begin.assign(cell_count + 1, 0);
    for (const PrimRef& ref : refs)
        for_each_cell(grid, cells_of(grid, box_of(ref)), [&](int64_t cell) { ++lists.begin[cell + 1]; });
    for (int64_t cell = 0; cell < cell_count; ++cell) lists.begin[cell + 1] += lists.begin[cell];
    if (lists.begin[cell_count] > kMostEntries) throw std::length_error("the grid grows too large");

    lists.items.resize(lists.begin[cell_count]);
    std::vector<int64_t> at(lists.begin.begin(), lists.begin.end() - 1);
    for (size_t k = 0; k < refs.size(); ++k)
        for_each_cell(grid, cells_of(grid, box_of(refs[k])),
                      [&](int64_t cell) { lists.items[at[cell]++] = static_cast<int32_t>(k); });
    return lists;
}

}  // namespace trg

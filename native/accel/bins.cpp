#include "accel/bins.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/parallel.h"

namespace trg {

namespace {

constexpr int64_t kGrain = 1 << 15;
constexpr int64_t kParallelSize = 1 << 17;

void clear_bins(Bins* bins, int count) {
    for (int k = 0; k < count; ++k) {
        for (int axis = 0; axis < 3; ++axis) bins->box[k][axis] = empty_box();
        std::fill(bins->items[k], bins->items[k] + 4, 0);
    }
}

void add_to_bins(const PrimRef* refs, int64_t begin, int64_t end, const Binning& binning,
                 Bins* bins) {
    for (int64_t k = begin; k < end; ++k) {
        const Box4 box = rows_of(refs[k]);
        int at[4];
        truncate4(at, min4((box.lo + box.hi - binning.low) * binning.scale, binning.last));
        for (int axis = 0; axis < 3; ++axis) {
            Box4& bin = bins->box[at[axis]][axis];
            bin = united(bin, box);
            ++bins->items[at[axis]][axis];
        }
    }
}

void merge_bins(Bins* bins, const Bins& part, int count) {
    for (int k = 0; k < count; ++k) {
        for (int axis = 0; axis < 3; ++axis) {
            bins->box[k][axis] = united(bins->box[k][axis], part.box[k][axis]);
            bins->items[k][axis] += part.items[k][axis];
        }
    }
}

/// One side of the planes along all three axes while a sweep widens it.
struct Side {
    Box4 box[3] = {empty_box(), empty_box(), empty_box()};
    alignas(16) int items[4] = {0, 0, 0, 0};
};

/// Boxes count in units of the whole's longest edge, lest areas overflow or vanish.
struct CostUnits {
    Float4 scale;
    int round_up, shift;  // from items to blocks
};

CostUnits units_of(const Bounds& whole, int block_width) {
    const float edge = std::max(
        {whole.hi.x - whole.lo.x, whole.hi.y - whole.lo.y, whole.hi.z - whole.lo.z, 1e-30f});
    int shift = 0;
    while ((1 << shift) < block_width) ++shift;
    return {splat4(1 / edge), block_width - 1, shift};
}

/// Widens a side by bin `k` of every axis; its costs along them, NaN where it is empty.
Float4 widen(Side& side, const Bins& bins, int k, const CostUnits& units) {
    Float4 edges[3];
    for (int axis = 0; axis < 3; ++axis) {
        side.box[axis] = united(side.box[axis], bins.box[k][axis]);
        edges[axis] = (side.box[axis].hi - side.box[axis].lo) * units.scale;
    }
    transpose3(edges);
    alignas(16) int blocks[4];
    for (int axis = 0; axis < 4; ++axis) {
        side.items[axis] += bins.items[k][axis];
        blocks[axis] = (side.items[axis] + units.round_up) >> units.shift;
    }
    return (edges[0] * edges[1] + edges[1] * edges[2] + edges[2] * edges[0]) * load_ints4(blocks);
}

}  // namespace

Binning binning_of(const PrimRange& range) {
    const int64_t items = range.end - range.begin;
    Binning binning;
    binning.count = items > 2048 ? kMostBins : items > 64 ? 16 : 8;
    alignas(16) float low[4] = {range.centres.lo.x, range.centres.lo.y, range.centres.lo.z, 0};
    const float high[3] = {range.centres.hi.x, range.centres.hi.y, range.centres.hi.z};
    alignas(16) float scale[4] = {0, 0, 0, 0};
    for (int axis = 0; axis < 3; ++axis) {
        const float factor = binning.count * 0.99999f / (high[axis] - low[axis]);
        if (high[axis] > low[axis] && std::isfinite(factor)) scale[axis] = factor;
    }
    binning.low = load4(low);
    binning.scale = load4(scale);
    binning.last = splat4(static_cast<float>(binning.count - 1));
    return binning;
}

void fill_bins(const PrimRef* refs, const PrimRange& range, const Binning& binning, int threads,
               Bins* bins) {
    clear_bins(bins, binning.count);
    const int64_t items = range.end - range.begin;
    if (items < kParallelSize) return add_to_bins(refs, range.begin, range.end, binning, bins);
    std::mutex mutex;
    parallel_for(items, kGrain, threads, [&](int64_t begin, int64_t end) {
        Bins part;
        clear_bins(&part, binning.count);
        add_to_bins(refs, range.begin + begin, range.begin + end, binning, &part);
        const std::lock_guard<std::mutex> lock(mutex);
        merge_bins(bins, part, binning.count);
    });
}

BinPlane choose_plane(const Bins& bins, int bin_count, const Bounds& whole, int block_width) {
    const CostUnits units = units_of(whole, block_width);
    Float4 right_cost[kMostBins];
    Side right, left;
    for (int k = bin_count - 1; k > 0; --k) right_cost[k] = widen(right, bins, k, units);

    // Costs of NaN, of planes with an empty side, never win.
    Float4 best = splat4(HUGE_VALF), best_bin = splat4(0);
    for (int k = 1; k < bin_count; ++k) {
        const Float4 cost = widen(left, bins, k - 1, units) + right_cost[k];
        best_bin = select_less4(cost, best, splat4(static_cast<float>(k)), best_bin);
        best = select_less4(cost, best, cost, best);
    }
    float costs[4], at[4], scale[4];
    store4(costs, best);
    store4(at, best_bin);
    store4(scale, units.scale);
    BinPlane plane;
    for (int axis = 0; axis < 3; ++axis)
        if (costs[axis] < plane.cost) plane = {costs[axis], axis, static_cast<int>(at[axis])};
    plane.cost /= static_cast<double>(scale[0]) * scale[0];
    return plane;
}

SideBoxes boxes_beside(const Bins& bins, int bin_count, const BinPlane& plane) {
    SideBoxes sides{empty_box(), empty_box()};
    for (int k = 0; k < plane.bin; ++k) sides.left = united(sides.left, bins.box[k][plane.axis]);
    for (int k = plane.bin; k < bin_count; ++k)
        sides.right = united(sides.right, bins.box[k][plane.axis]);
    return sides;
}

}  // namespace trg

#include "accel/split.h"

#include <cmath>
#include <mutex>
#include <utility>

#include "base/float4.h"
#include "base/parallel.h"

namespace trg {

namespace {

constexpr int kMostBins = 32;
constexpr int64_t kParallelSize = 1 << 17;
constexpr int64_t kParallelGrain = 1 << 15;

/// A box as two rows; the fourth column means nothing.
struct Box4 {
    Float4 lo, hi;
};

Box4 empty_box() { return {splat4(HUGE_VALF), splat4(-HUGE_VALF)}; }

Box4 united(const Box4& a, const Box4& b) { return {min4(a.lo, b.lo), max4(a.hi, b.hi)}; }

Box4 rows_of(const PrimRef& ref) { return {load4(&ref.lo.x), load4(&ref.hi.x)}; }

Bounds bounds_of(const Box4& box) {
    float lo[4], hi[4];
    store4(lo, box.lo);
    store4(hi, box.hi);
    return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
}

/// Half the surface; finite for the coordinates that sound triangles have.
float half_area_of(const Box4& box) {
    float d[4];
    store4(d, box.hi - box.lo);
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

struct Bin {
    Box4 box;
    int64_t count;
};

struct Bins {
    Bin bin[3][kMostBins];
};

/// How doubled centres map to bins; a scale of 0 marks an axis without extent.
struct Binning {
    Float4 low, scale, last;
    bool usable[3];
    int count;
};

struct Plane {
    double cost = HUGE_VAL;
    int axis = -1;
    int bin = 0;
};

Binning binning_of(const PrimRange& range) {
    const int64_t items = range.end - range.begin;
    Binning binning;
    binning.count = items > 2048 ? kMostBins : items > 64 ? 16 : 8;
    alignas(16) float low[4] = {range.centres.lo.x, range.centres.lo.y, range.centres.lo.z, 0};
    const float high[3] = {range.centres.hi.x, range.centres.hi.y, range.centres.hi.z};
    alignas(16) float scale[4] = {0, 0, 0, 0};
    for (int axis = 0; axis < 3; ++axis) {
        const float factor = binning.count * 0.99999f / (high[axis] - low[axis]);
        binning.usable[axis] = high[axis] > low[axis] && std::isfinite(factor);
        if (binning.usable[axis]) scale[axis] = factor;
    }
    binning.low = load4(low);
    binning.scale = load4(scale);
    binning.last = splat4(static_cast<float>(binning.count - 1));
    return binning;
}

/// Bins of a doubled centre along the three axes; the fourth number means nothing.
void bins_at(const Binning& binning, Float4 centre, int bins[4]) {
    truncate4(bins, min4((centre - binning.low) * binning.scale, binning.last));
}

Bins empty_bins(int count) {
    Bins bins;
    for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < count; ++k) bins.bin[axis][k] = {empty_box(), 0};
    return bins;
}

void fill_bins(const PrimRef* refs, int64_t begin, int64_t end, const Binning& binning, Bins* bins) {
    for (int64_t k = begin; k < end; ++k) {
        const Box4 box = rows_of(refs[k]);
        int at[4];
        bins_at(binning, box.lo + box.hi, at);
        for (int axis = 0; axis < 3; ++axis) {
            Bin& bin = bins->bin[axis][at[axis]];
            bin.box = united(bin.box, box);
            ++bin.count;
        }
    }
}

Bins bins_of(const PrimRef* refs, const PrimRange& range, const Binning& binning, int threads) {
    Bins bins = empty_bins(binning.count);
    const int64_t items = range.end - range.begin;
    if (items < kParallelSize) {
        fill_bins(refs, range.begin, range.end, binning, &bins);
        return bins;
    }
    std::mutex mutex;
    parallel_for(items, kParallelGrain, threads, [&](int64_t begin, int64_t end) {
        Bins part = empty_bins(binning.count);
        fill_bins(refs, range.begin + begin, range.begin + end, binning, &part);
        const std::lock_guard<std::mutex> lock(mutex);
        for (int axis = 0; axis < 3; ++axis) {
            for (int k = 0; k < binning.count; ++k) {
                Bin& total = bins.bin[axis][k];
                total.box = united(total.box, part.bin[axis][k].box);
                total.count += part.bin[axis][k].count;
            }
        }
    });
    return bins;
}

double blocks_of(int64_t items, int width) {
    return static_cast<double>((items + width - 1) / width);
}

double cost_of(const Box4& box, int64_t items, int block_width) {
    return half_area_of(box) * blocks_of(items, block_width);
}

/// The cheapest plane between two bins of one axis that leaves neither side empty.
Plane best_plane_along(const Bin* bins, int axis, int bin_count, int block_width) {
    double cost_right[kMostBins];
    Box4 box = empty_box();
    int64_t items = 0;
    for (int k = bin_count - 1; k > 0; --k) {
        box = united(box, bins[k].box);
        items += bins[k].count;
        cost_right[k] = items ? cost_of(box, items, block_width) : HUGE_VAL;
    }
    Plane best;
    box = empty_box();
    items = 0;
    for (int k = 1; k < bin_count; ++k) {
        box = united(box, bins[k - 1].box);
        items += bins[k - 1].count;
        if (!items) continue;
        const double cost = cost_of(box, items, block_width) + cost_right[k];
        if (cost < best.cost) best = {cost, axis, k};
    }
    return best;
}

/// Boxes of a range while it grows.
struct Extent {
    Box4 box = empty_box();
    Box4 centres = empty_box();
};

void grow(Extent* extent, const Box4& box) {
    const Float4 centre = box.lo + box.hi;
    extent->box = united(extent->box, box);
    extent->centres = united(extent->centres, Box4{centre, centre});
}

PrimRange range_of(int64_t begin, int64_t end, const Extent& extent) {
    return {begin, end, bounds_of(extent.box), bounds_of(extent.centres)};
}

void partition(PrimRef* refs, const PrimRange& range, const Binning& binning, const Plane& plane,
               PrimRange halves[2]) {
    Extent left, right;
    int64_t left_end = range.begin, right_begin = range.end;
    while (left_end < right_begin) {
        const Box4 box = rows_of(refs[left_end]);
        int at[4];
        bins_at(binning, box.lo + box.hi, at);
        if (at[plane.axis] < plane.bin) {
            grow(&left, box);
            ++left_end;
        } else {
            grow(&right, box);
            std::swap(refs[left_end], refs[--right_begin]);
        }
    }
    halves[0] = range_of(range.begin, left_end, left);
    halves[1] = range_of(left_end, range.end, right);
}

}  // namespace

PrimRange measure_range(const PrimRef* refs, int64_t begin, int64_t end) {
    Extent extent;
    for (int64_t k = begin; k < end; ++k) grow(&extent, rows_of(refs[k]));
    return range_of(begin, end, extent);
}

void split_by_count(const PrimRef* refs, const PrimRange& range, PrimRange halves[2]) {
    const int64_t middle = range.begin + (range.end - range.begin) / 2;
    halves[0] = measure_range(refs, range.begin, middle);
    halves[1] = measure_range(refs, middle, range.end);
}

void split_range(PrimRef* refs, const PrimRange& range, const SplitSettings& settings,
                 PrimRange halves[2]) {
    const Binning binning = binning_of(range);
    const Bins bins = bins_of(refs, range, binning, settings.threads);
    Plane best;
    for (int axis = 0; axis < 3; ++axis) {
        if (!binning.usable[axis]) continue;
        const Plane plane =
            best_plane_along(bins.bin[axis], axis, binning.count, settings.block_width);
        if (plane.cost < best.cost) best = plane;
    }
    if (best.axis < 0) return split_by_count(refs, range, halves);
    partition(refs, range, binning, best, halves);
}

}  // namespace trg

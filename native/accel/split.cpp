#include "accel/split.h"

#include <cmath>
#include <mutex>
#include <utility>

#include "base/parallel.h"

namespace trg {

namespace {

constexpr int kMostBins = 32;
constexpr int64_t kParallelSize = 1 << 17;
constexpr int64_t kParallelGrain = 1 << 15;

struct Bin {
    Bounds box;
    int64_t count;
};

struct Bins {
    Bin bin[3][kMostBins];
};

/// How centres map to bins on the three axes; a scale of 0 marks an axis without extent.
struct Binning {
    float low[3];
    float scale[3];
    int count;
};

struct Plane {
    double cost = HUGE_VAL;
    int axis = -1;
    int bin = 0;
};

Vec3 doubled_centre(const PrimRef& ref) { return ref.box.lo + ref.box.hi; }

Binning binning_of(const PrimRange& range) {
    const int64_t items = range.end - range.begin;
    Binning binning;
    binning.count = items > 2048 ? kMostBins : 16;
    const float low[3] = {range.centres.lo.x, range.centres.lo.y, range.centres.lo.z};
    const float high[3] = {range.centres.hi.x, range.centres.hi.y, range.centres.hi.z};
    for (int axis = 0; axis < 3; ++axis) {
        const float scale = binning.count * 0.99999f / (high[axis] - low[axis]);
        binning.low[axis] = low[axis];
        binning.scale[axis] = high[axis] > low[axis] && std::isfinite(scale) ? scale : 0.0f;
    }
    return binning;
}

int bin_of(const Binning& binning, float centre, int axis) {
    const int bin = static_cast<int>((centre - binning.low[axis]) * binning.scale[axis]);
    return bin < binning.count ? bin : binning.count - 1;
}

Bins empty_bins(int count) {
    Bins bins;
    for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < count; ++k) bins.bin[axis][k] = {empty_bounds(), 0};
    return bins;
}

void fill_bins(const PrimRef* refs, int64_t begin, int64_t end, const Binning& binning, Bins* bins) {
    for (int64_t k = begin; k < end; ++k) {
        const Vec3 centre = doubled_centre(refs[k]);
        const float along[3] = {centre.x, centre.y, centre.z};
        for (int axis = 0; axis < 3; ++axis) {
            Bin& bin = bins->bin[axis][bin_of(binning, along[axis], axis)];
            bin.box = united(bin.box, refs[k].box);
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

/// The cheapest plane between two bins of one axis that leaves neither side empty.
Plane best_plane_along(const Bins& bins, int axis, int bin_count, int block_width) {
    double cost_right[kMostBins];
    Bounds box = empty_bounds();
    int64_t items = 0;
    for (int k = bin_count - 1; k > 0; --k) {
        box = united(box, bins.bin[axis][k].box);
        items += bins.bin[axis][k].count;
        cost_right[k] = items ? half_area(box) * blocks_of(items, block_width) : HUGE_VAL;
    }
    Plane best;
    box = empty_bounds();
    items = 0;
    for (int k = 1; k < bin_count; ++k) {
        box = united(box, bins.bin[axis][k - 1].box);
        items += bins.bin[axis][k - 1].count;
        if (!items) continue;
        const double cost = half_area(box) * blocks_of(items, block_width) + cost_right[k];
        if (cost < best.cost) best = {cost, axis, k};
    }
    return best;
}

void grow(PrimRange* range, const PrimRef& ref) {
    range->box = united(range->box, ref.box);
    range->centres = united(range->centres, doubled_centre(ref));
}

void partition(PrimRef* refs, const PrimRange& range, const Binning& binning, const Plane& plane,
               PrimRange halves[2]) {
    PrimRange left{range.begin, range.begin, empty_bounds(), empty_bounds()};
    PrimRange right{range.end, range.end, empty_bounds(), empty_bounds()};
    while (left.end < right.begin) {
        PrimRef& ref = refs[left.end];
        const Vec3 centre = doubled_centre(ref);
        const float along[3] = {centre.x, centre.y, centre.z};
        if (bin_of(binning, along[plane.axis], plane.axis) < plane.bin) {
            grow(&left, ref);
            ++left.end;
        } else {
            grow(&right, ref);
            std::swap(ref, refs[--right.begin]);
        }
    }
    halves[0] = left;
    halves[1] = right;
}

}  // namespace

PrimRange measure_range(const PrimRef* refs, int64_t begin, int64_t end) {
    PrimRange range{begin, end, empty_bounds(), empty_bounds()};
    for (int64_t k = begin; k < end; ++k) grow(&range, refs[k]);
    return range;
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
        if (binning.scale[axis] == 0.0f) continue;
        const Plane plane = best_plane_along(bins, axis, binning.count, settings.block_width);
        if (plane.cost < best.cost) best = plane;
    }
    if (best.axis < 0) return split_by_count(refs, range, halves);
    partition(refs, range, binning, best, halves);
}

}  // namespace trg

#include "accel/split.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "accel/box4.h"
#include "accel/cut_split.h"
#include "base/parallel.h"

namespace trg {

namespace {

constexpr int kMostBins = 32;
constexpr int64_t kParallelSize = 1 << 17;
constexpr int64_t kParallelGrain = 1 << 15;
/// Objects that overlap less than this share of the whole are not cut (Stich et al. 2009).
constexpr double kLeastOverlap = 1e-4;
/// Nor are ranges where cuts would pay for a smaller share of the items.
constexpr float kNeedShare = 0.25f;

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

void fill_bins(const PrimRef* refs, int64_t begin, int64_t end, const Binning& binning,
               Bins* bins) {
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

/// Half the surface that the boxes on both sides of a plane share.
double overlap_of(const Bins& bins, const Binning& binning, const Plane& plane) {
    Box4 left = empty_box(), right = left;
    for (int k = 0; k < plane.bin; ++k) left = united(left, bins.bin[plane.axis][k].box);
    for (int k = plane.bin; k < binning.count; ++k)
        right = united(right, bins.bin[plane.axis][k].box);
    const Bounds shared = bounds_of({max4(left.lo, right.lo), min4(left.hi, right.hi)});
    const bool apart =
        shared.lo.x > shared.hi.x || shared.lo.y > shared.hi.y || shared.lo.z > shared.hi.z;
    return apart ? 0 : half_area(shared);
}

void partition(PrimRef* refs, const PrimRange& range, const Binning& binning, const Plane& plane,
               PrimRange halves[2]) {
    Extent left = empty_extent(), right = left;
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
    Extent extent = empty_extent();
    for (int64_t k = begin; k < end; ++k) grow(&extent, rows_of(refs[k]));
    return range_of(begin, end, extent);
}

float least_need(const PrimRange& range) {
    return std::max(1.0f, kNeedShare * static_cast<float>(range.end - range.begin));
}

void share_room(PrimRef* refs, const PrimRange& range, PrimRange halves[2]) {
    if (range.room == 0) return;
    const double need = static_cast<double>(halves[0].need) + halves[1].need;
    const double share = need > 0 ? halves[0].need / need : 0.5;
    const int64_t room = range.begin + (range.end - range.begin) + range.room - halves[1].end;
    const auto left = static_cast<int64_t>(share * static_cast<double>(room));
    // The order within a half does not matter: its first ones move behind its last.
    const int64_t moved = std::min(left, halves[1].end - halves[1].begin);
    std::copy(refs + halves[1].begin, refs + halves[1].begin + moved,
              refs + halves[1].end + left - moved);
    halves[0].room = left;
    halves[1].begin += left;
    halves[1].end += left;
    halves[1].room = room - left;
}

void split_by_count(PrimRef* refs, const PrimRange& range, PrimRange halves[2]) {
    const int64_t middle = range.begin + (range.end - range.begin) / 2;
    halves[0] = measure_range(refs, range.begin, middle);
    halves[1] = measure_range(refs, middle, range.end);
    share_room(refs, range, halves);
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
    if (settings.corners && range.room > 0 && range.need >= least_need(range) &&
        (best.axis < 0 || overlap_of(bins, binning, best) > kLeastOverlap * settings.root_area) &&
        cut_range(refs, range, settings, best.cost, halves))
        return share_room(refs, range, halves);
    if (best.axis < 0) return split_by_count(refs, range, halves);
    partition(refs, range, binning, best, halves);
    share_room(refs, range, halves);
}

}  // namespace trg

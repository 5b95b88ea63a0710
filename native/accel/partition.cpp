#include "accel/partition.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"

namespace trg {

namespace {

constexpr int64_t kGrain = 1 << 15;
constexpr int64_t kParallelSize = 1 << 17;

/// What is known of both sides of a run that has been put in order: the left ends at `middle`.
struct Sides {
    Box4 centres[2];
    Float4 need[2];
    int64_t begin, middle, end;
};

Sides empty_sides(int64_t begin, int64_t end) {
    return {{empty_box(), empty_box()}, {splat4(0), splat4(0)}, begin, begin, end};
}

/// Added to a centre it leaves it alone or takes it out of a smallest number that is sought.
alignas(16) constexpr float kOut[2][4] = {{0, 0, 0, 0},
                                          {HUGE_VALF, HUGE_VALF, HUGE_VALF, HUGE_VALF}};

/// Orders one run by swaps that need no branch, since sides are as good as random.
template <bool kNeeds>
Sides order_run(PrimRef* refs, int64_t begin, int64_t end, const CentrePlane& plane) {
    Sides sides = empty_sides(begin, end);
    Box4 left = empty_box(), right = empty_box();
    int64_t middle = begin;
    for (int64_t k = begin; k < end; ++k) {
        const PrimRef ref = refs[k];
        const Box4 box = rows_of(ref);
        const float centre = (&refs[k].lo.x)[plane.axis] + (&refs[k].hi.x)[plane.axis];
        const bool is_left = (centre - plane.low) * plane.scale < plane.bin;
        refs[k] = refs[middle];
        refs[middle] = ref;
        middle += is_left;
        const Float4 doubled = box.lo + box.hi;
        const Float4 not_left = load4(kOut[!is_left]), not_right = load4(kOut[is_left]);
        left = {min4(left.lo, doubled + not_left), max4(left.hi, doubled - not_left)};
        right = {min4(right.lo, doubled + not_right), max4(right.hi, doubled - not_right)};
        if (kNeeds) sides.need[!is_left] = sides.need[!is_left] + box.hi;
    }
    sides.centres[0] = left;
    sides.centres[1] = right;
    sides.middle = middle;
    return sides;
}

Sides order_run(PrimRef* refs, int64_t begin, int64_t end, const CentrePlane& plane) {
    return plane.with_needs ? order_run<true>(refs, begin, end, plane)
                            : order_run<false>(refs, begin, end, plane);
}

/// References that must change places with as many others.
struct Exchange {
    int64_t from, to, count;
};

/// Pairs what lies right of its run's middle but before `middle` with what lies left of it behind.
std::vector<Exchange> exchanges_across(const std::vector<Sides>& runs, int64_t middle) {
    std::vector<Exchange> exchanges;
    size_t low = 0, high = 0;
    int64_t from = runs.empty() ? 0 : runs[0].middle, to = middle;
    while (low < runs.size() && runs[low].middle < middle) {
        const int64_t from_end = std::min(runs[low].end, middle);
        if (from >= from_end) {
            if (++low < runs.size()) from = runs[low].middle;
            continue;
        }
        while (to >= runs[high].middle) {
            ++high;
            to = std::max(runs[high].begin, middle);
        }
        const int64_t count = std::min(from_end - from, runs[high].middle - to);
        exchanges.push_back({from, to, count});
        from += count;
        to += count;
    }
    return exchanges;
}

/// Orders runs of a fixed length apart, then exchanges what lies on the wrong side of the whole.
Sides order_in_parallel(PrimRef* refs, const PrimRange& range, const CentrePlane& plane,
                        int threads) {
    const int64_t items = range.end - range.begin;
    std::vector<Sides> runs((items + kGrain - 1) / kGrain);
    parallel_for(items, kGrain, threads, [&](int64_t begin, int64_t end) {
        runs[begin / kGrain] = order_run(refs, range.begin + begin, range.begin + end, plane);
    });
    Sides all = empty_sides(range.begin, range.end);
    for (const Sides& run : runs) {
        all.middle += run.middle - run.begin;
        for (int side = 0; side < 2; ++side) {
            all.centres[side] = united(all.centres[side], run.centres[side]);
            all.need[side] = all.need[side] + run.need[side];
        }
    }
    const std::vector<Exchange> exchanges = exchanges_across(runs, all.middle);
    const auto count = static_cast<int64_t>(exchanges.size());
    parallel_for(count, 1, threads, [&](int64_t k, int64_t) {
        const Exchange& exchange = exchanges[k];
        std::swap_ranges(refs + exchange.from, refs + exchange.from + exchange.count,
                         refs + exchange.to);
    });
    return all;
}

PrimRange half_of(int64_t begin, int64_t end, const Box4& centres, Float4 need) {
    float needs[4];
    store4(needs, need);
    return {begin, end, {}, bounds_of(centres), needs[3], 0};
}

}  // namespace

void partition_range(PrimRef* refs, const PrimRange& range, const CentrePlane& plane, int threads,
                     PrimRange halves[2]) {
    const Sides sides = range.end - range.begin < kParallelSize
                            ? order_run(refs, range.begin, range.end, plane)
                            : order_in_parallel(refs, range, plane, threads);
    halves[0] = half_of(range.begin, sides.middle, sides.centres[0], sides.need[0]);
    halves[1] = half_of(sides.middle, range.end, sides.centres[1], sides.need[1]);
}

}  // namespace trg

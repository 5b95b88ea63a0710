#include "accel/split.h"

#include <algorithm>

#include "accel/cut_split.h"
#include "accel/partition.h"
#include "base/parallel.h"

namespace trg {

namespace {

constexpr int64_t kGrain = 1 << 15;
/// Objects that overlap less than this share of the whole are not cut (Stich et al. 2009).
constexpr double kLeastOverlap = 1e-4;
/// Nor are ranges where cuts would pay for a smaller share of the items.
constexpr float kNeedShare = 0.25f;

/// Half the surface that two boxes share.
double overlap_of(const SideBoxes& sides) {
    const Bounds shared =
        bounds_of({max4(sides.left.lo, sides.right.lo), min4(sides.left.hi, sides.right.hi)});
    const bool apart =
        shared.lo.x > shared.hi.x || shared.lo.y > shared.hi.y || shared.lo.z > shared.hi.z;
    return apart ? 0 : half_area(shared);
}

CentrePlane centre_plane(const Binning& binning, const BinPlane& plane, bool with_needs) {
    float low[4], scale[4];
    store4(low, binning.low);
    store4(scale, binning.scale);
    return {plane.axis, low[plane.axis], scale[plane.axis], static_cast<float>(plane.bin),
            with_needs};
}

}  // namespace

PrimRange measure_range(const PrimRef* refs, int64_t begin, int64_t end, int threads) {
    std::vector<Extent> parts((end - begin + kGrain - 1) / kGrain, empty_extent());
    parallel_for(end - begin, kGrain, threads, [&](int64_t first, int64_t last) {
        Extent extent = empty_extent();
        for (int64_t k = begin + first; k < begin + last; ++k) grow(&extent, rows_of(refs[k]));
        parts[first / kGrain] = extent;
    });
    Extent all = empty_extent();
    for (const Extent& part : parts) {
        all.box = united(all.box, part.box);
        all.centres = united(all.centres, part.centres);
        all.need = all.need + part.need;
    }
    return range_of(begin, end, all);
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
    Bins bins;
    fill_bins(refs, range, binning, settings.threads, &bins);
    const BinPlane plane = choose_plane(bins, binning.count, range.box, settings.block_width);
    SideBoxes sides{};
    if (plane.axis >= 0) sides = boxes_beside(bins, binning.count, plane);
    if (settings.corners && range.room > 0 && range.need >= least_need(range) &&
        (plane.axis < 0 || overlap_of(sides) > kLeastOverlap * settings.root_area) &&
        cut_range(refs, range, settings, plane.cost, halves))
        return share_room(refs, range, halves);
    if (plane.axis < 0) return split_by_count(refs, range, halves);
    partition_range(refs, range, centre_plane(binning, plane, settings.corners != nullptr),
                    settings.threads, halves);
    halves[0].box = bounds_of(sides.left);
    halves[1].box = bounds_of(sides.right);
    share_room(refs, range, halves);
}

}  // namespace trg

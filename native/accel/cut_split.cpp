#include "accel/cut_split.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "accel/box4.h"
#include "base/parallel.h"

namespace trg {

namespace {

constexpr int kCutBins = 16;
constexpr int64_t kGrain = 1 << 13;
constexpr double kUnit = 0x1p-23, kLeast = 1e-37;  // more than rounding to float can take away

double along(const Vec3& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
float& at(Vec3& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

struct CutPlane {
    int axis;
    float position;
};

/// The box of the part of a triangle on one side of a plane, in double.
struct PartBox {
    double lo[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, hi[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    void add(const double (&p)[3]) {
        for (int axis = 0; axis < 3; ++axis) {
            lo[axis] = std::min(lo[axis], p[axis]);
            hi[axis] = std::max(hi[axis], p[axis]);
        }
    }
};

void clip_triangle(const TriangleCorners& triangle, const CutPlane& plane, PartBox parts[2]) {
    double p[3][3];
    for (int k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis) p[k][axis] = along(triangle.p[k], axis);
    for (int k = 0; k < 3; ++k) {
        const double (&a)[3] = p[k], (&b)[3] = p[(k + 1) % 3];
        const double from = a[plane.axis] - plane.position, to = b[plane.axis] - plane.position;
        if (from <= 0) parts[0].add(a);
        if (from >= 0) parts[1].add(a);
        if (!((from < 0 && to > 0) || (from > 0 && to < 0))) continue;
        const double share = from / (from - to);
        double met[3];
        for (int axis = 0; axis < 3; ++axis) met[axis] = a[axis] + share * (b[axis] - a[axis]);
        met[plane.axis] = plane.position;
        parts[0].add(met);
        parts[1].add(met);
    }
}

/// `ref` held to `part`, rounded outwards, so that the parts together hold all that `ref` did.
PrimRef part_of(PrimRef ref, const PartBox& part) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto lo =
            static_cast<float>(part.lo[axis] - std::fabs(part.lo[axis]) * kUnit - kLeast);
        const auto hi =
            static_cast<float>(part.hi[axis] + std::fabs(part.hi[axis]) * kUnit + kLeast);
        at(ref.lo, axis) = std::max(at(ref.lo, axis), lo);
        at(ref.hi, axis) = std::min(at(ref.hi, axis), hi);
    }
    return ref;
}

bool is_box(const PrimRef& ref) {
    return ref.lo.x <= ref.hi.x && ref.lo.y <= ref.hi.y && ref.lo.z <= ref.hi.z;
}

/// Both parts of `ref`, which straddles the plane; false when rounding leaves one of them no box.
bool cut_ref(const TriangleCorners& triangle, const CutPlane& plane, const PrimRef& ref,
             PrimRef parts[2]) {
    PartBox boxes[2];
    clip_triangle(triangle, plane, boxes);
    parts[0] = part_of(ref, boxes[0]);
    parts[1] = part_of(ref, boxes[1]);
    parts[0].need = parts[1].need = 0.5f * ref.need;
    return is_box(parts[0]) && is_box(parts[1]);
}

/// What the parts of triangles within one slab measure, how many triangles begin and end there.
struct CutBin {
    Box4 box;
    int64_t enter, exit;
};

struct CutBins {
    CutBin bin[kCutBins];
    float plane[kCutBins];  // plane[k] is the low side of slab k
    float scale;            // slabs a unit of length
    int axis;
};

CutBins empty_cut_bins(const Bounds& box, int axis) {
    CutBins bins;
    bins.axis = axis;
    const double lo = along(box.lo, axis), step = (along(box.hi, axis) - lo) / kCutBins;
    bins.scale = static_cast<float>(std::min(1 / step, 1e30));
    for (int k = 0; k < kCutBins; ++k) {
        bins.bin[k] = {empty_box(), 0, 0};
        bins.plane[k] = static_cast<float>(lo + k * step);
    }
    return bins;
}

/// Slabs that a reference begins and ends in.
struct SlabRange {
    int first, last;
};

SlabRange slabs_of(const CutBins& bins, float lo, float hi) {
    const auto guess = [&](float x) {
        return std::clamp(static_cast<int>((x - bins.plane[0]) * bins.scale), 0, kCutBins - 1);
    };
    int first = guess(lo), last = guess(hi);
    while (first + 1 < kCutBins && bins.plane[first + 1] <= lo) ++first;
    while (first > 0 && bins.plane[first] > lo) --first;
    while (last + 1 < kCutBins && bins.plane[last + 1] < hi) ++last;
    while (last > 0 && bins.plane[last] >= hi) --last;
    return {first, std::max(first, last)};
}

void grow_bin(CutBin& bin, Float4 p) {
    bin.box = united(bin.box, Box4{p, p});
}

/// Adds an edge's points on the planes within `slabs`, held to `box`.
void add_edge(CutBins& bins, const SlabRange& slabs, const Box4& box, const float* a,
              const float* b) {
    const float from = a[bins.axis], to = b[bins.axis], low = std::min(from, to);
    const float high = std::max(from, to), inverse = 1.0f / (to - from);
    const Float4 start = load4(a), way = load4(b) - start;
    for (int k = slabs.first + 1; k <= slabs.last; ++k) {
        if (bins.plane[k] <= low || bins.plane[k] >= high) continue;
        const Float4 p = start + way * splat4((bins.plane[k] - from) * inverse);
        const Float4 held = min4(max4(p, box.lo), box.hi);
        grow_bin(bins.bin[k - 1], held);
        grow_bin(bins.bin[k], held);
    }
}

/// Adds a reference; boxes of parts are as good as floats go, because they only weigh planes.
void add_cut(CutBins& bins, const PrimRef& ref, const CornersOf& corners) {
    const float lo[3] = {ref.lo.x, ref.lo.y, ref.lo.z}, hi[3] = {ref.hi.x, ref.hi.y, ref.hi.z};
    const SlabRange slabs = slabs_of(bins, lo[bins.axis], hi[bins.axis]);
    ++bins.bin[slabs.first].enter;
    ++bins.bin[slabs.last].exit;
    const Box4 box = rows_of(ref);
    if (slabs.first == slabs.last) {
        bins.bin[slabs.first].box = united(bins.bin[slabs.first].box, box);
        return;
    }
    const TriangleCorners triangle = corners(ref.item);
    alignas(16) float p[3][4];
    for (int k = 0; k < 3; ++k) {
        const Vec3 corner = triangle.p[k];
        const float row[4] = {corner.x, corner.y, corner.z, 0};
        std::copy(row, row + 4, p[k]);
        const SlabRange at_corner = slabs_of(bins, row[bins.axis], row[bins.axis]);
        const int slab = std::clamp(at_corner.first, slabs.first, slabs.last);
        grow_bin(bins.bin[slab], min4(max4(load4(p[k]), box.lo), box.hi));
    }
    for (int k = 0; k < 3; ++k) add_edge(bins, slabs, box, p[k], p[(k + 1) % 3]);
}

void merge_bins(CutBins& bins, const CutBins& part) {
    for (int k = 0; k < kCutBins; ++k) {
        bins.bin[k].box = united(bins.bin[k].box, part.bin[k].box);
        bins.bin[k].enter += part.bin[k].enter;
        bins.bin[k].exit += part.bin[k].exit;
    }
}

/// Axes along which a range is long enough for cuts to matter.
constexpr double kLeastExtent = 0.1;  // of the longest

struct AllCutBins {
    CutBins along[3];
    int count = 0;
};

AllCutBins empty_cut_bins(const Bounds& box) {
    AllCutBins bins;
    double longest = 0;
    for (int axis = 0; axis < 3; ++axis)
        longest = std::max(longest, along(box.hi, axis) - along(box.lo, axis));
    for (int axis = 0; axis < 3; ++axis)
        if (along(box.hi, axis) - along(box.lo, axis) > kLeastExtent * longest)
            bins.along[bins.count++] = empty_cut_bins(box, axis);
    return bins;
}

void fill_cut_bins(const PrimRef* refs, int64_t begin, int64_t end, const CornersOf& corners,
                   AllCutBins& bins) {
    for (int64_t k = begin; k < end; ++k)
        for (int axis = 0; axis < bins.count; ++axis) add_cut(bins.along[axis], refs[k], corners);
}

AllCutBins cut_bins_of(const PrimRef* refs, const PrimRange& range, const SplitSettings& settings) {
    AllCutBins bins = empty_cut_bins(range.box);
    if (range.end - range.begin <= kGrain) {
        fill_cut_bins(refs, range.begin, range.end, *settings.corners, bins);
        return bins;
    }
    std::mutex mutex;
    parallel_for(
        range.end - range.begin, kGrain, settings.threads, [&](int64_t begin, int64_t end) {
            AllCutBins part = empty_cut_bins(range.box);
            fill_cut_bins(refs, range.begin + begin, range.begin + end, *settings.corners, part);
            const std::lock_guard<std::mutex> lock(mutex);
            for (int axis = 0; axis < bins.count; ++axis)
                merge_bins(bins.along[axis], part.along[axis]);
        });
    return bins;
}

/// A plane with what its sides would hold.
struct CutChoice {
    double cost = HUGE_VAL;
    CutPlane plane{0, 0};
    Box4 left, right;
    int64_t left_count = 0, right_count = 0;
};

/// The cheaper of `best` and the planes of `bins` whose halves are both smaller than the range.
void choose_cut(const CutBins& bins, const PrimRange& range, int block_width, CutChoice* best) {
    const int64_t items = range.end - range.begin;
    Box4 right[kCutBins];
    int64_t right_count[kCutBins];
    Box4 box = empty_box();
    int64_t count = 0;
    for (int k = kCutBins - 1; k > 0; --k) {
        right[k] = box = united(box, bins.bin[k].box);
        right_count[k] = count += bins.bin[k].exit;
    }
    box = empty_box();
    count = 0;
    for (int k = 1; k < kCutBins; ++k) {
        box = united(box, bins.bin[k - 1].box);
        count += bins.bin[k - 1].enter;
        if (count == 0 || right_count[k] == 0 || count >= items || right_count[k] >= items)
            continue;
        if (count + right_count[k] > items + range.room) continue;
        const double cost =
            cost_of(box, count, block_width) + cost_of(right[k], right_count[k], block_width);
        if (cost >= best->cost) continue;
        *best = {cost, {bins.axis, bins.plane[k]}, box, right[k], count, right_count[k]};
    }
}

enum class Side { left, right, both };

/// Where a triangle that the plane meets goes at the least cost: whole to one side, or cut.
Side side_of(const CutChoice& choice, const Box4& box) {
    const double left = half_area_of(choice.left), right = half_area_of(choice.right);
    const auto l = static_cast<double>(choice.left_count);
    const auto r = static_cast<double>(choice.right_count);
    const double cut = left * l + right * r;
    const double whole_left = half_area_of(united(choice.left, box)) * l + right * (r - 1);
    const double whole_right = left * (l - 1) + half_area_of(united(choice.right, box)) * r;
    if (whole_left <= cut && whole_left <= whole_right && choice.right_count > 1) return Side::left;
    if (whole_right <= cut && choice.left_count > 1) return Side::right;
    return Side::both;
}

/// The halves of a range while they are filled.
struct CutHalves {
    std::vector<PrimRef> refs[2];
    Extent extent[2] = {empty_extent(), empty_extent()};
    void add(int side, const PrimRef& ref) {
        refs[side].push_back(ref);
        grow(&extent[side], rows_of(ref));
    }
};

void sort_ref(const PrimRef& ref, const SplitSettings& settings, CutChoice& choice,
              CutHalves& halves) {
    PrimRef whole = ref;
    const float lo = at(whole.lo, choice.plane.axis), hi = at(whole.hi, choice.plane.axis);
    if (hi <= choice.plane.position) return halves.add(0, ref);
    if (lo >= choice.plane.position) return halves.add(1, ref);
    const Side side = side_of(choice, rows_of(ref));
    PrimRef parts[2];
    if (side == Side::both && cut_ref((*settings.corners)(ref.item), choice.plane, ref, parts)) {
        halves.add(0, parts[0]);
        halves.add(1, parts[1]);
    } else if (side == Side::right) {
        --choice.left_count;
        choice.right = united(choice.right, rows_of(ref));
        halves.add(1, ref);
    } else {
        --choice.right_count;
        choice.left = united(choice.left, rows_of(ref));
        halves.add(0, ref);
    }
}

}  // namespace

bool cut_range(PrimRef* refs, const PrimRange& range, const SplitSettings& settings,
               double least_cost, PrimRange halves[2]) {
    CutChoice choice;
    choice.cost = least_cost;
    const AllCutBins bins = cut_bins_of(refs, range, settings);
    for (int axis = 0; axis < bins.count; ++axis)
        choose_cut(bins.along[axis], range, settings.block_width, &choice);
    if (choice.left_count == 0) return false;

    CutHalves parts;
    for (int64_t k = range.begin; k < range.end; ++k) sort_ref(refs[k], settings, choice, parts);
    if (parts.refs[0].empty() || parts.refs[1].empty()) return false;
    const auto middle = range.begin + static_cast<int64_t>(parts.refs[0].size());
    const auto end = middle + static_cast<int64_t>(parts.refs[1].size());
    std::copy(parts.refs[0].begin(), parts.refs[0].end(), refs + range.begin);
    std::copy(parts.refs[1].begin(), parts.refs[1].end(), refs + middle);
    halves[0] = range_of(range.begin, middle, parts.extent[0]);
    halves[1] = range_of(middle, end, parts.extent[1]);
    return true;
}

}  // namespace trg

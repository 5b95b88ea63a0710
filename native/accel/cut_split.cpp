#include "accel/cut_split.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "accel/box4.h"
#include "base/parallel.h"

namespace trg {

namespace {

constexpr int kCutBins = 8;
constexpr int64_t kGrain = 1 << 13;
/// Axes along which a range is shorter than this share of the longest are not cut.
constexpr double kLeastExtent = 0.1;
constexpr int64_t kLeastSample = 128, kMostStride = 16;
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

/// Slabs along the three axes: what the parts of triangles within each measure, and how many
/// triangles begin and end there.
struct CutBins {
    Float4 low, scale;  // of positions to slabs
    bool used[3];
    Box4 box[3][kCutBins];
    int enter[3][kCutBins], exit[3][kCutBins];
    float plane[3][kCutBins];  // plane[axis][k] is the low side of slab k
};

CutBins empty_cut_bins(const Bounds& box) {
    CutBins bins;
    double longest = 0;
    alignas(16) float low[4] = {box.lo.x, box.lo.y, box.lo.z, 0}, scale[4] = {0, 0, 0, 0};
    for (int axis = 0; axis < 3; ++axis)
        longest = std::max(longest, along(box.hi, axis) - along(box.lo, axis));
    for (int axis = 0; axis < 3; ++axis) {
        const double extent = along(box.hi, axis) - along(box.lo, axis);
        const double step = extent / kCutBins;
        bins.used[axis] = extent > kLeastExtent * longest;
        scale[axis] = static_cast<float>(std::min(1 / step, 1e30));
        for (int k = 0; k < kCutBins; ++k) {
            bins.box[axis][k] = empty_box();
            bins.enter[axis][k] = bins.exit[axis][k] = 0;
            bins.plane[axis][k] = static_cast<float>(low[axis] + k * step);
        }
    }
    bins.low = load4(low);
    bins.scale = load4(scale);
    return bins;
}

/// Slabs along each axis that a point lies in; what ends at a plane does not reach beyond it.
void slabs_of(const CutBins& bins, Float4 point, Float4 shift, int slabs[4]) {
    const Float4 slab = (point - bins.low) * bins.scale + shift;
    truncate4(slabs, min4(max4(slab, splat4(0)), splat4(kCutBins - 1)));
}

/// A corner of a triangle and the slabs it lies in.
struct CutCorner {
    alignas(16) float row[4];
    int slabs[4];
};

/// The piece of a reference along one axis: its box and the slabs from `first` to `last`.
struct CutPiece {
    Box4 box;
    int axis, first, last;
};

/// Adds an edge, slab by slab, held to the piece's box.
void add_edge(CutBins& bins, const CutPiece& piece, const CutCorner& a, const CutCorner& b) {
    const int axis = piece.axis;
    const bool rises = a.row[axis] <= b.row[axis];
    const CutCorner &low = rises ? a : b, &high = rises ? b : a;
    const int first = std::clamp(low.slabs[axis], piece.first, piece.last);
    const int last = std::clamp(high.slabs[axis], first, piece.last);
    const Float4 start = load4(low.row), end = load4(high.row), way = end - start;
    const float inverse = 1.0f / (high.row[axis] - low.row[axis]);
    Float4 from = min4(max4(start, piece.box.lo), piece.box.hi);
    for (int k = first; k <= last; ++k) {
        Float4 to = end;
        if (k < last)
            to = start + way * splat4((bins.plane[axis][k + 1] - low.row[axis]) * inverse);
        to = min4(max4(to, piece.box.lo), piece.box.hi);
        Box4& bin = bins.box[axis][k];
        bin = united(bin, Box4{min4(from, to), max4(from, to)});
        from = to;
    }
}

void add_pieces(CutBins& bins, const TriangleCorners& triangle, CutPiece pieces[], int count) {
    CutCorner corners[3];
    for (int k = 0; k < 3; ++k) {
        const Vec3 p = triangle.p[k];
        const float row[4] = {p.x, p.y, p.z, 0};
        std::copy(row, row + 4, corners[k].row);
        slabs_of(bins, load4(corners[k].row), splat4(0), corners[k].slabs);
    }
    for (int k = 0; k < count; ++k)
        for (int edge = 0; edge < 3; ++edge)
            add_edge(bins, pieces[k], corners[edge], corners[(edge + 1) % 3]);
}

/// Adds a reference; boxes of parts are as good as floats go, because they only weigh planes.
void add_cut(CutBins& bins, const PrimRef& ref, const CornersOf& corners) {
    const Box4 box = rows_of(ref);
    int first[4], last[4], count = 0;
    slabs_of(bins, box.lo, splat4(0), first);
    slabs_of(bins, box.hi, splat4(-0x1p-16f), last);
    CutPiece pieces[3];
    for (int axis = 0; axis < 3; ++axis) {
        if (!bins.used[axis]) continue;
        last[axis] = std::max(first[axis], last[axis]);
        ++bins.enter[axis][first[axis]];
        ++bins.exit[axis][last[axis]];
        Box4& bin = bins.box[axis][first[axis]];
        if (first[axis] == last[axis])
            bin = united(bin, box);
        else
            pieces[count++] = {box, axis, first[axis], last[axis]};
    }
    if (count > 0) add_pieces(bins, corners(ref.item), pieces, count);
}

void merge_bins(CutBins& bins, const CutBins& part) {
    for (int axis = 0; axis < 3; ++axis) {
        for (int k = 0; k < kCutBins; ++k) {
            bins.box[axis][k] = united(bins.box[axis][k], part.box[axis][k]);
            bins.enter[axis][k] += part.enter[axis][k];
            bins.exit[axis][k] += part.exit[axis][k];
        }
    }
}

/// Of a range only every so many-th item weighs the planes, which is as good and much cheaper.
int64_t stride_of(int64_t items) {
    return std::clamp<int64_t>(items / kLeastSample, 1, kMostStride);
}

CutBins cut_bins_of(const PrimRef* refs, const PrimRange& range, const SplitSettings& settings) {
    CutBins bins = empty_cut_bins(range.box);
    std::mutex mutex;
    parallel_for(range.end - range.begin, kGrain, settings.threads,
                 [&](int64_t begin, int64_t end) {
                     CutBins part = empty_cut_bins(range.box);
                     const int64_t step = stride_of(range.end - range.begin);
                     for (int64_t k = begin; k < end; k += step)
                         add_cut(part, refs[range.begin + k], *settings.corners);
                     const std::lock_guard<std::mutex> lock(mutex);
                     merge_bins(bins, part);
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

/// The cheaper of `best` and the planes across `axis` whose halves are both smaller than the range.
void choose_cut(const CutBins& bins, int axis, const PrimRange& range, int block_width,
                CutChoice* best) {
    const int64_t items = range.end - range.begin;
    const int64_t stride = stride_of(items);
    Box4 right[kCutBins];
    int64_t right_count[kCutBins];
    Box4 box = empty_box();
    int64_t count = 0;
    for (int k = kCutBins - 1; k > 0; --k) {
        right[k] = box = united(box, bins.box[axis][k]);
        right_count[k] = count += bins.exit[axis][k] * stride;
    }
    box = empty_box();
    count = 0;
    for (int k = 1; k < kCutBins; ++k) {
        box = united(box, bins.box[axis][k - 1]);
        count += bins.enter[axis][k - 1] * stride;
        if (count == 0 || right_count[k] == 0 || count >= items || right_count[k] >= items)
            continue;
        if (count + right_count[k] > items + range.room) continue;
        const double cost =
            cost_of(box, count, block_width) + cost_of(right[k], right_count[k], block_width);
        if (cost >= best->cost) continue;
        *best = {cost, {axis, bins.plane[axis][k]}, box, right[k], count, right_count[k]};
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
    PrimRefs refs[2];
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
    const CutBins bins = cut_bins_of(refs, range, settings);
    for (int axis = 0; axis < 3; ++axis)
        if (bins.used[axis]) choose_cut(bins, axis, range, settings.block_width, &choice);
    if (choice.left_count == 0) return false;

    CutHalves parts;
    for (PrimRefs& half : parts.refs) half.reserve(range.end - range.begin);
    for (int64_t k = range.begin; k < range.end; ++k) sort_ref(refs[k], settings, choice, parts);
    // Slabs have counted as well as floats go.
    const int64_t items = range.end - range.begin;
    const auto left = static_cast<int64_t>(parts.refs[0].size());
    const auto right = static_cast<int64_t>(parts.refs[1].size());
    if (left == 0 || right == 0 || std::max(left, right) >= items) return false;
    if (left + right > items + range.room) return false;
    const int64_t middle = range.begin + left, end = middle + right;
    std::copy(parts.refs[0].begin(), parts.refs[0].end(), refs + range.begin);
    std::copy(parts.refs[1].begin(), parts.refs[1].end(), refs + middle);
    halves[0] = range_of(range.begin, middle, parts.extent[0]);
    halves[1] = range_of(middle, end, parts.extent[1]);
    return true;
}

}  // namespace trg

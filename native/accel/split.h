/// Dividing a range of boxes in two by the surface area heuristic over bins (Wald 2007).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "accel/triangle_block.h"
#include "base/aligned.h"
#include "geom/bounds.h"

namespace trg {

/// The box of one item of a tree, and which item it is: two rows of four numbers. `need` is how
/// many cuts of the item would pay; 0 where nothing is cut.
struct alignas(16) PrimRef {
    Vec3 lo;
    int32_t item;
    Vec3 hi;
    float need;
};

TRG_FN PrimRef make_ref(const Bounds& box, int32_t item) {
    return {box.lo, item, box.hi, 0};
}
TRG_FN Bounds box_of(const PrimRef& ref) {
    return {ref.lo, ref.hi};
}

/// Uninitialised where it is made by size alone.
using PrimRefs = AlignedVector<PrimRef>;

/// A run of references with the box of them all and the box of their (doubled) centres. After `end`
/// there is room for `room` more, which cuts may fill.
struct PrimRange {
    int64_t begin, end;
    Bounds box;
    Bounds centres;
    float need = 0;
    int64_t room = 0;
};

/// The corners of an item; called by many threads at once.
using CornersOf = std::function<TriangleCorners(int64_t item)>;

struct SplitSettings {
    int block_width;  // items are paid for in blocks of this many, a power of two
    int threads;
    const CornersOf* corners = nullptr;  // null: items are never cut
    double root_area = 0;                // half the surface of the whole, where items may be cut
};

/// Range of refs[begin..end), its boxes measured. Does not depend on the number of threads.
PrimRange measure_range(const PrimRef* refs, int64_t begin, int64_t end, int threads = 1);

/// Reorders the references of `range` and returns its two halves, neither of them empty. Falls back
/// to halves by count where centres coincide. Does not depend on the number of threads.
void split_range(PrimRef* refs, const PrimRange& range, const SplitSettings& settings,
                 PrimRange halves[2]);

/// Halves by count, for ranges too deep in the tree for the heuristic.
void split_by_count(PrimRef* refs, const PrimRange& range, PrimRange halves[2]);

}  // namespace trg

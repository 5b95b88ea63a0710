/// Dividing a range by a plane that cuts the triangles it meets (Stich, Friedrich, Dietrich 2009).
#pragma once

#include "accel/split.h"

namespace trg {

/// Divides `range` at the cheapest of some planes if that costs less than `least_cost` and the
/// range's room suffices; then a triangle may be in both halves, each boxing its part. Else returns
/// false and leaves the references as they are. Does not depend on the number of threads.
bool cut_range(PrimRef* refs, const PrimRange& range, const SplitSettings& settings,
               double least_cost, PrimRange halves[2]);

/// Sets the need of every reference and returns how many cuts the mesh is worth, a quarter of the
/// references at most; 0 where cutting would save little, as on smooth meshes. Needs grow with the
/// box that a triangle does not fill (Karras and Aila 2013, section 4).
int64_t measure_needs(PrimRefs& refs, const Bounds& bounds, const SplitSettings& settings);

}  // namespace trg

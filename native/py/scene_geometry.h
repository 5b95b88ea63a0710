/// Methods of trg_native.Scene that take geometry and build the index over it.
#pragma once

#include <string>

#include "geom/transform.h"
#include "py/py_ref.h"

namespace trg::py {

/// `source`, 12 numbers, as a map; `row` of argument `name` is in the message of the ArgumentError
/// that a singular or non-finite one gives.
Transform checked_transform(const float* source, const char* name, int64_t row);

extern PyMethodDef kSceneGeometryMethods[];

}  // namespace trg::py

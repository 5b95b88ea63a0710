/// Methods of trg_native.Scene that take geometry and build the index over it.
#pragma once

#include "py/py_ref.h"

namespace trg::py {

extern PyMethodDef kSceneGeometryMethods[];

}  // namespace trg::py

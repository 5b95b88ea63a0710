/// Methods of trg_native.Scene that trace rays.
#pragma once

#include "py/py_ref.h"

namespace trg::py {

extern PyMethodDef kSceneQueryMethods[];

}  // namespace trg::py

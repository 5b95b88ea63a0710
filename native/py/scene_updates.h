/// Methods of trg_native.Scene that move what was built.
#pragma once

#include "py/py_ref.h"

namespace trg::py {

extern PyMethodDef kSceneUpdateMethods[];

}  // namespace trg::py

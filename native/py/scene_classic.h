/// Methods of trg_native.Scene for the classic integrator and for antialiasing.
#pragma once

#include "py/py_ref.h"

namespace trg::py {

extern PyMethodDef kSceneClassicMethods[];

}  // namespace trg::py

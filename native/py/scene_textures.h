/// Methods of trg_native.Scene that take images, textures, their programs and what those read.
#pragma once

#include "py/py_ref.h"

namespace trg::py {

extern PyMethodDef kSceneTextureMethods[];

}  // namespace trg::py

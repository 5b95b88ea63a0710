#include "py/scene_object.h"

namespace trg::py {

PyMethodDef kSceneRenderMethods[] = {{nullptr, nullptr, 0, nullptr}};

}  // namespace trg::py

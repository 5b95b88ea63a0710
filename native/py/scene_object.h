/// The Python type trg_native.Scene and how other types use the scene it holds.
#pragma once

#include "py/py_ref.h"
#include "scene/scene.h"

namespace trg::py {

struct SceneObject {
    PyObject_HEAD Scene* scene;
    int users;      // queries and jobs that are reading the scene; changed under the GIL
    bool changing;  // a build runs without the GIL
};

/// Methods of Scene that belong to rendering (scene_render_methods.cpp); ends with a null name.
extern PyMethodDef kSceneRenderMethods[];

/// The scene for a change. Throws StateError while a query or job reads it. Arguments are taken
/// before: an object that gives a buffer may be written in Python and use the scene itself.
Scene& scene_to_change(PyObject* self);

/// Throws ArgumentError unless `threads` is 0 (all cores) to 4096.
void check_threads(int threads);

/// Keeps a scene alive and unchanged while it lives; made and destroyed under the GIL.
/// Throws StateError when `self` was not built since its last change of geometry.
class SceneUse {
  public:
    explicit SceneUse(PyObject* self);
    ~SceneUse();
    SceneUse(const SceneUse&) = delete;
    SceneUse& operator=(const SceneUse&) = delete;

    const Scene& scene() const { return *object_->scene; }

  private:
    SceneObject* object_;
};

/// Keeps a scene from every other use while a change runs without the GIL.
class SceneChange {
  public:
    explicit SceneChange(PyObject* self);
    ~SceneChange();
    SceneChange(const SceneChange&) = delete;
    SceneChange& operator=(const SceneChange&) = delete;

  private:
    SceneObject* object_;
};

/// `method`, which may take keywords, as the type that a PyMethodDef holds.
template <class Method>
PyCFunction as_method(Method method) {
    return reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(method));
}

/// Adds the type to `module`. Throws PythonError.
void add_scene_type(PyObject* module);

}  // namespace trg::py

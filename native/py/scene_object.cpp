#include "py/scene_object.h"

#include "py/scene_classic.h"

#include <cstring>

#include "py/scene_geometry.h"
#include "py/scene_queries.h"
#include "py/scene_textures.h"
#include "py/scene_updates.h"

namespace trg::py {

namespace {

SceneObject* as_scene(PyObject* self) {
    return reinterpret_cast<SceneObject*>(self);
}

AccelKind parse_accel(const char* name) {
    if (std::strcmp(name, "auto") == 0) return AccelKind::automatic;
    if (std::strcmp(name, "bvh") == 0) return AccelKind::bvh;
    if (std::strcmp(name, "grid") == 0) return AccelKind::grid;
    if (std::strcmp(name, "grid2") == 0) return AccelKind::grid2;
    if (std::strcmp(name, "tree") == 0) return AccelKind::tree;
    if (std::strcmp(name, "none") == 0) return AccelKind::none;
    throw ArgumentError("accel: expected auto, bvh, grid, grid2, tree or none, got " +
                        std::string(name));
}

/// "auto" is the best set of this machine.
Isa parse_instruction_set(const char* name) {
    if (std::strcmp(name, "auto") == 0) return detect_isa();
    for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
        if (std::strcmp(name, isa_name(isa)) != 0) continue;
        if (isa <= detect_isa()) return isa;
        throw ArgumentError("instruction_set: this machine has no " + std::string(name));
    }
    throw ArgumentError("instruction_set: expected auto, baseline, avx2 or avx512, got " +
                        std::string(name));
}

TriangleTest parse_triangle_test(const char* name) {
    if (std::strcmp(name, "watertight") == 0) return TriangleTest::watertight;
    if (std::strcmp(name, "classic") == 0) return TriangleTest::classic;
    throw ArgumentError("triangle_test: expected watertight or classic, got " + std::string(name));
}

PyObject* new_scene(PyTypeObject* type, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        const char* accel = "auto";
        const char* triangle_test = "watertight";
        const char* instruction_set = "auto";
        const char* const names[] = {"accel", "triangle_test", "instruction_set", nullptr};
        parse_arguments(args, kwargs, "|sss", names, &accel, &triangle_test, &instruction_set);
        auto scene = std::make_unique<Scene>();
        scene->world.accel = parse_accel(accel);
        scene->world.triangle_test = parse_triangle_test(triangle_test);
        scene->world.isa = parse_instruction_set(instruction_set);
        auto allocate = reinterpret_cast<allocfunc>(PyType_GetSlot(type, Py_tp_alloc));
        PyRef self = checked(allocate(type, 0));
        as_scene(self.get())->scene = scene.release();
        return self;
    });
}

void free_scene(PyObject* self) {
    PyTypeObject* type = Py_TYPE(self);
    delete as_scene(self)->scene;
    reinterpret_cast<freefunc>(PyType_GetSlot(type, Py_tp_free))(self);
    Py_DECREF(type);
}

void add_methods(PyObject* type, PyMethodDef* methods) {
    for (PyMethodDef* method = methods; method->ml_name; ++method) {
        PyRef descriptor =
            checked(PyDescr_NewMethod(reinterpret_cast<PyTypeObject*>(type), method));
        if (PyObject_SetAttrString(type, method->ml_name, descriptor.get()) != 0)
            throw PythonError{};
    }
}

PyType_Slot kSceneSlots[] = {
    {Py_tp_doc,
     const_cast<char*>("Scene(accel='auto', triangle_test='watertight', instruction_set='auto')\n\n"
                       "Geometry, its index and the tables of shading.")},
    {Py_tp_new, reinterpret_cast<void*>(new_scene)},
    {Py_tp_dealloc, reinterpret_cast<void*>(free_scene)},
    {0, nullptr}};

PyType_Spec kSceneSpec = {"trg_native.Scene", sizeof(SceneObject), 0, Py_TPFLAGS_DEFAULT,
                          kSceneSlots};

}  // namespace

Scene& scene_to_change(PyObject* self) {
    if (as_scene(self)->users > 0 || as_scene(self)->changing)
        throw StateError("the scene is in use by a query or a job and cannot change");
    return *as_scene(self)->scene;
}

void check_threads(int threads) {
    constexpr int kMostThreads = 4096;
    if (threads < 0 || threads > kMostThreads)
        throw ArgumentError("threads: expected 0 to " + std::to_string(kMostThreads) + ", got " +
                            std::to_string(threads));
}

SceneUse::SceneUse(PyObject* self) : object_(as_scene(self)) {
    if (object_->changing) throw StateError("the scene is being built");
    if (!object_->scene->world.index) throw StateError("the scene must be built first: call build");
    Py_INCREF(self);
    ++object_->users;
}

SceneUse::~SceneUse() {
    --object_->users;
    Py_DECREF(reinterpret_cast<PyObject*>(object_));
}

SceneChange::SceneChange(PyObject* self) : object_(as_scene(self)) {
    object_->changing = true;
}

SceneChange::~SceneChange() {
    object_->changing = false;
}

void add_scene_type(PyObject* module) {
    PyRef type = checked(PyType_FromModuleAndSpec(module, &kSceneSpec, nullptr));
    add_methods(type.get(), kSceneGeometryMethods);
    add_methods(type.get(), kSceneUpdateMethods);
    add_methods(type.get(), kSceneQueryMethods);
    add_methods(type.get(), kSceneRenderMethods);
    add_methods(type.get(), kSceneClassicMethods);
    add_methods(type.get(), kSceneTextureMethods);
    if (PyModule_AddObjectRef(module, "Scene", type.get()) != 0) throw PythonError{};
}

}  // namespace trg::py

#include "py/scene_classic.h"

#include "py/buffer.h"
#include "py/scene_object.h"
#include "scene/classic_table.h"

namespace trg::py {

namespace {

constexpr int kFinestGrid = 64;

PyObject* set_classic_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        PyObject *table, *ambient;
        const char* const names[] = {"table", "ambient", nullptr};
        parse_arguments(args, kwargs, "OO", names, &table, &ambient);
        const Buffer rows = Buffer::of<float>(table, "table", {kAnyExtent, kAnyExtent});
        const PyRef color = checked(PySequence_Tuple(ambient));
        Vec3 light;
        if (!PyArg_ParseTuple(color.get(), "fff;ambient: expected (r, g, b)", &light.x, &light.y,
                              &light.z))
            throw PythonError{};
        set_classic(scene_to_change(self).tables,
                    {rows.data<float>(), rows.extent(0), rows.extent(1)}, light);
        return none();
    });
}

Antialiasing parse_antialiasing(PyObject* kind) {
    const std::vector<const char*> names = {"sobol", "none", "supersampling", "jittering", "mfaa"};
    Py_ssize_t size;
    const char* text = PyUnicode_AsUTF8AndSize(kind, &size);
    if (!text) throw PythonError{};
    for (size_t k = 0; k < names.size(); ++k)
        if (std::string(text, size) == names[k]) return static_cast<Antialiasing>(k);
    throw ArgumentError("kind: expected sobol, none, supersampling, jittering or mfaa");
}

PyObject* set_antialiasing_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        PyObject* kind;
        int side = 1, frame = 0;
        const char* const names[] = {"kind", "side", "frame", nullptr};
        parse_arguments(args, kwargs, "O|ii", names, &kind, &side, &frame);
        if (side < 1 || side > kFinestGrid)
            throw ArgumentError("side: expected 1 to " + std::to_string(kFinestGrid));
        scene_to_change(self).tables.antialiasing = {parse_antialiasing(kind),
                                                     static_cast<uint32_t>(side),
                                                     static_cast<uint32_t>(frame), false};
        return none();
    });
}

}  // namespace

PyMethodDef kSceneClassicMethods[] = {
    {"set_classic", as_method(set_classic_method), METH_VARARGS | METH_KEYWORDS,
     "set_classic(table, ambient): the classic integrator renders the scene\n\n"
     "table: float32 (materials, len(CLASSIC_FIELDS)); ambient: (r, g, b)."},
    {"set_antialiasing", as_method(set_antialiasing_method), METH_VARARGS | METH_KEYWORDS,
     "set_antialiasing(kind, side=1, frame=0): where samples lie in their pixel\n\n"
     "kind: sobol, none, supersampling, jittering or mfaa; side: of the grid of cells, 1 to 64; "
     "frame: its parity picks the pattern of mfaa."},
    {nullptr, nullptr, 0, nullptr}};

}  // namespace trg::py

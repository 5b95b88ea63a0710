#include "py/job_object.h"

#include <cmath>

#include "cpu/picture_error.h"
#include "cpu/pixel_error.h"
#include "py/buffer.h"
#include "py/scene_object.h"
#include "scene/classic_table.h"

namespace trg::py {

namespace {

struct JobObject {
    PyObject_HEAD SceneUse* use;
    RenderJob* job;
};

RenderJob& job_of(PyObject* self) {
    return *reinterpret_cast<JobObject*>(self)->job;
}

/// A running job is cancelled and joined while other Python threads run.
void free_job(PyObject* self) {
    JobObject* object = reinterpret_cast<JobObject*>(self);
    PyTypeObject* type = Py_TYPE(self);
    if (object->job) {
        const WithoutGil unlocked;
        delete object->job;
    }
    delete object->use;
    reinterpret_cast<freefunc>(PyType_GetSlot(type, Py_tp_free))(self);
    Py_DECREF(type);
}

PyObject* as_bool(bool value) {
    return value ? Py_True : Py_False;
}

const char* name_of(StopReason reason) {
    switch (reason) {
        case StopReason::samples:
            return "samples";
        case StopReason::time:
            return "time";
        case StopReason::error:
            return "error";
        case StopReason::cancel:
            return "cancel";
        default:
            return nullptr;
    }
}

PyObject* poll_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        double timeout_s = 0.0;
        const char* const names[] = {"timeout_s", nullptr};
        parse_arguments(args, kwargs, "|d", names, &timeout_s);
        if (!(timeout_s >= 0.0 && timeout_s <= 1e6))
            throw ArgumentError("timeout_s: expected 0 to 1e6 seconds");
        RenderProgress state{};
        {
            const WithoutGil unlocked;
            state = job_of(self).wait(timeout_s);
        }
        return checked(Py_BuildValue(
            "{s:O, s:O, s:z, s:L, s:L, s:d, s:L, s:L, s:L, s:L, s:L, s:L, s:s}", "done",
            as_bool(state.done), "cancelled", as_bool(state.stopped_by == StopReason::cancel),
            "stopped_by", name_of(state.stopped_by), "samples",
            static_cast<long long>(state.samples), "target", static_cast<long long>(state.target),
            "seconds", state.seconds, "rays_camera", static_cast<long long>(state.rays.camera),
            "rays_shadow", static_cast<long long>(state.rays.shadow), "rays_bounce",
            static_cast<long long>(state.rays.bounce), "rejected_samples",
            static_cast<long long>(state.rejected_samples), "cut_rays",
            static_cast<long long>(state.rays.cut), "clamped",
            static_cast<long long>(state.rays.clamped), "kernel_set", job_of(self).kernel_set()));
    });
}

PyObject* cancel_method(PyObject* self, PyObject*) {
    return guarded_object([&] {
        job_of(self).cancel();
        return none();
    });
}

PyObject* rejected_places_method(PyObject* self, PyObject*) {
    return guarded_object([&] {
        const std::vector<RejectedSample> places = job_of(self).film().rejected_places();
        PyRef list = checked(PyList_New(0));
        for (const RejectedSample& one : places) {
            const PyRef row =
                checked(Py_BuildValue("(iiL)", one.x, one.y, static_cast<long long>(one.sample)));
            if (PyList_Append(list.get(), row.get()) != 0) throw PythonError();
        }
        return list;
    });
}

PyObject* combined_method(PyObject* self, PyObject* out) {
    return guarded_object([&] {
        const Film& film = job_of(self).film();
        Buffer pixels =
            Buffer::of<float>(out, "out", {film.height(), film.width(), 4}, Access::write);
        {
            const WithoutGil unlocked;
            film.read_combined(pixels.mutable_data<float>());
        }
        return none();
    });
}

PyObject* depth_method(PyObject* self, PyObject* out) {
    return guarded_object([&] {
        const Film& film = job_of(self).film();
        if (!film.passes().depth) throw StateError("the render was not asked for depth");
        Buffer pixels = Buffer::of<float>(out, "out", {film.height(), film.width()}, Access::write);
        {
            const WithoutGil unlocked;
            film.read_depth(pixels.mutable_data<float>());
        }
        return none();
    });
}

PyObject* normal_method(PyObject* self, PyObject* out) {
    return guarded_object([&] {
        const Film& film = job_of(self).film();
        if (!film.passes().normal) throw StateError("the render was not asked for normals");
        Buffer pixels =
            Buffer::of<float>(out, "out", {film.height(), film.width(), 3}, Access::write);
        {
            const WithoutGil unlocked;
            film.read_normal(pixels.mutable_data<float>());
        }
        return none();
    });
}

PyObject* read_pass_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        const char* name;
        PyObject* out;
        const char* const names[] = {"name", "out", nullptr};
        parse_arguments(args, kwargs, "sO", names, &name, &out);
        const Film& film = job_of(self).film();
        const PassKind kind = find_pass(name);
        if (kind == kPassKinds || !film.passes().more.has(kind))
            throw StateError(std::string("the render was not asked for ") + name);
        Buffer pixels = Buffer::of<float>(
            out, "out", {film.height(), film.width(), film.pass_film().channels(kind)},
            Access::write);
        {
            const WithoutGil unlocked;
            film.read_pass(kind, pixels.mutable_data<float>());
        }
        return none();
    });
}

PyObject* replicates_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        PyObject *sums, *counts;
        const char* const names[] = {"sums", "counts", nullptr};
        parse_arguments(args, kwargs, "OO", names, &sums, &counts);
        const Film& film = job_of(self).film();
        Buffer planes = Buffer::of<double>(
            sums, "sums", {kReplicates, film.height(), film.width(), 3}, Access::write);
        Buffer numbers = Buffer::of<int64_t>(counts, "counts", {kReplicates}, Access::write);
        {
            const WithoutGil unlocked;
            film.read_replicates(planes.mutable_data<double>(), numbers.mutable_data<int64_t>());
        }
        return none();
    });
}

PyObject* error_method(PyObject* self, PyObject*) {
    return guarded_object([&] {
        PictureError error;
        {
            const WithoutGil unlocked;
            error = measure_error(job_of(self).film());
        }
        const bool known = error.replicates >= 2;
        PyRef without = checked(PyTuple_New(static_cast<Py_ssize_t>(error.delete_one_mse.size())));
        for (size_t k = 0; k < error.delete_one_mse.size(); ++k) {
            PyRef value = checked(PyFloat_FromDouble(error.delete_one_mse[k]));
            if (PyTuple_SetItem(without.get(), static_cast<Py_ssize_t>(k), value.release()) != 0)
                throw PythonError{};
        }
        PyRef mse = known ? checked(PyFloat_FromDouble(error.mse)) : none();
        PyRef relmse = known ? checked(PyFloat_FromDouble(error.relmse)) : none();
        return checked(Py_BuildValue("{s:i, s:i, s:O, s:O, s:d, s:O}", "replicates",
                                     error.replicates, "groups", error.halves ? 2 : 1, "mse",
                                     mse.get(), "relmse", relmse.get(), "normal_spread",
                                     error.normal_spread, "delete_one_mse", without.get()));
    });
}

PyObject* pixel_error_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        PyObject *half_width, *flags;
        const char* const names[] = {"half_width", "flags", nullptr};
        parse_arguments(args, kwargs, "OO", names, &half_width, &flags);
        const Film& film = job_of(self).film();
        Buffer widths = Buffer::of<float>(half_width, "half_width", {film.height(), film.width()},
                                          Access::write);
        Buffer bits =
            Buffer::of<uint8_t>(flags, "flags", {film.height(), film.width()}, Access::write);
        Evidence evidence;
        {
            const WithoutGil unlocked;
            evidence = measure_pixel_error(film, widths.mutable_data<float>(),
                                           bits.mutable_data<uint8_t>());
        }
        return checked(Py_BuildValue("{s:d, s:d, s:d, s:d, s:d}", "lit", evidence.lit, "unseen",
                                     evidence.unseen, "lonely", evidence.lonely, "lonely_error",
                                     evidence.lonely_error, "error_pixels", evidence.error_pixels));
    });
}

PyMethodDef kJobMethods[] = {
    {"poll", as_method(poll_method), METH_VARARGS | METH_KEYWORDS,
     "poll(timeout_s=0) -> dict: waits at most so long for the end, then says where it stands"},
    {"cancel", cancel_method, METH_NOARGS, "cancel(): returns at once"},
    {"rejected_places", rejected_places_method, METH_NOARGS,
     "rejected_places() -> list: (x, y, sample) of the first samples that were not finite, at most "
     "16"},
    {"combined", combined_method, METH_O, "combined(out): fills float32 (h, w, 4)"},
    {"depth", depth_method, METH_O, "depth(out): fills float32 (h, w)"},
    {"normal", normal_method, METH_O, "normal(out): fills float32 (h, w, 3)"},
    {"read_pass", as_method(read_pass_method), METH_VARARGS | METH_KEYWORDS,
     "read_pass(name, out): fills float32 (h, w, channels); name is one of trg_native.PASSES"},
    {"replicates", as_method(replicates_method), METH_VARARGS | METH_KEYWORDS,
     "replicates(sums, counts): fills float64 (8, h, w, 3) and int64 (8,)"},
    {"error", error_method, METH_NOARGS,
     "error() -> dict: replicates, groups, mse, relmse, normal_spread, delete_one_mse; None below "
     "2 replicates"},
    {"pixel_error", as_method(pixel_error_method), METH_VARARGS | METH_KEYWORDS,
     "pixel_error(half_width, flags) -> dict: fills float32 (h, w), the 95 % half width of each "
     "pixel's luminance, and uint8 (h, w): 1 no replicate saw light, 2 one makes nearly all of the "
     "spread"},
    {nullptr, nullptr, 0, nullptr}};

PyType_Slot kJobSlots[] = {
    {Py_tp_doc, const_cast<char*>("A render under way, made by Scene.start_render.")},
    {Py_tp_methods, kJobMethods},
    {Py_tp_dealloc, reinterpret_cast<void*>(free_job)},
    {0, nullptr}};

PyType_Spec kJobSpec = {"trg_native.Job", sizeof(JobObject), 0,
                        Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, kJobSlots};

void add_names(PyObject* module, const char* name, const std::vector<const char*>& fields) {
    PyRef names = checked(PyTuple_New(static_cast<Py_ssize_t>(fields.size())));
    for (size_t k = 0; k < fields.size(); ++k) {
        PyRef text = checked(PyUnicode_FromString(fields[k]));
        if (PyTuple_SetItem(names.get(), static_cast<Py_ssize_t>(k), text.release()) != 0)
            throw PythonError{};
    }
    if (PyModule_AddObjectRef(module, name, names.get()) != 0) throw PythonError{};
}

}  // namespace

PyRef start_job(PyObject* scene, const RenderRequest& request) {
    PyRef module = checked(PyImport_ImportModule("trg_native"));
    PyRef type = checked(PyObject_GetAttrString(module.get(), "Job"));
    PyTypeObject* job_type = reinterpret_cast<PyTypeObject*>(type.get());
    auto allocate = reinterpret_cast<allocfunc>(PyType_GetSlot(job_type, Py_tp_alloc));
    PyRef self = checked(allocate(job_type, 0));
    JobObject* object = reinterpret_cast<JobObject*>(self.get());
    object->use = new SceneUse(scene);
    const WithoutGil unlocked;
    object->job = new RenderJob(object->use->scene(), request);
    return self;
}

void add_job_type(PyObject* module) {
    PyRef type = checked(PyType_FromModuleAndSpec(module, &kJobSpec, nullptr));
    if (PyModule_AddObjectRef(module, "Job", type.get()) != 0) throw PythonError{};
    std::vector<const char*> passes;
    for (const PassInfo& pass : kPassTable) passes.push_back(pass.name);
    add_names(module, "PASSES", passes);
    add_names(module, "MATERIAL_FIELDS", kMaterialFields);
    add_names(module, "CLASSIC_FIELDS", kClassicFields);
    add_names(module, "LIGHT_FIELDS", kLightFields);
    add_names(module, "TEXTURE_FIELDS", kTextureFields);
    add_names(module, "TEXTURE_OPS", kTextureOps);
}

}  // namespace trg::py

/// Methods of trg_native.Scene that take shading tables and start renders.
#include <cmath>

#include "py/buffer.h"
#include "py/job_object.h"
#include "py/scene_object.h"
#include "py/scene_textures.h"

namespace trg::py {

namespace {

constexpr int64_t kLargestSide = 1 << 20;
/// Of a film; its tiles are counted by 32 bits.
constexpr int64_t kMostPixels = 1 << 30;

/// The packed table in `object`; `hold` keeps its memory.
Table take_table(PyObject* object, const char* name, Buffer* hold) {
    *hold = Buffer::of<float>(object, name, {kAnyExtent, kAnyExtent});
    return {hold->data<float>(), hold->extent(0), hold->extent(1)};
}

/// Methods that replace one table.
template <void (*kSet)(ShadingTables&, const Table&)>
PyObject* set_table_method(PyObject* self, PyObject* table) {
    return guarded_object([&] {
        Buffer hold;
        const Table rows = take_table(table, "table", &hold);
        kSet(scene_to_change(self).tables, rows);
        return none();
    });
}

PyObject* set_world_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        float r, g, b;
        const char* const names[] = {"r", "g", "b", nullptr};
        parse_arguments(args, kwargs, "fff", names, &r, &g, &b);
        set_background(scene_to_change(self).tables, r, g, b);
        return none();
    });
}

PyObject* set_environment_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        PyObject *pixels, *rotation;
        int seen_by_camera = 1;
        const char* const names[] = {"pixels", "rotation", "seen_by_camera", nullptr};
        parse_arguments(args, kwargs, "OO|p", names, &pixels, &rotation, &seen_by_camera);
        Scene& scene = scene_to_change(self);
        const Buffer rows = Buffer::of<double>(rotation, "rotation", {3, 3});
        const double* m = rows.data<double>();
        for (int k = 0; k < 9; ++k)
            if (!std::isfinite(m[k])) throw ArgumentError("rotation: expected finite numbers");
        Image image{};
        copy_pixels(pixels, &image, &image.floats);
        if (image.channels != 3) throw ArgumentError("pixels: expected 3 channels");
        Environment environment;
        environment.pixels = std::move(image.floats);
        environment.width = image.width;
        environment.height = image.height;
        environment.axis_x = to_float(Vec3d{m[0], m[1], m[2]});
        environment.axis_y = to_float(Vec3d{m[3], m[4], m[5]});
        environment.axis_z = to_float(Vec3d{m[6], m[7], m[8]});
        environment.seen_by_camera = seen_by_camera != 0;
        set_environment(scene.tables, std::move(environment));
        return none();
    });
}

PyObject* set_camera_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        CameraRequest request{};
        PyObject *matrix, *window;
        request.clip_start = 1e-6;
        request.clip_end = 1e30;
        request.focus = request.squeeze = 1.0;
        const char* const names[] = {"kind",       "matrix",   "window", "clip_start",
                                     "clip_end",   "aperture", "focus",  "blades",
                                     "blade_turn", "squeeze",  nullptr};
        parse_arguments(args, kwargs, "iOO|ddddidd", names, &request.kind, &matrix, &window,
                        &request.clip_start, &request.clip_end, &request.aperture, &request.focus,
                        &request.blades, &request.blade_turn, &request.squeeze);
        const Buffer rows = Buffer::of<double>(matrix, "matrix", {3, 4});
        const Buffer sides = Buffer::of<double>(window, "window", {4});
        request.matrix = rows.data<double>();
        request.window = sides.data<double>();
        set_camera(scene_to_change(self).tables, request);
        return none();
    });
}

PyObject* set_camera_motion_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        PyObject* matrices;
        const char* const names[] = {"matrices", nullptr};
        parse_arguments(args, kwargs, "O", names, &matrices);
        const Buffer rows = Buffer::of<double>(matrices, "matrices", {kAnyExtent, 3, 4});
        set_camera_motion(scene_to_change(self).tables, rows.data<double>(), rows.extent(0));
        return none();
    });
}

PyObject* set_filter_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        PyObject* name;
        double width = 1.0;
        const char* const names[] = {"name", "width", nullptr};
        parse_arguments(args, kwargs, "O|d", names, &name, &width);
        Py_ssize_t size;
        const char* text = PyUnicode_AsUTF8AndSize(name, &size);
        if (!text) throw PythonError{};
        set_filter(scene_to_change(self).tables, std::string(text, size), width);
        return none();
    });
}

FilmPasses parse_passes(PyObject* names) {
    FilmPasses passes;
    if (!names || names == Py_None) return passes;
    const PyRef sequence = checked(PySequence_Tuple(names));
    for (Py_ssize_t k = 0; k < PyTuple_Size(sequence.get()); ++k) {
        Py_ssize_t size;
        const char* text = PyUnicode_AsUTF8AndSize(PyTuple_GetItem(sequence.get(), k), &size);
        if (!text) throw PythonError{};
        const std::string name(text, size);
        if (name == "depth")
            passes.depth = true;
        else if (name == "normal")
            passes.normal = true;
        else if (name == "alpha")
            passes.alpha = true;
        else if (const PassKind kind = find_pass(name); kind != kPassKinds)
            passes.more.asked |= 1u << kind;
        else
            throw ArgumentError("passes: there is no " + name);
    }
    return passes;
}

PixelRect checked_rect(const PixelRect& rect, int width, int height) {
    if (rect.x_min < 0 || rect.y_min < 0 || rect.x_max > width || rect.y_max > height ||
        rect.x_min >= rect.x_max || rect.y_min >= rect.y_max)
        throw ArgumentError("border: empty or outside the picture");
    const int64_t pixels = int64_t{rect.x_max - rect.x_min} * (rect.y_max - rect.y_min);
    if (pixels > kMostPixels)
        throw ArgumentError("width, height: more than " + std::to_string(kMostPixels) +
                            " pixels at once");
    return rect;
}

PyObject* set_pass_data_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        PyObject *instances, *materials;
        PassTables passes;
        const char* const names[] = {"instance_ids", "material_ids",     "matte_levels",
                                     "mist",         "ambient_distance", nullptr};
        parse_arguments(args, kwargs, "OOi(fff)f", names, &instances, &materials,
                        &passes.matte_levels, &passes.mist_start, &passes.mist_depth,
                        &passes.mist_falloff, &passes.ambient_distance);
        const Buffer rows = Buffer::of<float>(instances, "instance_ids", {kAnyExtent, 3});
        const Buffer more = Buffer::of<float>(materials, "material_ids", {kAnyExtent, 2});
        Scene& scene = scene_to_change(self);
        rows.expect_rows("instance_ids", static_cast<int64_t>(scene.world.instances.size()));
        more.expect_rows("material_ids", static_cast<int64_t>(scene.tables.materials.size()));
        if (passes.matte_levels < 1 || passes.matte_levels > 64)
            throw ArgumentError("matte_levels: expected 1 to 64");
        if (!(passes.mist_depth > 0.0f) || !std::isfinite(passes.mist_start) ||
            !(passes.mist_falloff > 0.0f))
            throw ArgumentError("mist: expected start, and depth and falloff above 0");
        if (!(passes.ambient_distance > 0.0f))
            throw ArgumentError("ambient_distance: expected more than 0");
        passes.instance_ids.assign(rows.data<float>(), rows.data<float>() + rows.count());
        passes.material_ids.assign(more.data<float>(), more.data<float>() + more.count());
        scene.passes = std::move(passes);
        return none();
    });
}

PixelRect parse_border(PyObject* border, int width, int height) {
    PixelRect rect{0, 0, width, height};
    if (!border || border == Py_None) return checked_rect(rect, width, height);
    const PyRef sides = checked(PySequence_Tuple(border));
    if (!PyArg_ParseTuple(sides.get(), "iiii;border: expected (x_min, y_min, x_max, y_max)",
                          &rect.x_min, &rect.y_min, &rect.x_max, &rect.y_max))
        throw PythonError{};
    return checked_rect(rect, width, height);
}

void check_request(const RenderRequest& request) {
    if (request.width < 1 || request.height < 1 || request.width > kLargestSide ||
        request.height > kLargestSide)
        throw ArgumentError("width, height: expected 1 to " + std::to_string(kLargestSide));
    if (request.samples < 1 || request.samples > 1 << 30)
        throw ArgumentError("samples: expected 1 to 2^30");
    if (request.max_bounces < 0 || request.max_bounces > 1 << 20)
        throw ArgumentError("max_bounces: expected 0 to 2^20");
    if (!(request.seconds >= 0.0 && request.seconds <= 1e9))
        throw ArgumentError("seconds: expected 0 (no limit) to 1e9");
    if (!(request.rmse >= 0.0 && request.rmse <= 1e30))
        throw ArgumentError("rmse: expected 0 (no such stop) or more");
    check_threads(request.threads);
}

/// Rules of None: nothing is cut short that max_bounces does not.
void parse_rules(PyObject* rules, RenderRequest* request) {
    constexpr int kEndless = 1 << 20;
    PathRules& r = request->rules;
    r = {{kEndless, kEndless, kEndless}, kEndless, 0.0f, 0.0f, true, true};
    if (!rules || rules == Py_None) return;
    const PyRef items = checked(PySequence_Tuple(rules));
    int reflective = 1, refractive = 1;
    if (!PyArg_ParseTuple(items.get(),
                          "iiiiffpp;rules: expected (diffuse, glossy, transmission, transparent, "
                          "clamp_direct, clamp_indirect, reflective, refractive)",
                          &r.bounces[0], &r.bounces[1], &r.bounces[2], &r.sheets, &r.clamp_direct,
                          &r.clamp_indirect, &reflective, &refractive))
        throw PythonError{};
    for (int bounces : {r.bounces[0], r.bounces[1], r.bounces[2], r.sheets})
        if (bounces < 0 || bounces > kEndless)
            throw ArgumentError("rules: expected 0 to 2^20 bounces");
    if (!(r.clamp_direct >= 0.0f) || !(r.clamp_indirect >= 0.0f))
        throw ArgumentError("rules: expected clamps of 0 (none) or more");
    r.clamp_direct *= 3.0f;
    r.clamp_indirect *= 3.0f;
    r.reflective = reflective != 0;
    r.refractive = refractive != 0;
    request->ruled = true;
}

PyObject* start_render_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        RenderRequest request{};
        long long samples;
        unsigned long long seed = 0;
        PyObject *passes = nullptr, *border = nullptr, *rules = nullptr;
        int adaptive = 0;
        request.max_bounces = 12;
        const char* const names[] = {"width",    "height", "samples", "seed",    "max_bounces",
                                     "threads",  "passes", "border",  "seconds", "rmse",
                                     "adaptive", "rules",  nullptr};
        parse_arguments(args, kwargs, "iiL|KiiOOddpO", names, &request.width, &request.height,
                        &samples, &seed, &request.max_bounces, &request.threads, &passes, &border,
                        &request.seconds, &request.rmse, &adaptive, &rules);
        parse_rules(rules, &request);
        request.adaptive = adaptive != 0;
        request.samples = samples;
        request.seed = static_cast<uint32_t>(seed ^ (seed >> 32));
        check_request(request);
        request.passes = parse_passes(passes);
        request.passes.more.matte_levels =
            reinterpret_cast<SceneObject*>(self)->scene->passes.matte_levels;
        request.rect = parse_border(border, request.width, request.height);
        return start_job(self, request);
    });
}

}  // namespace

PyMethodDef kSceneRenderMethods[] = {
    {"set_materials", set_table_method<set_materials>, METH_O,
     "set_materials(table): float32 (n, len(MATERIAL_FIELDS)); textures must be there"},
    {"set_lights", set_table_method<set_lights>, METH_O,
     "set_lights(table): float32 (n, len(LIGHT_FIELDS))"},
    {"set_world", as_method(set_world_method), METH_VARARGS | METH_KEYWORDS,
     "set_world(r, g, b): radiance of the constant world"},
    {"set_environment", as_method(set_environment_method), METH_VARARGS | METH_KEYWORDS,
     "set_environment(pixels, rotation, seen_by_camera=True): an equirectangular world\n\n"
     "pixels: float32 (h, w, 3) radiance, row 0 looks down; rotation float64 (3, 3), world to "
     "picture."},
    {"set_camera", as_method(set_camera_method), METH_VARARGS | METH_KEYWORDS,
     "set_camera(kind, matrix, window, clip_start=1e-6, clip_end=1e30, aperture=0, focus=1, "
     "blades=0, blade_turn=0, squeeze=1)\n\n"
     "kind 0 is perspective, 1 orthographic, 2 a panorama; matrix float64 (3, 4); window float64 "
     "(4,)."},
    {"set_camera_motion", as_method(set_camera_motion_method), METH_VARARGS | METH_KEYWORDS,
     "set_camera_motion(matrices)\n\n"
     "The camera that was set goes straight from key to key of (keys, 3, 4) matrices."},
    {"set_filter", as_method(set_filter_method), METH_VARARGS | METH_KEYWORDS,
     "set_filter(name, width=1.0): box, gaussian or blackman_harris of Blender's width in pixels"},
    {"set_pass_data", as_method(set_pass_data_method), METH_VARARGS | METH_KEYWORDS,
     "set_pass_data(instance_ids, material_ids, matte_levels, mist, ambient_distance)\n\n"
     "float32 (instances, 3): index, object and asset matte; float32 (materials, 2): index, matte; "
     "mist (start, depth, falloff); after instances and materials."},
    {"start_render", as_method(start_render_method), METH_VARARGS | METH_KEYWORDS,
     "start_render(width, height, samples, seed=0, max_bounces=12, threads=0, passes=(), "
     "border=None, seconds=0, rmse=0, adaptive=False, rules=None) -> Job\n\n"
     "Ends with its samples, after `seconds` of wall-clock time, or when the estimated error of "
     "the "
     "picture is `rmse`, whichever comes first; 0 is no limit."},
    {nullptr, nullptr, 0, nullptr}};

}  // namespace trg::py

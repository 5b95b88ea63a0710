#include "py/scene_updates.h"

#include <cstring>

#include "py/buffer.h"
#include "py/scene_geometry.h"
#include "py/scene_object.h"

namespace trg::py {

namespace {

Scene& built_scene(PyObject* self) {
    Scene& scene = scene_to_change(self);
    if (!scene.world.index) throw StateError("the scene must be built first: call build");
    return scene;
}

PyObject* stats_dict(const UpdateStats& stats) {
    return Py_BuildValue("{s:d, s:O, s:d}", "seconds", stats.seconds, "rebuilt",
                         stats.rebuilt ? Py_True : Py_False, "growth", stats.growth);
}

/// What `update` gives; when it fails, the scene must be built before it can be queried again.
template <class Update>
UpdateStats all_or_unbuilt(Scene& scene, Update update) {
    try {
        return update();
    } catch (...) {
        scene.world.index.reset();
        throw;
    }
}

PyObject* update_transforms_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        long long first;
        PyObject* transforms;
        int threads = 0;
        const char* const names[] = {"first", "transforms", "threads", nullptr};
        parse_arguments(args, kwargs, "LO|i", names, &first, &transforms, &threads);
        check_threads(threads);
        const Buffer rows = Buffer::of<float>(transforms, "transforms", {kAnyExtent, 3, 4});
        Scene& scene = built_scene(self);
        const auto count = static_cast<long long>(scene.world.instances.size());
        if (first < 0 || first > count || rows.extent(0) > count - first)
            throw ArgumentError("transforms: " + std::to_string(rows.extent(0)) + " rows from " +
                                std::to_string(first) + " on, there are " + std::to_string(count) +
                                " instances");
        std::vector<Transform> places;
        for (int64_t row = 0; row < rows.extent(0); ++row)
            places.push_back(checked_transform(rows.data<float>() + 12 * row, "transforms", row));
        UpdateStats stats;
        {
            const SceneChange change(self);
            const WithoutGil unlocked;
            stats = all_or_unbuilt(scene, [&] {
                return move_instances(scene.world, static_cast<int>(first), places, threads);
            });
        }
        return checked(stats_dict(stats));
    });
}

PyObject* update_vertices_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        long long mesh;
        PyObject *vertices, *normals = nullptr;
        int threads = 0;
        const char* const names[] = {"mesh", "vertices", "normals", "threads", nullptr};
        parse_arguments(args, kwargs, "LO|Oi", names, &mesh, &vertices, &normals, &threads);
        check_threads(threads);
        const Buffer points = Buffer::of<float>(vertices, "vertices", {kAnyExtent, 3});
        const Buffer corners = optional_buffer<float>(normals, "normals", {kAnyExtent, 3, 3});
        Scene& scene = built_scene(self);
        if (mesh < 0 || mesh >= static_cast<long long>(scene.world.meshes.size()))
            throw ArgumentError("mesh: index " + std::to_string(mesh) + " of " +
                                std::to_string(scene.world.meshes.size()) + " meshes");
        const Mesh& old = scene.world.meshes[mesh];
        points.expect_rows("vertices", static_cast<int64_t>(old.vertices.size()));
        if (corners.present()) {
            corners.expect_rows("normals", static_cast<int64_t>(old.triangles.size()));
            scene.attributes[mesh].normals.assign(corners.data<float>(),
                                                  corners.data<float>() + corners.count());
        }
        std::vector<Vec3> moved(old.vertices.size());
        if (!moved.empty())
            std::memcpy(moved.data(), points.data<float>(), points.count() * sizeof(float));
        UpdateStats stats;
        {
            const SceneChange change(self);
            const WithoutGil unlocked;
            stats = all_or_unbuilt(scene, [&] {
                return move_vertices(scene.world, static_cast<int>(mesh), std::move(moved),
                                     threads);
            });
        }
        return checked(stats_dict(stats));
    });
}

}  // namespace

PyMethodDef kSceneUpdateMethods[] = {
    {"update_transforms", as_method(update_transforms_method), METH_VARARGS | METH_KEYWORDS,
     "update_transforms(first, transforms, threads=0) -> dict\n\n"
     "Moves instances `first` and on of a built scene; only the top level is built anew, unless "
     "one of them was merged with others that stand still (`rebuilt`)."},
    {"update_vertices", as_method(update_vertices_method), METH_VARARGS | METH_KEYWORDS,
     "update_vertices(mesh, vertices, normals=None, threads=0) -> dict\n\n"
     "Moves the vertices of a mesh of a built scene. The index is fitted to them, and built anew "
     "(`rebuilt`) when its cost has grown (`growth`) by more than half."},
    {nullptr, nullptr, 0, nullptr}};

}  // namespace trg::py

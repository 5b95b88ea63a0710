#include "py/scene_geometry.h"

#include <cmath>
#include <cstring>
#include <utility>

#include "accel/choose_accel.h"
#include "py/buffer.h"
#include "py/scene_object.h"

namespace trg::py {

namespace {

constexpr int64_t kMostMotionKeys = 1025;

/// Of vertices, triangles, meshes, instances: they are counted by 32 bits.
constexpr int64_t kMostItems = int64_t{1} << 30;

std::vector<float> copy_floats(const Buffer& buffer) {
    if (!buffer.present()) return {};
    const float* data = buffer.data<float>();
    return {data, data + buffer.count()};
}

std::vector<int32_t> copy_ints(const Buffer& buffer) {
    if (!buffer.present()) return {};
    const int32_t* data = buffer.data<int32_t>();
    return {data, data + buffer.count()};
}

std::string row_text(const char* name, int64_t row) {
    return std::string(name) + ": row " + std::to_string(row) + " ";
}

Mesh copy_mesh(const Buffer& vertices, const Buffer& triangles) {
    if (vertices.extent(0) > kMostItems) throw ArgumentError("vertices: more than 2^30 rows");
    if (triangles.extent(0) > kMostItems) throw ArgumentError("triangles: more than 2^30 rows");
    Mesh mesh;
    mesh.vertices.resize(vertices.extent(0));
    if (!mesh.vertices.empty())
        std::memcpy(mesh.vertices.data(), vertices.data<float>(), vertices.count() * sizeof(float));
    mesh.triangles.resize(triangles.extent(0));
    const int32_t* source = triangles.data<int32_t>();
    for (size_t row = 0; row < mesh.triangles.size(); ++row) {
        for (int corner = 0; corner < 3; ++corner) {
            const int32_t vertex = source[3 * row + corner];
            if (vertex < 0 || vertex >= vertices.extent(0))
                throw ArgumentError(row_text("triangles", row) + "has vertex index " +
                                    std::to_string(vertex) + ", vertices has " +
                                    std::to_string(vertices.extent(0)) + " rows");
            mesh.triangles[row].vertex[corner] = vertex;
        }
    }
    return mesh;
}

void check_slots(const std::vector<int32_t>& slots) {
    for (size_t row = 0; row < slots.size(); ++row)
        if (slots[row] < 0)
            throw ArgumentError(row_text("slots", row) + "is " + std::to_string(slots[row]) +
                                ", expected 0 or more");
}

/// Adds `mesh` with what belongs to it: both or, when memory ends, neither.
PyRef keep_mesh(PyObject* self, Mesh mesh, MeshAttributes attributes) {
    Scene& scene = scene_to_change(self);
    if (static_cast<int64_t>(scene.world.meshes.size()) >= kMostItems)
        throw ArgumentError("vertices: the scene has 2^30 meshes");
    scene.attributes.push_back(std::move(attributes));
    try {
        return checked(PyLong_FromLong(add_mesh(scene.world, std::move(mesh))));
    } catch (...) {
        scene.attributes.resize(scene.world.meshes.size());
        throw;
    }
}

template <Shape kShape>
PyObject* add_shape_method(PyObject* self, PyObject*) {
    return guarded_object([&] {
        Mesh mesh;
        mesh.shape = kShape;
        return keep_mesh(self, std::move(mesh), {});
    });
}

PyObject* add_mesh_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        PyObject *vertices, *triangles, *normals = nullptr, *uvs = nullptr, *slots = nullptr;
        const char* const names[] = {"vertices", "triangles", "normals", "uvs", "slots", nullptr};
        parse_arguments(args, kwargs, "OO|OOO", names, &vertices, &triangles, &normals, &uvs,
                        &slots);
        scene_to_change(self);  // refuses before anything is copied
        const Buffer points = Buffer::of<float>(vertices, "vertices", {kAnyExtent, 3});
        const Buffer indices = Buffer::of<int32_t>(triangles, "triangles", {kAnyExtent, 3});
        const int64_t count = indices.extent(0);
        Mesh mesh = copy_mesh(points, indices);
        MeshAttributes attributes;
        attributes.normals = copy_floats(optional_buffer<float>(normals, "normals", {count, 3, 3}));
        attributes.uvs = copy_floats(optional_buffer<float>(uvs, "uvs", {count, 3, 2}));
        attributes.slots = copy_ints(optional_buffer<int32_t>(slots, "slots", {count}));
        check_slots(attributes.slots);
        return keep_mesh(self, std::move(mesh), std::move(attributes));
    });
}

PyObject* take_mesh_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        PyObject* source;
        long long mesh;
        const char* const names[] = {"source", "mesh", nullptr};
        parse_arguments(args, kwargs, "OL", names, &source, &mesh);
        if (Py_TYPE(source) != Py_TYPE(self) || source == self)
            throw ArgumentError("source: expected another scene");
        Scene& scene = scene_to_change(self);
        Scene& from = scene_to_change(source);
        if (mesh < 0 || mesh >= static_cast<long long>(from.world.meshes.size()))
            throw ArgumentError("mesh: index " + std::to_string(mesh) + " of " +
                                std::to_string(from.world.meshes.size()) + " meshes");
        scene.attributes.push_back({});
        const int number = take_mesh(scene.world, from.world, static_cast<int>(mesh));
        scene.attributes[number] = std::exchange(from.attributes[mesh], {});
        return checked(PyLong_FromLong(number));
    });
}

/// Instances of one mesh that share `slot_materials`, to be added all or none.
struct InstanceRequest {
    long mesh;
    std::vector<Transform> transforms;
    std::vector<int32_t> slot_materials;
};

long add_request(Scene& scene, const InstanceRequest& request) {
    const long mesh_count = static_cast<long>(scene.world.meshes.size());
    if (request.mesh < 0 || request.mesh >= mesh_count)
        throw ArgumentError("mesh: index " + std::to_string(request.mesh) + " of " +
                            std::to_string(mesh_count) + " meshes");
    const long first = static_cast<long>(scene.world.instances.size());
    const auto count = static_cast<int64_t>(request.transforms.size());
    const auto slots = static_cast<int64_t>(request.slot_materials.size());
    if (count > kMostItems - first || slots > kMostItems)
        throw ArgumentError("transforms: more than 2^30 instances or slots");
    const int64_t first_slot = static_cast<int64_t>(scene.slot_materials.size());
    try {
        scene.slot_materials.insert(scene.slot_materials.end(), request.slot_materials.begin(),
                                    request.slot_materials.end());
        scene.first_slot.resize(first + count, first_slot);
        scene.slot_count.resize(first + count, static_cast<int32_t>(slots));
        if (count > 1) scene.world.instances.reserve(first + count);
        for (const Transform& transform : request.transforms)
            add_instance(scene.world, static_cast<int>(request.mesh), transform);
    } catch (...) {
        // All or none, also when memory ends.
        scene.slot_materials.resize(first_slot);
        scene.first_slot.resize(first);
        scene.slot_count.resize(first);
        scene.world.instances.resize(first);
        throw;
    }
    return first;
}

PyObject* add_instance_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        InstanceRequest request{};
        PyObject *transform = nullptr, *slot_materials = nullptr;
        const char* const names[] = {"mesh", "transform", "slot_materials", nullptr};
        parse_arguments(args, kwargs, "l|OO", names, &request.mesh, &transform, &slot_materials);
        const Buffer rows = optional_buffer<float>(transform, "transform", {3, 4});
        request.transforms.push_back(rows.present()
                                         ? checked_transform(rows.data<float>(), "transform", 0)
                                         : identity_transform());
        request.slot_materials =
            copy_ints(optional_buffer<int32_t>(slot_materials, "slot_materials", {kAnyExtent}));
        return checked(PyLong_FromLong(add_request(scene_to_change(self), request)));
    });
}

PyObject* add_instances_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        InstanceRequest request{};
        PyObject *transforms = nullptr, *slot_materials = nullptr;
        const char* const names[] = {"mesh", "transforms", "slot_materials", nullptr};
        parse_arguments(args, kwargs, "lO|O", names, &request.mesh, &transforms, &slot_materials);
        const Buffer rows = Buffer::of<float>(transforms, "transforms", {kAnyExtent, 3, 4});
        request.transforms.reserve(rows.extent(0));
        for (int64_t row = 0; row < rows.extent(0); ++row)
            request.transforms.push_back(
                checked_transform(rows.data<float>() + 12 * row, "transforms", row));
        request.slot_materials =
            copy_ints(optional_buffer<int32_t>(slot_materials, "slot_materials", {kAnyExtent}));
        return checked(PyLong_FromLong(add_request(scene_to_change(self), request)));
    });
}

PyObject* set_motion_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        long long first;
        PyObject* transforms;
        const char* const names[] = {"first", "transforms", nullptr};
        parse_arguments(args, kwargs, "LO", names, &first, &transforms);
        const Buffer rows =
            Buffer::of<float>(transforms, "transforms", {kAnyExtent, kAnyExtent, 3, 4});
        const int64_t count = rows.extent(0), keys = rows.extent(1);
        if (keys < 2 || keys > kMostMotionKeys)
            throw ArgumentError("transforms: expected 2 to " + std::to_string(kMostMotionKeys) +
                                " keys, got " + std::to_string(keys));
        std::vector<Transform> all;
        for (int64_t row = 0; row < count * keys; ++row)
            all.push_back(checked_transform(rows.data<float>() + 12 * row, "transforms", row));
        Scene& scene = scene_to_change(self);
        const auto instances = static_cast<int64_t>(scene.world.instances.size());
        if (first < 0 || first > instances || count > instances - first)
            throw ArgumentError("transforms: more than there are instances");
        for (int64_t k = 0; k < count; ++k)
            set_motion(scene.world, static_cast<int>(first + k),
                       {all.begin() + k * keys, all.begin() + (k + 1) * keys});
        return none();
    });
}

PyObject* set_visibility_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        PyObject *masks, *held_out;
        int sky_covers = 0;
        const char* const names[] = {"masks", "held_out", "sky_covers", nullptr};
        parse_arguments(args, kwargs, "OO|p", names, &masks, &held_out, &sky_covers);
        const Buffer bits = Buffer::of<uint8_t>(masks, "masks", {kAnyExtent});
        const Buffer held = Buffer::of<uint8_t>(held_out, "held_out", {kAnyExtent});
        Scene& scene = scene_to_change(self);
        const auto instances = static_cast<int64_t>(scene.world.instances.size());
        bits.expect_rows("masks", instances);
        held.expect_rows("held_out", instances);
        for (int64_t k = 0; k < instances; ++k)
            set_mask(scene.world, static_cast<int>(k), bits.data<uint8_t>()[k]);
        scene.sky_covers = sky_covers != 0;
        scene.held_out.assign(held.data<uint8_t>(), held.data<uint8_t>() + instances);
        return none();
    });
}

PyObject* build_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        int threads = 0;
        double rays = 0;
        int merge = 1;
        const char* const names[] = {"threads", "rays", "merge", nullptr};
        parse_arguments(args, kwargs, "|idp", names, &threads, &rays, &merge);
        check_threads(threads);
        if (!(rays >= 0)) throw ArgumentError("rays: expected a number from 0 on");
        Scene& scene = scene_to_change(self);
        BuildStats stats;
        {
            const SceneChange change(self);
            const WithoutGil unlocked;
            scene.world.merge = merge != 0;
            stats = build_world(scene.world, threads, rays);
        }
        return checked(Py_BuildValue(
            "{s:d, s:L, s:L, s:L, s:L, s:L, s:L, s:L, s:s, s:s}", "seconds", stats.seconds, "bytes",
            static_cast<long long>(stats.bytes), "nodes", static_cast<long long>(stats.nodes),
            "triangles", static_cast<long long>(stats.triangles), "instances",
            static_cast<long long>(stats.instances), "degenerate_triangles",
            static_cast<long long>(stats.degenerate_triangles), "built_trees",
            static_cast<long long>(stats.built_trees), "kept_trees",
            static_cast<long long>(stats.kept_trees), "accel", accel_name(stats.accel), "reason",
            stats.reason.c_str()));
    });
}

}  // namespace

Transform checked_transform(const float* source, const char* name, int64_t row) {
    Transform transform;
    std::memcpy(transform.m, source, sizeof transform.m);
    for (int k = 0; k < 12; ++k)
        if (!std::isfinite(source[k])) throw ArgumentError(row_text(name, row) + "is not finite");
    const Transform back = inverse(transform);
    bool invertible = determinant(transform) != 0;
    for (int k = 0; k < 12; ++k) invertible = invertible && std::isfinite(back.m[k / 4][k % 4]);
    if (!invertible) throw ArgumentError(row_text(name, row) + "is singular");
    return transform;
}

PyMethodDef kSceneGeometryMethods[] = {
    {"add_mesh", as_method(add_mesh_method), METH_VARARGS | METH_KEYWORDS,
     "add_mesh(vertices, triangles, normals=None, uvs=None, slots=None) -> mesh index"},
    {"take_mesh", as_method(take_mesh_method), METH_VARARGS | METH_KEYWORDS,
     "take_mesh(source, mesh) -> mesh index\n\n"
     "Moves a mesh with all that belongs to it and its index out of another scene, which has an "
     "empty one there from then on and must be built anew."},
    {"add_sphere", add_shape_method<Shape::sphere>, METH_NOARGS,
     "add_sphere() -> mesh index\n\nThe unit sphere round the origin."},
    {"add_plane", add_shape_method<Shape::plane>, METH_NOARGS,
     "add_plane() -> mesh index\n\nThe infinite plane z = 0."},
    {"add_instance", as_method(add_instance_method), METH_VARARGS | METH_KEYWORDS,
     "add_instance(mesh, transform=None, slot_materials=None) -> instance index"},
    {"set_motion", as_method(set_motion_method), METH_VARARGS | METH_KEYWORDS,
     "set_motion(first, transforms)\n\n"
     "Instances `first` and on go straight from key to key of their row of transforms "
     "(instances, keys, 3, 4) while the shutter is open."},
    {"set_visibility", as_method(set_visibility_method), METH_VARARGS | METH_KEYWORDS,
     "set_visibility(masks, held_out, sky_covers=False)\n\n"
     "uint8 (instances,): which rays meet an instance (1 camera, 2 diffuse, 4 glossy, 8 "
     "transmission, 16 shadow, 255 all), and whether the camera sees a hole there. sky_covers: "
     "alpha counts rays that leave the scene as hits."},
    {"add_instances", as_method(add_instances_method), METH_VARARGS | METH_KEYWORDS,
     "add_instances(mesh, transforms, slot_materials=None) -> index of the first"},
    {"build", as_method(build_method), METH_VARARGS | METH_KEYWORDS,
     "build(threads=0, rays=0, merge=True) -> dict of statistics\n\n"
     "rays: about how many will be traced (0: unknown); accel='auto' chooses for them; merge: one "
     "index for all meshes used once that stand where they are"},
    {nullptr, nullptr, 0, nullptr}};

}  // namespace trg::py

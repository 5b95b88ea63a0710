/// The point that a ray met: position with its error, normals, texture coordinates, material.
#pragma once

#include "kernel/scene_view.h"

namespace trg {

struct Surface {
    Vec3 position;
    Vec3 outside;    // unit geometric normal on the outer side
    float error;     // how far along the normal the true surface may be
    float u, v;      // texture coordinates
    float sampling;  // chance of sampling this point for its light, against an even choice by area
    int32_t material;
    EmissiveTriangle at;  // where this is
    float b1, b2;         // barycentrics there
    float time;           // 0 to 1 while the shutter is open
};

/// A ray and when it travels.
struct TimedRay {
    Ray ray;
    float time;
    uint8_t mask = kEveryRay;
};

/// Instance `number` as it stands at `time`; `*moved` is room for one that moves.
TRG_FN const Instance& instance_at(const SceneView& scene, int32_t number, float time,
                                   Instance* moved) {
    const Instance& still = scene.instances[number];
    if (still.key_count == 0) return still;
    *moved = still;
    moved->object_to_world =
        transform_at(scene.motion_keys + still.first_key, still.key_count, time);
    moved->world_to_object = inverse(moved->object_to_world);
    moved->mirrored = determinant(moved->object_to_world) < 0;
    return *moved;
}

struct Corners {
    Vec3 p0, e1, e2;
};

TRG_FN Corners triangle_corners(const MeshView& mesh, int32_t triangle) {
    const Triangle& t = mesh.triangles[triangle];
    const Vec3 p0 = mesh.vertices[t.vertex[0]];
    return {p0, mesh.vertices[t.vertex[1]] - p0, mesh.vertices[t.vertex[2]] - p0};
}

/// Bound, along the normal `n`, on the distance between a point computed from barycentrics and its
/// triangle as rays see it: rounding of the point, of the map to the world, and of rays taken into
/// the object's space (after Waechter and Binder 2019 and NVIDIA's self-intersection bounds).
TRG_FN float offset_bound(const Instance& instance, const Corners& c, Vec3 position, Vec3 n) {
    constexpr float kEps = 2.4e-7f;  // four half-ulps
    const Vec3 size = absolute(c.p0) + absolute(c.e1) + absolute(c.e2);
    Vec3 error = absolute(position) + size;
    if (!instance.identity) {
        const Transform& m = instance.object_to_world;
        const Vec3 shift{std::fabs(m.m[0][3]), std::fabs(m.m[1][3]), std::fabs(m.m[2][3])};
        Vec3 spread;
        float* rows[3] = {&spread.x, &spread.y, &spread.z};
        for (int k = 0; k < 3; ++k)
            *rows[k] = std::fabs(m.m[k][0]) * size.x + std::fabs(m.m[k][1]) * size.y +
                       std::fabs(m.m[k][2]) * size.z;
        error = absolute(position) + (spread + shift) * 2.0f;
    }
    return kEps * dot(error, absolute(n)) + 1e-37f;
}

TRG_FN int32_t material_of(const SceneView& scene, const EmissiveTriangle& at) {
    const int32_t count = scene.slot_count[at.instance];
    if (count == 0) return 0;
    const int32_t* slots = scene.meshes[scene.instances[at.instance].mesh].slots;
    const int32_t slot = slots ? slots[at.triangle] : 0;
    return scene.slot_materials[scene.first_slot[at.instance] + (slot < count ? slot : count - 1)];
}

/// Asks memory for the triangle of a hit that will be shaded soon.
template <uint32_t F>
TRG_FN void prefetch_surface(const SceneView& scene, const Hit& hit) {
#if defined(__GNUC__)
    if (hit.triangle < 0) return;
    const MeshView& mesh = scene.meshes[scene.instances[hit.instance].mesh];
    if (mesh.shape != Shape::triangles) return;
    __builtin_prefetch(&mesh.triangles[hit.triangle]);
    if (has(F, kSmoothNormals) && mesh.normals)
        __builtin_prefetch(mesh.normals + static_cast<int64_t>(hit.triangle) * 9);
    if (has(F, kTextures) && mesh.uvs)
        __builtin_prefetch(mesh.uvs + static_cast<int64_t>(hit.triangle) * 6);
#endif
}

/// The same for the corners, once the triangle is there.
TRG_FN void prefetch_corners(const SceneView& scene, const Hit& hit) {
#if defined(__GNUC__)
    if (hit.triangle < 0) return;
    const MeshView& mesh = scene.meshes[scene.instances[hit.instance].mesh];
    if (mesh.shape != Shape::triangles) return;
    const Triangle& t = mesh.triangles[hit.triangle];
    for (int32_t corner : t.vertex) __builtin_prefetch(&mesh.vertices[corner]);
#endif
}

/// How much larger than at their own time triangles are by which emitters were chosen: those of the
/// middle of the shutter. `e1`, `e2` are edges of a moving one at its time.
TRG_FN float area_growth(const SceneView& scene, const EmissiveTriangle& at, Vec3 e1, Vec3 e2) {
    const Instance& instance = scene.instances[at.instance];
    const Corners c = triangle_corners(scene.meshes[instance.mesh], at.triangle);
    const Transform& m = instance.object_to_world;
    return length(cross(transform_vector(m, c.e1), transform_vector(m, c.e2))) /
           length(cross(e1, e2));
}

/// Where on a triangle, and when.
struct TrianglePlace {
    float b1, b2;  // barycentrics
    float time;
};

/// The point at `place`. The normal is null where the triangle has no usable one.
template <uint32_t F>
TRG_FN Surface make_surface(const SceneView& scene, const EmissiveTriangle& at,
                            const TrianglePlace& place) {
    const float b1 = place.b1, b2 = place.b2;
    Instance moved;
    const Instance& instance = instance_at(scene, at.instance, place.time, &moved);
    const MeshView& mesh = scene.meshes[instance.mesh];
    const Corners c = triangle_corners(mesh, at.triangle);
    Surface s;
    // The base vertex comes last: it may be far larger than the edges.
    s.position = c.p0 + (c.e1 * b1 + c.e2 * b2);
    Vec3 e1 = c.e1, e2 = c.e2;
    if (!instance.identity) {
        s.position = transform_point(instance.object_to_world, s.position);
        e1 = transform_vector(instance.object_to_world, e1);
        e2 = transform_vector(instance.object_to_world, e2);
    }
    const float size = larger(max_component(absolute(e1)), max_component(absolute(e2)));
    const float scale = (instance.mirrored ? -1.0f : 1.0f) / size;
    s.outside = normalize_safe(cross(e1 * scale, e2 * (1.0f / size)));
    s.error = offset_bound(instance, c, s.position, s.outside);
    s.material = material_of(scene, at);
    s.at = at;
    s.b1 = b1;
    s.b2 = b2;
    s.time = place.time;
    s.sampling = 1.0f;
    if constexpr (has(F, kExtendedEmitters))
        if (instance.key_count > 0) s.sampling = area_growth(scene, at, e1, e2);
    s.u = s.v = 0.0f;
    if (has(F, kTextures) && mesh.uvs) {
        const float* uv = mesh.uvs + static_cast<int64_t>(at.triangle) * 6;
        const float b0 = 1.0f - b1 - b2;
        s.u = b0 * uv[0] + b1 * uv[2] + b2 * uv[4];
        s.v = b0 * uv[1] + b1 * uv[3] + b2 * uv[5];
    }
    return s;
}

/// The interpolated corner normal in world space, on the side of `outside`'s winding; null where
/// the mesh has none or where it is no direction.
TRG_FN Vec3 smooth_normal(const SceneView& scene, const Surface& s) {
    Instance moved;
    const Instance& instance = instance_at(scene, s.at.instance, s.time, &moved);
    const float* corner = scene.meshes[instance.mesh].normals;
    if (!corner) return {0.0f, 0.0f, 0.0f};
    corner += static_cast<int64_t>(s.at.triangle) * 9;
    const Vec3 n0{corner[0], corner[1], corner[2]}, n1{corner[3], corner[4], corner[5]},
        n2{corner[6], corner[7], corner[8]};
    Vec3 n = n0 * (1.0f - s.b1 - s.b2) + n1 * s.b1 + n2 * s.b2;
    if (!instance.identity) n = transform_transposed(instance.world_to_object, n);
    return normalize_safe(n);
}

/// `position` moved off the surface to the side of `n` by its error.
TRG_FN Vec3 leave_surface(const Surface& s, Vec3 n) {
    return s.position + n * s.error;
}

}  // namespace trg

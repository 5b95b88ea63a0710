/// The point of a sphere or plane that a ray met, or that is sampled for its light.
#pragma once

#include "geom/shapes.h"
#include "kernel/surface.h"

namespace trg {

struct ShapePoint {
    Vec3d local;  // on the shape, in its own space
    float u, v;   // coordinates on it
    float time;
};

TRG_FN Vec3d shape_normal(Shape shape, Vec3d local) {
    return shape == Shape::plane ? Vec3d{0, 0, 1} : local;
}

TRG_FN Vec3d point_out_of(const Transform& a, Vec3d p) {
    const auto& m = a.m;
    return {m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z + m[0][3],
            m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z + m[1][3],
            m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z + m[2][3]};
}

/// A normal of the local space in the world, not unit.
TRG_FN Vec3d normal_out_of(const InverseMap& map, Vec3d n) {
    const auto& m = map.m;
    return {m[0][0] * n.x + m[1][0] * n.y + m[2][0] * n.z,
            m[0][1] * n.x + m[1][1] * n.y + m[2][1] * n.z,
            m[0][2] * n.x + m[1][2] * n.y + m[2][2] * n.z};
}

/// How far along the normal `n` a ray can take the surface to be from `position`: rounding of the
/// position to float, and of the ray's way into the shape's space in double.
TRG_FN float shape_offset(const Instance& instance, Vec3 position, Vec3 n) {
    constexpr float kEps = 2.4e-7f, kEpsDouble = 4e-15f;
    const auto& m = instance.object_to_world.m;
    float size = 0.0f;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) size += std::fabs(m[row][column]);
    return kEps * dot(absolute(position), absolute(n)) +
           kEpsDouble * (size + max_component(absolute(position))) + 1e-37f;
}

template <uint32_t F>
TRG_FN Surface make_shape_surface(const SceneView& scene, int32_t number, const ShapePoint& at) {
    Instance moved;
    const Instance& instance = instance_at(scene, number, at.time, &moved);
    const Shape shape = scene.meshes[instance.mesh].shape;
    const Vec3d n =
        normal_out_of(inverse_map(instance.object_to_world), shape_normal(shape, at.local));
    Surface s;
    s.position = to_float(point_out_of(instance.object_to_world, at.local));
    s.outside = to_float(n * (1.0 / std::sqrt(dot(n, n))));
    s.error = shape_offset(instance, s.position, s.outside);
    s.at = {number, 0};
    s.b1 = s.b2 = 0.0f;
    s.time = at.time;
    s.material = material_of(scene, s.at);
    s.u = has(F, kTextures) ? at.u : 0.0f;
    s.v = has(F, kTextures) ? at.v : 0.0f;
    s.sampling = shape == Shape::plane ? 0.0f : 1.0f;
    if constexpr (has(F, kExtendedEmitters))
        if (shape == Shape::sphere && scene.materials[s.material].emission_weight > 0.0f)
            s.sampling = sphere_density(instance.object_to_world, n);
    return s;
}

/// Where `ray` met the shape, put exactly onto it.
TRG_FN ShapePoint met_point(const SceneView& scene, const TimedRay& timed, const Hit& hit) {
    const Ray& ray = timed.ray;
    Instance moved;
    const Instance& instance = instance_at(scene, hit.instance, timed.time, &moved);
    const InverseMap map = inverse_map(instance.object_to_world);
    const Vec3d o = point_into(map, to_double(ray.origin));
    const Vec3d d = vector_into(map, to_double(ray.direction));
    Vec3d p = o + d * hit.t;
    if (scene.meshes[instance.mesh].shape == Shape::plane)
        p.z = 0.0;
    else
        p = p * (1.0 / std::sqrt(dot(p, p)));
    return {p, hit.u, hit.v, timed.time};
}

/// The point that `hit` names, of whatever shape.
template <uint32_t F>
TRG_FN Surface surface_of_hit(const SceneView& scene, const TimedRay& ray, const Hit& hit) {
    if (scene.meshes[scene.instances[hit.instance].mesh].shape != Shape::triangles)
        return make_shape_surface<F>(scene, hit.instance, met_point(scene, ray, hit));
    return make_surface<F>(scene, {hit.instance, hit.triangle}, {hit.u, hit.v, ray.time});
}

/// An even point of an emissive triangle or unit sphere at `time`, from two even numbers.
template <uint32_t F>
TRG_FN Surface sample_emitter(const SceneView& scene, const EmissiveTriangle& at, Sample2 even,
                              float time) {
    const float a = even.u, b = even.v;
    if (scene.meshes[scene.instances[at.instance].mesh].shape == Shape::triangles) {
        const float root = std::sqrt(a);
        return make_surface<F>(scene, at, {root * (1.0f - b), root * b, time});
    }
    const Vec3d p = even_sphere_point(a, b);
    const ShapeCoordinates c = sphere_coordinates(p);
    return make_shape_surface<F>(scene, at.instance,
                                 {p, static_cast<float>(c.u), static_cast<float>(c.v), time});
}

}  // namespace trg

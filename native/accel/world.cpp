#include "accel/world.h"

#include <utility>

#include "accel/world_index.h"

namespace trg {

namespace {

bool meets_triangle(const Mesh& mesh, int triangle, const Ray& ray, Hit* hit) {
    const Triangle& t = mesh.triangles[triangle];
    const Vec3d p0 = to_double(mesh.vertices[t.vertex[0]]);
    const Vec3d e1 = to_double(mesh.vertices[t.vertex[1]]) - p0;
    const Vec3d e2 = to_double(mesh.vertices[t.vertex[2]]) - p0;
    const Vec3d d = to_double(ray.direction), s = to_double(ray.origin) - p0;
    const Vec3d p = cross(d, e2), q = cross(s, e1);
    const double det = dot(e1, p);
    const double u = dot(s, p) / det, v = dot(d, q) / det, distance = dot(e2, q) / det;
    if (!(u >= 0 && v >= 0 && u + v <= 1)) return false;
    if (!(distance > ray.t_min && distance < ray.t_max)) return false;
    hit->t = static_cast<float>(distance);
    hit->u = static_cast<float>(u);
    hit->v = static_cast<float>(v);
    hit->triangle = triangle;
    return true;
}

Hit closest_of_all(const World& world, Ray ray) {
    Hit best = no_hit();
    if (!is_traceable(ray)) return best;
    for (size_t k = 0; k < world.instances.size(); ++k) {
        const Instance& instance = world.instances[k];
        const Mesh& mesh = world.meshes[instance.mesh];
        Ray local = ray;
        local.origin = transform_point(instance.world_to_object, ray.origin);
        local.direction = transform_vector(instance.world_to_object, ray.direction);
        for (size_t i = 0; i < mesh.triangles.size(); ++i) {
            if (!meets_triangle(mesh, static_cast<int>(i), local, &best)) continue;
            best.instance = static_cast<int32_t>(k);
            local.t_max = ray.t_max = best.t;
        }
    }
    return best;
}

}  // namespace

int add_mesh(World& world, Mesh mesh) {
    world.meshes.push_back(std::move(mesh));
    return static_cast<int>(world.meshes.size()) - 1;
}

int add_instance(World& world, int mesh, const Transform& object_to_world) {
    const bool identity = is_identity(object_to_world);
    world.instances.push_back({mesh, identity, determinant(object_to_world) < 0, object_to_world,
                               identity ? object_to_world : inverse(object_to_world)});
    return static_cast<int>(world.instances.size()) - 1;
}

BuildStats build_world(World& world, int) {
    world.index = std::make_shared<WorldIndex>();
    return {};
}

void intersect_closest(const World& world, const Ray* rays, Hit* hits, int count) {
    for (int k = 0; k < count; ++k) hits[k] = closest_of_all(world, rays[k]);
}

void intersect_any(const World& world, const Ray* rays, uint8_t* hidden, int count) {
    for (int k = 0; k < count; ++k) hidden[k] = closest_of_all(world, rays[k]).triangle >= 0;
}

}  // namespace trg

#include "accel/world.h"

#include <utility>

#include "accel/world_index.h"

namespace trg {

Instance make_instance(int mesh, const Transform& object_to_world) {
    const bool identity = is_identity(object_to_world);
    return {mesh, identity, determinant(object_to_world) < 0, object_to_world,
            identity ? object_to_world : inverse(object_to_world)};
}

int add_mesh(World& world, Mesh mesh) {
    world.index.reset();
    world.meshes.push_back(std::move(mesh));
    return static_cast<int>(world.meshes.size()) - 1;
}

int add_instance(World& world, int mesh, const Transform& object_to_world) {
    world.index.reset();
    world.instances.push_back(make_instance(mesh, object_to_world));
    return static_cast<int>(world.instances.size()) - 1;
}

void intersect_closest(const World& world, const Ray* rays, Hit* hits, int count) {
    world.index->kernels.closest(*world.index, rays, hits, count);
}

void intersect_any(const World& world, const Ray* rays, uint8_t* hidden, int count) {
    world.index->kernels.any(*world.index, rays, hidden, count);
}

}  // namespace trg

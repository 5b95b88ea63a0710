#include "accel/world.h"

#include <unordered_map>
#include <utility>

#include "accel/world_index.h"

namespace trg {

namespace {

/// The soups of single meshes outlive the index of `world`.
void release_soups(World& world) {
    if (!world.index) return;
    std::unordered_map<const Soup*, std::shared_ptr<Soup>> owners;
    for (const auto& soup : world.index->soups) owners[soup.get()] = soup;
    world.kept.assign(world.meshes.size(), nullptr);
    for (size_t mesh = 0; mesh < world.meshes.size(); ++mesh)
        if (const Soup* soup = world.index->soup_of_mesh[mesh]) world.kept[mesh] = owners[soup];
    world.index.reset();
}

}  // namespace

Instance make_instance(int mesh, const Transform& object_to_world) {
    const bool identity = is_identity(object_to_world);
    return {mesh,
            identity,
            determinant(object_to_world) < 0,
            object_to_world,
            identity ? object_to_world : inverse(object_to_world),
            0,
            0};
}

int add_mesh(World& world, Mesh mesh) {
    world.index.reset();
    world.meshes.push_back(std::move(mesh));
    return static_cast<int>(world.meshes.size()) - 1;
}

int take_mesh(World& to, World& from, int mesh) {
    release_soups(from);
    const int number = add_mesh(to, std::exchange(from.meshes[mesh], Mesh{}));
    if (static_cast<size_t>(mesh) < from.kept.size() && from.triangle_test == to.triangle_test) {
        to.kept.resize(to.meshes.size());
        to.kept[number] = std::move(from.kept[mesh]);
    }
    return number;
}

int add_instance(World& world, int mesh, const Transform& object_to_world) {
    world.index.reset();
    world.instances.push_back(make_instance(mesh, object_to_world));
    return static_cast<int>(world.instances.size()) - 1;
}

void set_motion(World& world, int number, const std::vector<Transform>& keys) {
    world.index.reset();
    const auto count = static_cast<int32_t>(keys.size());
    Instance& instance = world.instances[number];
    const uint8_t mask = instance.mask;
    instance = make_instance(instance.mesh, transform_at(keys.data(), count, kMiddleTime));
    instance.mask = mask;
    instance.identity = false;  // never merged with what stands still
    instance.key_count = count;
    instance.first_key = static_cast<int64_t>(world.motion_keys.size());
    world.motion_keys.insert(world.motion_keys.end(), keys.begin(), keys.end());
}

void set_mask(World& world, int number, uint8_t mask) {
    world.index.reset();
    world.instances[number].mask = mask;
}

void intersect_closest(const World& world, const Ray* rays, Hit* hits, int count,
                       const RayTags& tags) {
    world.index->kernels.closest(*world.index, {rays, tags, count}, hits);
}

Hit intersect_beyond(const World& world, const Ray& ray, RayTag tag, const Hit& met) {
    return world.index->kernels.beyond(*world.index, ray, tag, met);
}

void intersect_any(const World& world, const Ray* rays, uint8_t* hidden, int count,
                   const RayTags& tags) {
    world.index->kernels.any(*world.index, {rays, tags, count}, hidden);
}

}  // namespace trg

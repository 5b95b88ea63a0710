#include <chrono>
#include <utility>

#include "accel/world.h"
#include "accel/world_index.h"

namespace trg {

namespace {

/// A tree that costs more than this times what it cost when it was built is built anew.
constexpr double kMostGrowth = 1.5;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Whether the instance's triangles went into the merged soup.
bool is_merged(const World& world, const Instance& instance) {
    const bool triangles = world.meshes[instance.mesh].shape == Shape::triangles;
    return triangles && !world.index->soup_of_mesh[instance.mesh];
}

std::vector<int32_t> merged_instances(const World& world) {
    std::vector<int32_t> merged;
    for (size_t k = 0; k < world.instances.size(); ++k)
        if (is_merged(world, world.instances[k])) merged.push_back(static_cast<int32_t>(k));
    return merged;
}

}  // namespace

UpdateStats move_instances(World& world, int first, const std::vector<Transform>& places,
                           int threads) {
    const Clock::time_point start = Clock::now();
    UpdateStats stats;
    for (size_t k = 0; k < places.size(); ++k) {
        Instance& instance = world.instances[first + k];
        stats.rebuilt = stats.rebuilt || is_merged(world, instance);
        const uint8_t mask = instance.mask;
        instance = make_instance(instance.mesh, places[k]);
        instance.mask = mask;
    }
    if (stats.rebuilt)
        build_world(world, threads);
    else
        place_soups(world, *world.index, threads);
    stats.seconds = seconds_since(start);
    return stats;
}

UpdateStats move_vertices(World& world, int mesh, std::vector<Vec3> vertices, int threads) {
    const Clock::time_point start = Clock::now();
    UpdateStats stats;
    Mesh& moved = world.meshes[mesh];
    moved.vertices = std::move(vertices);
    WorldIndex& index = *world.index;
    Soup* own = index.soup_of_mesh[mesh];
    Soup* soup = own ? own : index.merged;
    if (soup) {
        const Refit refit = refit_soup(*soup, world, own ? &moved : nullptr, threads);
        stats.growth = refit.growth;
        stats.rebuilt = !refit.possible || refit.growth > kMostGrowth;
        const SoupSettings settings{index.accel, index.triangle_test, threads};
        if (stats.rebuilt)
            *soup = own ? build_mesh_soup(moved, settings)
                        : build_merged_soup(world, merged_instances(world), settings);
        place_soups(world, index, threads);
    }
    stats.seconds = seconds_since(start);
    return stats;
}

}  // namespace trg

#include <chrono>
#include <cmath>

#include "accel/choose_accel.h"
#include "accel/world.h"
#include "accel/world_index.h"
#include "base/isa.h"
#include "base/parallel.h"

namespace trg {

namespace {

Kernels kernels_of([[maybe_unused]] Isa isa) {
#if defined(TRG_HAS_X86_VARIANTS)
    switch (isa) {
        case Isa::avx512:
            return avx512::trace_kernels();
        case Isa::avx2:
            return avx2::trace_kernels();
        default:
            break;
    }
#endif
    return baseline::trace_kernels();
}

Placement place_soup(const World& world, const Soup& soup, int32_t number) {
    const Instance& instance = world.instances[number];
    return {&soup,
            number,
            instance.identity,
            inverse_map(instance.object_to_world),
            world.motion_keys.data() + instance.first_key,
            instance.key_count,
            instance.mask};
}

float rounded_down(double x) {
    const auto nearest = static_cast<float>(x);
    return nearest > x ? std::nextafter(nearest, -HUGE_VALF) : nearest;
}

float rounded_up(double x) {
    const auto nearest = static_cast<float>(x);
    return nearest < x ? std::nextafter(nearest, HUGE_VALF) : nearest;
}

Bounds rounded_outwards(const double low[3], const double high[3]) {
    return {{rounded_down(low[0]), rounded_down(low[1]), rounded_down(low[2])},
            {rounded_up(high[0]), rounded_up(high[1]), rounded_up(high[2])}};
}

/// The box in the world of the unit sphere placed by `instance`.
Bounds sphere_bounds(const Instance& instance) {
    double low[3], high[3];
    for (int row = 0; row < 3; ++row) {
        const float* m = instance.object_to_world.m[row];
        const Vec3d v{m[0], m[1], m[2]};
        const double reach = std::sqrt(dot(v, v)) * (1 + 0x1p-40);
        low[row] = m[3] - reach;
        high[row] = m[3] + reach;
    }
    return rounded_outwards(low, high);
}

/// The box in the world of a soup placed by `instance`, widened by what rounding a ray into the
/// soup's space can move it.
Bounds placed_bounds(const Soup& soup, const Instance& instance) {
    if (soup.shape == Shape::sphere) return sphere_bounds(instance);
    const Bounds& box = soup.bounds;
    if (instance.identity || is_empty(box)) return box;
    const double lo[3] = {box.lo.x, box.lo.y, box.lo.z}, hi[3] = {box.hi.x, box.hi.y, box.hi.z};
    double low[3], high[3];
    for (int row = 0; row < 3; ++row) {
        const float* m = instance.object_to_world.m[row];
        double size = std::fabs(static_cast<double>(m[3]));
        low[row] = high[row] = m[3];
        for (int k = 0; k < 3; ++k) {
            const double a = m[k] * lo[k], b = m[k] * hi[k];
            low[row] += a < b ? a : b;
            high[row] += a < b ? b : a;
            size += std::fabs(a) > std::fabs(b) ? std::fabs(a) : std::fabs(b);
        }
        low[row] -= size * 0x1p-21;
        high[row] += size * 0x1p-21;
    }
    return rounded_outwards(low, high);
}

/// The same over all of the way of one that moves: between two keys its points go straight.
Bounds moving_bounds(const World& world, const Soup& soup, const Instance& instance) {
    if (instance.key_count == 0) return placed_bounds(soup, instance);
    Bounds box = empty_bounds();
    Instance at = instance;
    for (int32_t k = 0; k < instance.key_count; ++k) {
        at.object_to_world = world.motion_keys[instance.first_key + k];
        box = united(box, placed_bounds(soup, at));
    }
    return box;
}

/// Instances whose mesh nobody else uses and that stand where the mesh is, and all the others.
struct Shares {
    std::vector<int32_t> merged, placed;
};

Shares share_instances(const World& world) {
    std::vector<int32_t> uses(world.meshes.size(), 0);
    for (const Instance& instance : world.instances) ++uses[instance.mesh];
    Shares shares;
    for (size_t k = 0; k < world.instances.size(); ++k) {
        const Instance& instance = world.instances[k];
        const bool merge = world.merge && instance.identity && instance.mask == kEveryRay &&
                           uses[instance.mesh] == 1 &&
                           world.meshes[instance.mesh].shape == Shape::triangles;
        (merge ? shares.merged : shares.placed).push_back(static_cast<int32_t>(k));
    }
    return shares;
}

/// The soup that came along with `mesh`, where it is of the kind asked for; else null.
std::shared_ptr<Soup> kept_soup(const World& world, int32_t mesh, AccelKind accel) {
    if (static_cast<size_t>(mesh) >= world.kept.size() || !world.kept[mesh]) return nullptr;
    const Soup& soup = *world.kept[mesh];
    return soup.accel == accel || soup.triangles == 0 ? world.kept[mesh] : nullptr;
}

/// Soups of the meshes that are used, one each, but one for all that are merged.
void build_soups(const World& world, const SoupSettings& settings, WorldIndex& index,
                 BuildStats* stats) {
    const auto keep = [&](std::shared_ptr<Soup> soup) {
        index.soups.push_back(std::move(soup));
        return index.soups.back().get();
    };
    const auto build = [&](Soup soup) {
        ++stats->built_trees;
        return keep(std::make_shared<Soup>(std::move(soup)));
    };
    index.soup_of_mesh.assign(world.meshes.size(), nullptr);
    Shares shares = share_instances(world);
    if (shares.merged.size() > 1)
        index.merged = build(build_merged_soup(world, shares.merged, settings));
    else
        shares.placed.insert(shares.placed.end(), shares.merged.begin(), shares.merged.end());
    for (int32_t number : shares.placed) {
        const int32_t mesh = world.instances[number].mesh;
        Soup*& soup = index.soup_of_mesh[mesh];
        if (soup) continue;
        if (std::shared_ptr<Soup> known = kept_soup(world, mesh, settings.accel)) {
            ++stats->kept_trees;
            soup = keep(std::move(known));
        } else {
            soup = build(build_mesh_soup(world.meshes[mesh], settings));
        }
    }
}

/// The placement of instance `number`; -1 is the merged soup.
Placement placement_of(const World& world, const WorldIndex& index, int32_t number) {
    if (number < 0) return {index.merged, -1, true, {}};
    return place_soup(world, *index.soup_of_mesh[world.instances[number].mesh], number);
}

/// Whether there is something in the box, and all of it near enough to be met: a little more than
/// the coordinates of sound triangles are allowed. Not where a number is none.
bool can_be_met(const Bounds& box) {
    constexpr float kFarthest = 2e18f;
    const Vec3 lo = box.lo, hi = box.hi;
    return !is_empty(box) && lo.x >= -kFarthest && lo.y >= -kFarthest && lo.z >= -kFarthest &&
           hi.x <= kFarthest && hi.y <= kFarthest && hi.z <= kFarthest;
}

/// Boxes of all that has one, by instance, and in `index.unbounded` what has none.
PrimRefs gather_boxes(const World& world, WorldIndex& index) {
    PrimRefs refs;
    refs.reserve(world.instances.size());
    if (index.merged && index.merged->triangles > 0)
        refs.push_back(make_ref(index.merged->bounds, -1));
    for (size_t k = 0; k < world.instances.size(); ++k) {
        const auto number = static_cast<int32_t>(k);
        const Instance& instance = world.instances[k];
        const Soup* soup = index.soup_of_mesh[instance.mesh];
        if (!soup) continue;
        if (soup->shape == Shape::plane)
            index.unbounded.push_back(placement_of(world, index, number));
        if (soup->shape == Shape::plane) continue;
        const Bounds box = moving_bounds(world, *soup, instance);
        if (can_be_met(box)) refs.push_back(make_ref(box, number));
    }
    return refs;
}

/// The longest edge of the box of them all.
float largest_extent(const PrimRefs& refs) {
    Bounds all = empty_bounds();
    for (const PrimRef& ref : refs) all = united(all, box_of(ref));
    if (is_empty(all)) return 0;
    const Vec3 size = all.hi - all.lo;
    return std::fmax(size.x, std::fmax(size.y, size.z));
}

void count_up(const WorldIndex& index, BuildStats* stats) {
    for (const auto& soup : index.soups) {
        stats->nodes += soup_nodes(*soup);
        stats->triangles += soup->triangles;
        stats->degenerate_triangles += soup->degenerate;
    }
    stats->nodes += static_cast<int64_t>(index.top.nodes.size());
    stats->bytes += index.bytes;
}

int64_t index_bytes(const WorldIndex& index) {
    const size_t placed = index.placements.size() + index.unbounded.size();
    int64_t bytes = static_cast<int64_t>(index.top.nodes.size() * sizeof(WideNode) +
                                         placed * sizeof(Placement));
    for (const auto& soup : index.soups) bytes += soup_bytes(*soup);
    return bytes;
}

}  // namespace

void place_soups(const World& world, WorldIndex& index, int threads) {
    index.placements = {};
    index.unbounded = {};
    index.top = {};
    index.moving = !world.motion_keys.empty();
    index.masked = false;
    for (const Instance& instance : world.instances)
        index.masked = index.masked || instance.mask != kEveryRay;
    PrimRefs refs = gather_boxes(world, index);
    index.reach = largest_extent(refs);
    if (refs.size() > 1) index.top = build_tree(refs, {1, threads});
    index.placements.reserve(refs.size());
    if (refs.size() == 1) index.placements.push_back(placement_of(world, index, refs[0].item));
    for (const LeafRange& leaf : index.top.leaves)
        index.placements.push_back(placement_of(world, index, refs[leaf.begin].item));
    index.top.leaves = {};
    index.bytes = index_bytes(index);
}

BuildStats build_world(World& world, int threads, double rays) {
    const auto start = std::chrono::steady_clock::now();
    BuildStats stats;
    const Choice choice = world.accel == AccelKind::automatic
                              ? choose_accel(workload_of(world, rays, threads))
                              : Choice{world.accel, "asked for"};
    world.index.reset();
    stats.accel = choice.accel;
    stats.reason = choice.reason;
    stats.instances = static_cast<int64_t>(world.instances.size());
    auto index = std::make_shared<WorldIndex>();
    index->triangle_test = world.triangle_test;
    index->kernels = kernels_of(world.isa);

    index->accel = stats.accel;
    build_soups(world, {stats.accel, world.triangle_test, threads}, *index, &stats);
    world.kept.clear();
    place_soups(world, *index, threads);

    count_up(*index, &stats);
    world.index = std::move(index);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    stats.seconds = elapsed.count();
    return stats;
}

}  // namespace trg

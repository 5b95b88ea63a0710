/// One ray through a world: planes, the top level, and the soups it places.
#pragma once

#include "accel/test_classic.h"
#include "accel/test_shape.h"
#include "accel/test_watertight.h"
#include "accel/walk_grid.h"
#include "accel/walk_pairs.h"
#include "accel/walk_tree.h"

namespace trg::TRG_ISA {

TRG_FN const CornerBlock* blocks_of(const Soup& soup, const CornerBlock*) {
    return soup.corner_blocks.data();
}
TRG_FN const PlaneBlock* blocks_of(const Soup& soup, const PlaneBlock*) {
    return soup.plane_blocks.data();
}

/// Calls `visit(block index)` for all blocks of `soup` that the ray may meet before `*limit`.
template <bool kSorted, class Block, class Visit>
TRG_FN bool walk_soup(const Soup& soup, const TracedRay& ray, const float* limit, Visit visit) {
    if (soup.accel == AccelKind::bvh) return walk_tree<kSorted>(soup.tree, ray, limit, visit);
    if (soup.accel == AccelKind::grid || soup.accel == AccelKind::grid2)
        return walk_grid(soup.grid, ray, limit, visit);
    if (soup.accel == AccelKind::tree) return walk_pairs(soup.pairs, ray, limit, visit);
    const size_t count = soup.corner_blocks.size() + soup.plane_blocks.size();
    for (size_t k = 0; k < count; ++k)
        if (visit(static_cast<uint32_t>(k))) return true;
    return false;
}

template <class Block, class AnySearch>
TRG_FN void search_soup(const Soup& soup, const TracedRay& ray, AnySearch& search) {
    const Block* blocks = blocks_of(soup, static_cast<const Block*>(nullptr));
    walk_soup<true, Block>(soup, ray, &search.limit, [&](uint32_t k) {
        test_closest(blocks[k], ray, search);
        return false;
    });
}

template <class Block>
TRG_FN bool soup_hides(const Soup& soup, const TracedRay& ray, float t_max) {
    const Block* blocks = blocks_of(soup, static_cast<const Block*>(nullptr));
    const float limit = t_max * kFarFactor;
    const auto visit = [&](uint32_t k)
                           TRG_INLINE_METHOD { return test_any(blocks[k], ray, t_max); };
    return walk_soup<false, Block>(soup, ray, &limit, visit);
}

/// `v` rounded to float, for good: GCC 12 takes the way to float and back out of vectorised code,
/// and then the doubles of a ray are those of another ray than its floats.
TRG_FN Vec3 rounded(Vec3d v) {
    Vec3 result = to_float(v);
#if defined(__GNUC__)
    asm("" : "+m"(result));
#endif
    return result;
}

TRG_FN TracedRay enter_space(const InverseMap& into, const TracedRay& ray) {
    return prepare_ray(rounded(point_into(into, ray.origin_d)),
                       rounded(vector_into(into, ray.direction_d)), ray.t_min);
}

/// The ray in the space of a placed soup; distances stay what they are.
TRG_FN TracedRay enter_placement(const Placement& placement, const TracedRay& ray) {
    if (placement.key_count > 0) return enter_space(into_at(placement, ray.time), ray);
    return enter_space(placement.into, ray);
}

/// False where a placement is so small or far that the ray's numbers there are none: empty lanes of
/// a node would seem to be met.
TRG_FN bool is_representable(const TracedRay& local) {
    float zero = 0;
    for (int axis = 0; axis < 3; ++axis)
        zero += local.origin[axis] * 0.0f + local.direction[axis] * 0.0f;
    const bool directed =
        (local.direction[0] != 0) | (local.direction[1] != 0) | (local.direction[2] != 0);
    return (zero == 0) & directed;
}

template <class Block, class AnySearch>
TRG_FN void search_placement(const Placement& placement, const TracedRay& ray, AnySearch& search) {
    if (!(placement.mask & ray.mask)) return;
    search.current = &placement;
    if (placement.soup->shape != Shape::triangles)
        test_closest(placement, ray, search);
    else if (placement.identity)
        search_soup<Block>(*placement.soup, ray, search);
    else if (const TracedRay local = enter_placement(placement, ray); is_representable(local))
        search_soup<Block>(*placement.soup, local, search);
}

template <class Block, class AnySearch>
TRG_INLINE_FN void search_world(const WorldIndex& index, const TracedRay& ray, AnySearch& search) {
    const Placement* placements = index.placements.data();
    for (const Placement& plane : index.unbounded) search_placement<Block>(plane, ray, search);
    if (index.placements.size() == 1) return search_placement<Block>(*placements, ray, search);
    walk_tree_here<true>(index.top, ray, &search.limit, [&](uint32_t k) {
        search_placement<Block>(placements[k], ray, search);
        return false;
    });
}

template <class Block>
TRG_FN bool placement_hides(const Placement& placement, const TracedRay& ray, float t_max) {
    if (!(placement.mask & ray.mask)) return false;
    if (placement.soup->shape != Shape::triangles) return test_any(placement, ray, t_max);
    if (placement.identity) return soup_hides<Block>(*placement.soup, ray, t_max);
    const TracedRay local = enter_placement(placement, ray);
    return is_representable(local) && soup_hides<Block>(*placement.soup, local, t_max);
}

template <class Block>
TRG_INLINE_FN bool world_hides(const WorldIndex& index, const TracedRay& ray, float t_max) {
    const auto visit = [&](uint32_t k) {
        return placement_hides<Block>(index.placements[k], ray, t_max);
    };
    for (const Placement& plane : index.unbounded)
        if (placement_hides<Block>(plane, ray, t_max)) return true;
    if (index.placements.size() == 1) return visit(0);
    const float limit = t_max * kFarFactor;
    return walk_tree_here<false>(index.top, ray, &limit, visit);
}

/// `ray` with a direction of ordinary length, and the power of two by which its distances grew.
struct ScaledRay {
    Ray ray;
    float scale;
};

TRG_INLINE_FN ScaledRay scale_ray(Ray ray) {
    if (!(ray.t_min > 0)) ray.t_min = 0;  // also -0, whose bits do not sort
    const Vec3 d = ray.direction;
    const float x = std::fabs(d.x), y = std::fabs(d.y), z = std::fabs(d.z);
    const float largest_xy = x > y ? x : y, largest = largest_xy > z ? largest_xy : z;
    if (largest > 1e-12f && largest < 1e12f) return {ray, 1.0f};
    const int exponent = std::ilogb(largest);
    // Two steps each way, because 2^exponent itself may be out of range.
    const float scale = std::ldexp(1.0f, exponent < -126 ? -126 : exponent > 126 ? 126 : exponent);
    ray.direction = {d.x / scale, d.y / scale, d.z / scale};
    ray.t_min *= scale;
    // What lies too far for a float, once scaled back, is not met: by any query.
    constexpr float kFarthest = 3.40282347e38f;
    ray.t_max = (ray.t_max < kFarthest ? ray.t_max : kFarthest) * scale;
    return {ray, scale};
}

template <class Block>
TRG_INLINE_FN Barycentrics hit_coordinates(const Search& search, const Placement& placement,
                                           const TracedRay& ray) {
    if (!search.block) return coordinates_of(placement, ray, search.t);
    const Block& block = *static_cast<const Block*>(search.block);
    if (placement.identity) return coordinates_of(block, search.lane, ray);
    return coordinates_of(block, search.lane, enter_placement(placement, ray));
}

template <class Block>
TRG_INLINE_FN Hit resolve_hit(const Search& search, const TracedRay& ray, float scale) {
    if (search.prim < 0) return no_hit();
    const Placement& placement = *search.placement;
    const Barycentrics at = hit_coordinates<Block>(search, placement, ray);
    const PrimOrigin origin = origin_of(placement, search.prim);
    const float t = search.t / scale;
    if (!(t < HUGE_VALF)) return no_hit();
    return {t, at.u, at.v, origin.triangle, origin.instance};
}

TRG_FN bool is_empty(const WorldIndex& index) {
    return index.placements.empty() && index.unbounded.empty();
}

template <class Block>
TRG_INLINE_FN Hit closest_hit(const WorldIndex& index, const Ray& ray, RayTag tag = {}) {
    if (!is_traceable(ray) || is_empty(index)) return no_hit();
    const ScaledRay scaled = scale_ray(ray);
    TracedRay traced = prepare_ray(scaled.ray.origin, scaled.ray.direction, scaled.ray.t_min);
    traced.time = tag.time;
    traced.mask = tag.mask;
    Search search = start_search(scaled.ray.t_max);
    search_world<Block>(index, traced, search);
    return resolve_hit<Block>(search, traced, scaled.scale);
}

/// What the ray meets next behind `met`, which it met before.
template <class Block>
TRG_FN Hit hit_beyond(const WorldIndex& index, const Ray& ray, RayTag tag, const Hit& met) {
    if (!is_traceable(ray) || is_empty(index)) return no_hit();
    const ScaledRay scaled = scale_ray(ray);
    const float after = met.t * scaled.scale;
    TracedRay traced =
        prepare_ray(scaled.ray.origin, scaled.ray.direction, std::nextafter(after, 0.0f));
    traced.time = tag.time;
    traced.mask = tag.mask;
    SearchBeyond search{start_search(scaled.ray.t_max), after, {met.instance, met.triangle}};
    search_world<Block>(index, traced, search);
    return resolve_hit<Block>(search, traced, scaled.scale);
}

template <class Block>
TRG_INLINE_FN bool is_hidden(const WorldIndex& index, const Ray& ray, RayTag tag = {}) {
    if (!is_traceable(ray) || is_empty(index)) return false;
    const ScaledRay scaled = scale_ray(ray);
    TracedRay traced = prepare_ray(scaled.ray.origin, scaled.ray.direction, scaled.ray.t_min);
    traced.time = tag.time;
    traced.mask = tag.mask;
    return world_hides<Block>(index, traced, scaled.ray.t_max);
}

}  // namespace trg::TRG_ISA

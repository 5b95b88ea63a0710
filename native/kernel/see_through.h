/// Surfaces that are only partly there: rays go straight on through the rest. That is no
/// scattering; it counts no bounce and leaves density and length of the ray as they were.
#pragma once

#include "kernel/shade_paths.h"

namespace trg {

/// After so many surfaces the next one counts as solid.
constexpr int32_t kMostSheets = 4096;
/// Dimensions of the sampler from which see-through decisions are drawn.
constexpr uint32_t kFirstSheetDimension = 1u << 24;

/// The material at a hit where its surface is partly there, else null; `alpha` is how much is
/// there.
template <uint32_t F>
TRG_FN const Material* thin_material(const SceneView& scene, const TimedRay& ray, const Hit& hit,
                                     float* alpha) {
    const Material& m = scene.materials[material_of(scene, {hit.instance, hit.triangle})];
    if (m.alpha >= 1.0f && m.alpha_texture < 0) return nullptr;
    *alpha = alpha_of<F>(scene, surface_of_hit<F>(scene, ray, hit), -normalize(ray.ray.direction));
    return *alpha < 1.0f ? &m : nullptr;
}

/// Moves the start of `ray` just past `hit` and finds what lies beyond.
TRG_FN void look_beyond(const World& world, TimedRay* timed, Hit* hit) {
    Ray* ray = &timed->ray;
    ray->t_min = hit->t * 1.0000002f + 1e-37f;
    *hit = no_hit();
    if (ray->t_max > ray->t_min)
        intersect_closest(world, ray, hit, 1, {&timed->time, &timed->mask});
}

/// A slot of the queue and the number of the surface that its path meets.
struct SlotAt {
    int32_t slot, depth;
};

/// Brings the path at `at` to the first surface that stops it, by chance where that is partly
/// there; `*sheet` counts the surfaces passed.
template <uint32_t F>
TRG_FN void pass_sheets(const RenderView& view, PathQueues& queues, const SlotAt& at,
                        uint32_t* sheet) {
    const SceneView& scene = view.scene;
    const int32_t slot = at.slot;
    Hit& hit = queues.hits[slot];
    PathState& state = queues.states[slot];
    TimedRay ray{queues.rays[slot], path_time(scene, queues, state.path)};
    if constexpr (has(F, kLimits)) ray.mask = queues.limits.states[state.path].kind;
    const uint32_t first = kFirstSheetDimension + static_cast<uint32_t>(at.depth) * kMostSheets;
    for (; *sheet < kMostSheets && hit.triangle >= 0; ++*sheet) {
        float alpha;
        const Material* m = thin_material<F>(scene, ray, hit, &alpha);
        if (!m || sample_uniform2(queues.keys[state.path], first + *sheet).u < alpha) return;
        state.throughput = state.throughput * m->through;
        if constexpr (has(F, kLimits)) count_sheet(view.rules, &queues.limits.states[state.path]);
        look_beyond(*scene.world, &ray, &hit);
        queues.rays[slot] = ray.ray;
        if constexpr (has(F, kLimits))
            if (queues.limits.states[state.path].ended) return;
    }
}

/// Likewise, but over boundaries of media that give way to others, too.
template <uint32_t F>
TRG_FN void pass_boundaries(const RenderView& view, PathQueues& queues, int32_t slot,
                            int32_t depth) {
    const SceneView& scene = view.scene;
    const int32_t path = queues.states[slot].path;
    uint32_t sheet = 0;
    for (int32_t k = 0; k < kMostSheets; ++k) {
        if (scene.see_through) pass_sheets<F>(view, queues, {slot, depth}, &sheet);
        TimedRay ray{queues.rays[slot], path_time(scene, queues, path)};
        if constexpr (has(F, kLimits)) {
            if (queues.limits.states[path].ended) return;
            ray.mask = queues.limits.states[path].kind;
        }
        if (!pass_boundary<F>(scene, ray,
                              {&queues.hits[slot], &queues.media[path], &queues.boundaries[path]}))
            return;
    }
}

/// Dims the light of shadow ray `number` by all that it passes; true when something solid stops it.
template <uint32_t F>
TRG_FN bool dim_shadow(const RenderView& view, PathQueues& queues, int32_t number) {
    const SceneView& scene = view.scene;
    ShadowState* state = &queues.shadows[number];
    TimedRay ray{queues.shadow_rays[number], path_time(scene, queues, state->path)};
    int32_t most = kMostSheets;
    if constexpr (has(F, kLimits)) {
        ray.mask = kShadowRay;
        const int32_t left = sheets_left(view.rules, queues.limits.states[path_of(*state)]);
        most = left < most ? left : most;
    }
    Hit hit = no_hit();
    intersect_closest(*scene.world, &ray.ray, &hit, 1, {&ray.time, &ray.mask});
    [[maybe_unused]] int32_t turns = 0;
    for (int32_t sheet = 0; sheet < most && hit.triangle >= 0; ++sheet) {
        if constexpr (has(F, kMedia)) {
            Boundary boundary;
            if (scene.nested &&
                pass_boundary<F>(scene, ray, {&hit, &queues.shadow_media[number], &boundary})) {
                // A boundary is no sheet; the turns are bounded all the same.
                if (++turns < kMostSheets) --sheet;
                continue;
            }
        }
        float alpha;
        const Material* m = thin_material<F>(scene, ray, hit, &alpha);
        if (!m) return true;
        state->light = state->light * m->through * (1.0f - alpha);
        if (is_black(state->light)) return true;
        look_beyond(*scene.world, &ray, &hit);
    }
    return hit.triangle >= 0;
}

}  // namespace trg

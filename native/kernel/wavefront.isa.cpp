#include "kernel/wavefront.h"

#include "kernel/camera.h"
#include "kernel/see_through.h"

namespace trg {
namespace TRG_ISA {

namespace {

/// Adds the light of the shadow rays that were not stopped.
template <uint32_t F>
void accumulate_light(const RenderView& view, PathQueues& queues, int32_t depth, int32_t count) {
    for (int32_t i = 0; i < count; ++i) {
        if (queues.hidden[i]) continue;
        if constexpr (has(F, kLimits)) {
            Vec3& light = queues.shadows[i].light;
            if (queues.shadows[i].path >= 0)
                light = clamp_light(view.rules, depth + 1, light, &queues.limits.clamped);
        }
        if constexpr (has(F, kPasses)) {
            note_shadow(view, queues, i, depth);
            if (queues.shadows[i].path < 0) continue;
        }
        PathResult& result = queues.results[queues.shadows[i].path];
        result.radiance = result.radiance + queues.shadows[i].light;
    }
}

/// The times of rays whose paths `states` tell; null where nothing moves.
template <class State>
const float* ray_times(const SceneView& scene, PathQueues& queues, const State* states,
                       int32_t count) {
    if (!scene.timed) return nullptr;
    for (int32_t i = 0; i < count; ++i)
        queues.ray_times[i] = path_time(scene, queues, states[i].path);
    return queues.ray_times;
}

/// Times and masks of the rays of the paths, or of the shadow rays, that are traced next.
template <uint32_t F, class State>
RayTags ray_tags(const SceneView& scene, PathQueues& queues, const State* states, int32_t count) {
    RayTags tags{ray_times(scene, queues, states, count), nullptr};
    if constexpr (has(F, kLimits)) {
        if (!scene.masked) return tags;
        for (int32_t i = 0; i < count; ++i) queues.limits.ray_masks[i] = mask_of(queues, states[i]);
        tags.masks = queues.limits.ray_masks;
    }
    return tags;
}

/// Finds where all paths go on to, and which shadow rays are stopped.
template <uint32_t F>
void trace_paths(const RenderView& view, PathQueues& queues, int32_t living, int32_t depth) {
    const SceneView& scene = view.scene;
    intersect_closest(*scene.world, queues.rays, queues.hits, living,
                      ray_tags<F>(scene, queues, queues.states, living));
    if constexpr (has(F, kMedia)) {
        for (int32_t slot = 0; scene.nested && slot < living; ++slot)
            pass_boundaries<F>(view, queues, slot, depth);
        if (scene.nested) return;
    }
    if constexpr (has(F, kSeeThrough))
        for (int32_t slot = 0; scene.see_through && slot < living; ++slot) {
            uint32_t sheet = 0;
            pass_sheets<F>(view, queues, {slot, depth}, &sheet);
        }
}
template <uint32_t F>
void trace_shadows(const RenderView& view, PathQueues& queues, int32_t count) {
    const SceneView& scene = view.scene;
    if constexpr (has(F, kSeeThrough)) {
        if (scene.see_through || scene.nested) {
            for (int32_t i = 0; i < count; ++i)
                queues.hidden[i] = dim_shadow<F>(view, queues, i) ? 1 : 0;
            return;
        }
    }
    intersect_any(*scene.world, queues.shadow_rays, queues.hidden, count,
                  ray_tags<F>(scene, queues, queues.shadows, count));
}

/// True when rays after the last scattering could still find light.
template <uint32_t F>
bool last_ray_matters(const SceneView& scene) {
    return has(F, kExtendedEmitters) || has(F, kEnvironment) || !is_black(scene.background);
}

/// The rays after the last scattering when nothing but the world shines: any hit will do.
template <uint32_t F>
void finish_in_background(const RenderView& view, PathQueues& queues, int32_t count) {
    intersect_any(*view.scene.world, queues.rays, queues.hidden, count,
                  {ray_times(view.scene, queues, queues.states, count), nullptr});
    for (int32_t i = 0; i < count; ++i) {
        if (queues.hidden[i]) continue;
        PathResult& result = queues.results[queues.states[i].path];
        const Vec3 light =
            world_seen<F>(view.scene, queues.rays[i].direction, queues.states[i].pdf, 1);
        result.radiance = result.radiance + queues.states[i].throughput * light;
    }
}

/// Shades all paths, with the triangles of those ahead on their way from memory.
template <uint32_t F>
void shade_all(ShadeStage& stage, int32_t living) {
    constexpr int32_t kAhead = 8;
    const SceneView& scene = stage.view.scene;
    const Hit* hits = stage.queues.hits;
    for (int32_t slot = 0; slot < living; ++slot) {
        if (slot + 2 * kAhead < living) prefetch_surface<F>(scene, hits[slot + 2 * kAhead]);
        if (slot + kAhead < living) prefetch_corners(scene, hits[slot + kAhead]);
        shade_path<F>(stage, slot);
    }
}

template <uint32_t F>
bool render_chunk(const RenderView& view, const Chunk& chunk, PathQueues& queues,
                  const std::atomic<bool>& cancelled, RayCounts* counts) {
    int32_t living = generate_paths(view, chunk, queues);
    counts->camera += living;
    if constexpr (has(F, kMedia))
        if (view.scene.nested) begin_media<F>(view.scene, queues, living);
    if constexpr (has(F, kPasses)) clear_passes(view.passes, queues.passes, living);
    if constexpr (has(F, kLimits)) clear_limits(queues.limits, living);
    for (int32_t depth = 0; living > 0; ++depth) {
        if (cancelled.load(std::memory_order_relaxed)) return false;
        if (depth > 0) counts->bounce += living;
        if (depth > view.max_bounces && !has(F, kExtendedEmitters)) {
            finish_in_background<F>(view, queues, living);
            return true;
        }
        trace_paths<F>(view, queues, living, depth);
        ShadeStage stage{
            view, queues, depth, {queues.shadow_rays, queues.shadows, 0, queues.shadow_media}, 0};
        shade_all<F>(stage, living);
        if (stage.shadows.count > 0) {
            counts->shadow += stage.shadows.count;
            trace_shadows<F>(view, queues, stage.shadows.count);
            accumulate_light<F>(view, queues, depth, stage.shadows.count);
        }
        living = stage.next_count;
        if (depth == view.max_bounces && !last_ray_matters<F>(view.scene)) return true;
    }
    return true;
}

constexpr uint32_t kPlain = kSmoothNormals;
constexpr uint32_t kLamps = kSmoothNormals | kExtendedEmitters;
constexpr uint32_t kTextured = kLamps | kTextures;
constexpr uint32_t kOutdoor = kTextured | kEnvironment;
constexpr uint32_t kGlass = kOutdoor | kTransmission;
constexpr uint32_t kFull = kGlass | kLayers | kSeeThrough | kMixtures | kMedia;
constexpr uint32_t kProgrammed = kFull | kPrograms;
constexpr uint32_t kLimited = kProgrammed | kLimits;
constexpr uint32_t kPassed = kLimited | kPasses;

const KernelSet kSets[] = {{"plain", kPlain, render_chunk<kPlain>},
                           {"lamps", kLamps, render_chunk<kLamps>},
                           {"textured", kTextured, render_chunk<kTextured>},
                           {"outdoor", kOutdoor, render_chunk<kOutdoor>},
                           {"glass", kGlass, render_chunk<kGlass>},
                           {"full", kFull, render_chunk<kFull>},
                           {"programmed", kProgrammed, render_chunk<kProgrammed>},
                           {"limited", kLimited, render_chunk<kLimited>},
                           {"passes", kPassed, render_chunk<kPassed>}};

}  // namespace

const KernelSet* kernel_sets(int* count) {
    *count = static_cast<int>(sizeof kSets / sizeof kSets[0]);
    return kSets;
}

}  // namespace TRG_ISA
}  // namespace trg

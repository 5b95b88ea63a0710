#include "kernel/camera.h"
#include "kernel/shade_classic.h"
#include "kernel/wavefront.h"

namespace trg {
namespace TRG_ISA {

namespace {

/// Moves the camera's rays to the queue.
void queue_camera_rays(PathQueues& queues, ClassicQueues& classic, int32_t count) {
    for (int32_t i = 0; i < count; ++i)
        classic.pending[i] = {queues.rays[i], {1.0f, 1.0f, 1.0f}, queues.media[i], i, 0};
    classic.count = count;
}

/// Takes rays off the top of the stack; returns how many. So few that what they may leave behind,
/// one ray more on each level, finds room.
int32_t take_batch(const RenderView& view, PathQueues& queues, ClassicQueues& classic) {
    const int32_t deepest = view.max_bounces < kDeepestClassic ? view.max_bounces : kDeepestClassic;
    const int32_t levels = deepest - classic.pending[classic.count - 1].depth + 1;
    const int32_t room = (classic.capacity - deepest - classic.count) / levels;
    int32_t count = room < queues.capacity ? room : queues.capacity;
    if (count > classic.count) count = classic.count;
    if (count < 1) count = 1;
    classic.count -= count;
    for (int32_t k = 0; k < count; ++k) {
        classic.batch[k] = classic.pending[classic.count + k];
        queues.rays[k] = classic.batch[k].ray;
    }
    return count;
}

template <uint32_t F>
void light_vertices(ClassicStage& stage) {
    const SceneView& scene = stage.view.scene;
    for (int32_t k = 0; k < scene.light_count; ++k) {
        const int32_t count = ask_light(stage, scene.lights[k]);
        if (scene.classic_passes_light)
            add_tinted_light<F>(stage, count);
        else
            add_plain_light(stage, count);
    }
}

template <uint32_t F>
bool render_classic(const RenderView& view, const Chunk& chunk, PathQueues& queues,
                    const std::atomic<bool>& cancelled, RayCounts* counts) {
    ClassicQueues& classic = *queues.classic;
    const int32_t paths = generate_paths(view, chunk, queues);
    counts->camera += paths;
    if (view.scene.nested) begin_media<F>(view.scene, queues, paths);
    queue_camera_rays(queues, classic, paths);
    for (bool first = true; classic.count > 0; first = false) {
        if (cancelled.load(std::memory_order_relaxed)) return false;
        const int32_t count = take_batch(view, queues, classic);
        if (!first) counts->bounce += count;
        intersect_closest(*view.scene.world, queues.rays, queues.hits, count);
        ClassicStage stage{view, queues, classic, counts, 0};
        for (int32_t slot = 0; slot < count; ++slot) meet_surface<F>(stage, slot);
        light_vertices<F>(stage);
    }
    return true;
}

constexpr uint32_t kImages = kSmoothNormals | kTextures | kEnvironment;
constexpr uint32_t kAll = kImages | kPrograms;

const KernelSet kSets[] = {{"classic", kImages, render_classic<kImages>},
                           {"classic_programmed", kAll, render_classic<kAll>}};

}  // namespace

const KernelSet* classic_kernel_sets(int* count) {
    *count = static_cast<int>(sizeof kSets / sizeof kSets[0]);
    return kSets;
}

}  // namespace TRG_ISA
}  // namespace trg

#include "kernel/kernel_sets.h"

#include "base/isa.h"
#include "kernel/camera.h"
#include "kernel/wavefront.h"

namespace trg {

namespace {

using SetsOf = const KernelSet* (*)(int* count);

SetsOf sets_of([[maybe_unused]] Isa isa, bool classic) {
#if defined(TRG_HAS_X86_VARIANTS)
    switch (isa) {
        case Isa::avx512:
            return classic ? avx512::classic_kernel_sets : avx512::kernel_sets;
        case Isa::avx2:
            return classic ? avx2::classic_kernel_sets : avx2::kernel_sets;
        default:
            break;
    }
#endif
    return classic ? baseline::classic_kernel_sets : baseline::kernel_sets;
}

}  // namespace

const KernelSet& choose_kernel_set(uint32_t features, Isa isa, bool classic) {
    // The classic integrator has the paper's materials, whatever lobes the scene asks for.
    if (classic) features &= kTextures | kSmoothNormals | kEnvironment | kPrograms;
    int count;
    const KernelSet* sets = sets_of(isa, classic)(&count);
    for (int k = 0; k < count; ++k)
        if ((features & ~sets[k].features) == 0) return sets[k];
    return sets[count - 1];
}

const char* kernel_set_names() {
    return "plain lamps textured outdoor glass full programmed limited passes classic "
           "classic_programmed";
}

void render_depth(const RenderView& view, const Pixel* pixels, int32_t count, PathQueues& queues,
                  float* depth) {
    for (int32_t i = 0; i < count; ++i)
        queues.rays[i] = make_camera_ray(view, static_cast<float>(pixels[i].x) + 0.5f,
                                         static_cast<float>(pixels[i].y) + 0.5f);
    intersect_closest(*view.scene.world, queues.rays, queues.hits, count);
    for (int32_t i = 0; i < count; ++i)
        depth[i] = queues.hits[i].triangle < 0 ? 1e10f : queues.hits[i].t;
}

}  // namespace trg

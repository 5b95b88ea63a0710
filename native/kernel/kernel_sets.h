/// Compiled kernels by name, and the choice among them.
#pragma once

#include <atomic>

#include "base/isa.h"
#include "kernel/path_queues.h"

namespace trg {

/// A union of features that one build of the kernels serves.
struct KernelSet {
    const char* name;
    uint32_t features;
    /// Renders `chunk` into queues.results; false when `cancelled` became true on the way.
    bool (*render_chunk)(const RenderView& view, const Chunk& chunk, PathQueues& queues,
                         const std::atomic<bool>& cancelled, RayCounts* counts);
};

/// The smallest set of the path integrator, or of `classic`, that serves `features`, compiled for
/// `isa`; the largest where none does.
const KernelSet& choose_kernel_set(uint32_t features, Isa isa, bool classic);

/// Names of all sets, smallest first, separated by spaces.
const char* kernel_set_names();

/// Depth of the ray through the centre of each pixel, 1e10 for a miss. At most `capacity` pixels.
void render_depth(const RenderView& view, const Pixel* pixels, int32_t count, PathQueues& queues,
                  float* depth);

}  // namespace trg

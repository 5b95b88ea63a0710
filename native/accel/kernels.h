/// The tracing functions as each instruction set has them.
#pragma once

#include <cstdint>

#include "geom/ray.h"

namespace trg {

struct WorldIndex;

struct RayBatch {
    const Ray* rays;
    RayTags tags;
    int count;
};

struct Kernels {
    void (*closest)(const WorldIndex& index, const RayBatch& batch, Hit* hits);
    void (*any)(const WorldIndex& index, const RayBatch& batch, uint8_t* hidden);
    /// What `ray` meets at `time` next behind a hit of its own.
    Hit (*beyond)(const WorldIndex& index, const Ray& ray, RayTag tag, const Hit& met);
};

namespace baseline {
Kernels trace_kernels();
}
namespace avx2 {
Kernels trace_kernels();
}
namespace avx512 {
Kernels trace_kernels();
}

}  // namespace trg

/// The tracing functions as each instruction set has them.
#pragma once

#include <cstdint>

#include "geom/ray.h"

namespace trg {

struct WorldIndex;

struct Kernels {
    void (*closest)(const WorldIndex& index, const Ray* rays, Hit* hits, int count);
    void (*any)(const WorldIndex& index, const Ray* rays, uint8_t* hidden, int count);
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

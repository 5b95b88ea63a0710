/// The queue of the classic integrator, which the paper puts in the place of recursion.
#pragma once

#include "kernel/path_queues.h"
#include "kernel/surface.h"

namespace trg {

/// A ray that waits to be traced. `weight` is the product of the shares on its way.
struct PendingRay {
    Ray ray;
    Vec3 weight;
    MediaStack media;  // that it is in; the innermost rules, or the one of the highest priority
    int32_t path;
    int32_t depth;  // 0 for a camera ray
};

/// A surface that a ray has met, ready for lights.
struct ClassicVertex {
    Surface surface;
    Vec3 wo, ng, ns;
    ClassicMaterial material;  // textures looked up
    Vec3 weight;
    MediaStack media, beyond;  // on both sides
    float ratio;               // index beyond over index on this side
    int32_t path;
};

/// Light on its way to a vertex.
struct ClassicShadow {
    Vec3 light;
    MediaStack media;  // between
    int32_t path;
};

/// Pending rays are a stack, so that few are pending at a time.
struct ClassicQueues {
    PendingRay* pending;
    int32_t capacity;
    int32_t count;
    PendingRay* batch;  // those being traced, and what they met; as many as paths
    ClassicVertex* vertices;
    ClassicShadow* shadows;
};

/// Rays this deep are the last ones, whatever is asked for.
constexpr int32_t kDeepestClassic = 1024;

}  // namespace trg

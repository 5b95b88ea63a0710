/// Paths in flight as structures of arrays, borrowed from room cpu.
#pragma once

#include "kernel/pass_list.h"
#include "kernel/scene_view.h"
#include "shade/bsdf_parts.h"
#include "shade/sampler.h"

namespace trg {

/// What a path carries from one surface to the next.
struct PathState {
    Vec3 throughput;
    float pdf;  // of the ray's direction, by solid angle; 0 after a delta or from the camera
    int32_t path;
};

/// What a path leaves behind.
struct PathResult {
    Vec3 radiance;
    Vec3 normal;  // of the first surface, turned to the viewer; null for a miss
    bool hit;
};

/// Light that arrives unless its shadow ray is stopped.
struct ShadowState {
    Vec3 light;
    int32_t path;
};

/// What a path remembers for passes.
struct PassState {
    ScatterShares shares;  // of its first scattering
    Vec3 feature;          // weight of denoising features still to come; null once they are there
};

/// The surface that a camera ray met; -1 for none.
struct PassHit {
    int32_t instance, material;
};

/// Memory for passes, all null when none is asked for.
struct PassQueues {
    float* values;  // `stride` floats a path
    int32_t stride;
    PassState* states;             // by path
    PassHit* hits;                 // by path
    ScatterShares* shadow_shares;  // by shadow ray of the first surface
};
struct ClassicQueues;

/// What a ray is, by the scattering that sent it on; bits of the masks of instances.
enum RayKind : uint8_t {
    kCameraRay = 1,
    kDiffuseRay = 2,
    kGlossyRay = 4,
    kTransmissionRay = 8,
    kShadowRay = 16,
    kBounceRays = kDiffuseRay | kGlossyRay | kTransmissionRay
};

/// What a path remembers of its scatterings.
struct PathLimits {
    uint8_t kind;     // RayKind of its ray
    bool ended;       // it only collects what shines from here on
    int32_t used[3];  // scatterings of a kind
    int32_t sheets;   // surfaces that it went straight through
};

/// Memory for kLimits, null without.
struct LimitQueues {
    PathLimits* states;  // by path
    uint8_t* ray_masks;  // of the rays that are traced next
    int64_t clamped;     // contributions cut so far
};

constexpr int32_t kMostMedia = 8;

/// The materials whose insides a path is in, in the order of entering; more than these are not
/// told.
struct MediaStack {
    int32_t count;
    int32_t materials[kMostMedia];
};

/// The boundary that a path met, where media with priorities meet.
struct Boundary {
    MediaStack beyond;
    float ratio;     // index beyond over index on this side; 0: no such boundary
    int32_t energy;  // where the table of its facets' albedo begins, or -1
    float slack;     // how far along the normal surfaces lie that count as this one
};

/// Arrays of `capacity` paths; slots [0, count) hold the living ones.
struct PathQueues {
    int32_t capacity;
    Ray* rays;
    Hit* hits;
    PathState* states;
    SampleKey* keys;      // by path
    PathResult* results;  // by path
    Vec3* receivers;    // by path: normal that light was drawn for last, null for any; for the tree
    MediaStack* media;  // by path
    Boundary* boundaries;      // by path: of its hit; only where media have priorities
    MediaStack* shadow_media;  // by shadow ray: where it starts; likewise
    Ray* shadow_rays;
    ShadowState* shadows;
    uint8_t* hidden;
    PassQueues passes;
    float* times;      // by path, 0 to 1 while the shutter is open; only where something moves
    float* ray_times;  // of the rays that are traced next
    ClassicQueues* classic;  // null for paths
    LimitQueues limits;
};

/// The path that a shadow ray belongs to.
TRG_FN int32_t path_of(const ShadowState& state) {
    return state.path < 0 ? ~state.path : state.path;
}

/// `path` as a state of a path or a shadow ray has it.
TRG_FN float path_time(const SceneView& scene, const PathQueues& queues, int32_t path) {
    return scene.timed ? queues.times[path < 0 ? ~path : path] : kMiddleTime;
}

struct Pixel {
    int32_t x, y;
};

/// Samples [first_sample, first_sample + samples) of some pixels; path i is pixel i / samples.
struct Chunk {
    const Pixel* pixels;
    int32_t pixel_count;
    uint32_t first_sample;
    int32_t samples;
};

/// By what paths are cut short, or made to bring less than they found: each is a bias.
struct PathRules {
    int32_t bounces[3];  // as max_bounces, of diffuse, glossy and transmission
    int32_t sheets;      // surfaces to go straight through
    float clamp_direct,
        clamp_indirect;           // most of a contribution's three channels together; 0: no limit
    bool reflective, refractive;  // caustics: light by such a way after a diffuse one
};

/// What holds for a whole render.
struct RenderView {
    SceneView scene;
    int32_t width, height;  // of the whole picture
    uint32_t seed;
    int32_t max_bounces;
    PassView passes;
    PathRules rules;
};

struct RayCounts {
    int64_t camera, shadow, bounce;
    int64_t cut;      // rays of the classic integrator that weighed too little or lay too deep
    int64_t clamped;  // contributions that a clamp made smaller
};

/// Pairs of dimensions of the sampler: the camera's, then a block for each surface.
enum Dimension : uint32_t {
    kPixelDimension = 0,
    kLensDimension = 1,
    kTimeDimension = (1u << 24) - 1,
    kFirstBounceDimension = 2,
    kDirection = 0,
    kLobe = 1,  // lobe and roulette
    kPoolPoint = 2,
    kPoolChoice = 3,
    kAlwaysLight = 4,  // and the three after it
    kSkyLight = 8,
    kTreeChoice = 9,  // where the tree is one of several
    kClosure = 10,
    kDimensionsPerBounce = 11,
};
constexpr int kMostAlwaysLights = 4;
static_assert(kAlwaysLight + kMostAlwaysLights == kSampleLanes,
              "the dimensions of most surfaces are one block");

}  // namespace trg

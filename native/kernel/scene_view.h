/// The scene as kernels see it: plain tables, borrowed from room scene while a render runs.
#pragma once

#include "accel/world.h"
#include "shade/classic_material.h"
#include "shade/environment.h"
#include "shade/light_tree.h"
#include "shade/lights.h"
#include "shade/material.h"
#include "shade/texture_set.h"

namespace trg {

/// What a scene may need; a kernel set is compiled for a union of these.
enum Feature : uint32_t {
    kTextures = 1,
    kSmoothNormals = 2,
    kTransmission = 4,
    kExtendedEmitters = 8,  // lights with extent, and surfaces that emit
    kLayers = 16,           // coat, sheen, rough diffuse
    kSeeThrough = 32,       // surfaces that let light straight through
    kMixtures = 64,         // materials that are several rows
    kMedia = 128,           // surfaces around something that absorbs
    kEnvironment = 512,     // a picture of the world around
    kPrograms = 1024,       // textures that are programs, and normals that they bend
    kPasses = 2048,         // passes beside combined, depth and normal
    kLimits = 4096,         // PathRules, holdouts, and surfaces that only some rays meet
};

TRG_FN constexpr bool has(uint32_t features, Feature feature) {
    return (features & feature) != 0;
}

/// The lobes that kernels of `features` know.
TRG_FN constexpr uint32_t lobes_of(uint32_t features) {
    return (has(features, kTransmission) ? kGlassLobe : 0u) |
           (has(features, kLayers) ? kLayerLobes : 0u);
}

struct MeshView {
    const Vec3* vertices;
    const Triangle* triangles;
    const float* normals;  // 9 a triangle, or null
    const float* uvs;      // 6 a triangle, or null
    const int32_t* slots;  // 1 a triangle, or null
    Shape shape;           // none of these where it is not triangles
};

/// Where a camera stands.
struct CameraPose {
    Vec3 axis_x, axis_y, axis_z, origin;
};

/// Or triangle 0 of a sphere, which is the sphere.
struct EmissiveTriangle {
    int32_t instance, triangle;
};

/// Who is sampled for direct light. Thresholds are cumulative shares of 2^32, the last one open.
struct EmitterView {
    const int32_t* always;  // lights that get a sample at every point
    int32_t always_count;
    const int32_t* pool;  // lights that share one sample; -1: the emissive triangles, or the tree
    const uint32_t* pool_limits;
    const float* pool_shares;
    int32_t pool_count;
    const int32_t* extended;       // lights that bounce rays can see
    const float* extended_shares;  // how often each is chosen: 1 for those that always are
    int32_t extended_count;
    const EmissiveTriangle* triangles;
    const uint32_t* triangle_limits;
    int32_t triangle_count;
    float triangle_density;  // chance, by area and per unit of emission_weight, of a point
    LightTreeView tree;      // where it is, it draws the triangles and most lights
};

enum class CameraKind : int32_t { perspective, orthographic, panorama };

/// The paper's ways of choosing points of a pixel; `even` is random points spread evenly.
enum class Antialiasing : int32_t { even, none, supersampling, jittering, mfaa };

struct AntialiasingView {
    Antialiasing kind;
    uint32_t side;     // of the grid of cells, at least 1
    uint32_t frame;    // its parity picks the pattern of mfaa
    bool one_pattern;  // all samples share a pattern; else each replicate has one
};

struct CameraView {
    CameraKind kind;
    CameraPose pose;                 // of one that moves: in the middle of the shutter
    float left, right, bottom, top;  // of a panorama: longitudes and latitudes
    float aperture;                  // radius of the lens; 0: all is sharp
    float focus;                     // depth of what is sharp
    int32_t blades;                  // below 3: a disc
    float blade_turn, squeeze;       // rotation of the polygon; what its width is scaled by
    float clip_start, clip_end;
};

constexpr int kFilterSteps = 1024;

struct SceneView {
    const World* world;
    const MeshView* meshes;
    const Instance* instances;
    const Transform* motion_keys;   // of the instances that move
    const CameraPose* camera_keys;  // of a camera that moves, as geom/motion.h has keys
    int32_t camera_key_count;       // or 0
    bool masked;                    // whether some instance is not met by all rays
    bool sky_covers;                // whether rays that leave the scene count as covered
    const uint8_t* held_out;        // 1 an instance that is, or null
    bool timed;                     // whether anything moves, so that paths have times
    const int32_t* slot_materials;  // of all instances in a row
    const int64_t* first_slot;      // one an instance
    const int32_t* slot_count;      // one an instance; 0: material 0
    const Material* materials;
    const float* energy;             // tables of the materials
    bool see_through;                // some material lets rays straight through
    bool nested;                     // some material's inside has a priority
    const int32_t* boundary_energy;  // tables of boundaries by [whose surface: 0 here, 1 there]
                                     // [medium here][medium there], -1: none
    int32_t media_count;             // medium 0 is all without priorities
    TextureSet textures;
    const TextureMesh* texture_meshes;  // one a mesh
    const float* randoms;               // one an instance, or null
    const ClassicMaterial* classic;     // one a material where the classic integrator renders
    bool classic_passes_light;          // some of them let light through
    Vec3 ambient;                       // its ambient light
    AntialiasingView antialiasing;
    const Light* lights;
    int32_t light_count;
    EmitterView emitters;
    Vec3 background;  // where there is no environment
    EnvironmentView environment;
    CameraView camera;
    const float* filter;  // kFilterSteps + 1 quantiles of the pixel filter; null: a box of a pixel
    float pixel_spread;   // a pixel's side, at distance 1 where the camera is perspective
};

}  // namespace trg

/// Materials, textures, images, lights and camera of a scene, taken from packed tables and checked.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "kernel/scene_view.h"
#include "scene/energy_tables.h"
#include "scene/environment.h"
#include "scene/texture_tables.h"

namespace trg {

/// A table with an impossible value; the message names argument, row and column.
class TableError : public std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

/// Columns of the packed tables, in order (trg_blender/engine/scene_arrays.py has the same).
extern const std::vector<const char*> kMaterialFields, kLightFields;

struct ShadingTables {
    TextureTables textures;
    std::vector<Material> materials;
    EnergyTables energy;                   // of the materials
    int32_t media_count = 1;               // materials with priorities, and 0 for all others
    std::vector<int32_t> boundary_energy;  // as SceneView has it
    std::vector<ClassicMaterial> classic;  // one a material, for the classic integrator
    Vec3 ambient{0.0f, 0.0f, 0.0f};
    bool is_classic = false;
    AntialiasingView antialiasing{Antialiasing::even, 1, 0, false};
    std::vector<Light> lights;
    Vec3 background{0.0f, 0.0f, 0.0f};
    Environment environment;
    CameraView camera{};
    std::vector<CameraPose> camera_keys;  // of one that moves; else empty
    std::vector<float> filter;            // quantiles; empty: a box of one pixel
    bool has_camera = false;
};

/// What the caller says about its camera; `matrix` is 3 x 4, camera to world.
struct CameraRequest {
    int kind;
    const double* matrix;
    const double* window;  // left, right, bottom, top
    double clip_start, clip_end;
    double aperture, focus;  // radius of the lens, depth of what is sharp
    int blades;
    double blade_turn, squeeze;
};

/// Each replaces its table. All throw TableError.
void set_materials(ShadingTables& tables, const Table& table);
void set_lights(ShadingTables& tables, const Table& table);
void set_background(ShadingTables& tables, float r, float g, float b);
/// Takes the place of the background. `environment` has pixels, size, axes and visibility; throws
/// TableError for pixels that are not finite.
void set_environment(ShadingTables& tables, Environment environment);
/// The pixel filter: box, gaussian or blackman_harris of Blender's `width` in pixels. TableError.
void set_filter(ShadingTables& tables, const std::string& name, double width);
void set_camera(ShadingTables& tables, const CameraRequest& request);
/// Makes the camera that was set move through `count` matrices as above, in a row; below two: not.
void set_camera_motion(ShadingTables& tables, const double* matrices, int64_t count);

}  // namespace trg

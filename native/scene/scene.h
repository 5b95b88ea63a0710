/// Everything that one render needs: geometry with its index, and the tables of shading.
#pragma once

#include <cstdint>
#include <vector>

#include "accel/world.h"
#include "scene/shading_tables.h"

namespace trg {

/// Values at the corners of a mesh's triangles; empty where it has none.
struct CornerAttribute {
    int32_t width = 0;  // 1 to 4
    std::vector<float> values;
};

/// What a mesh carries besides its shape; each array is empty when nothing asks for it.
struct MeshAttributes {
    std::vector<float> normals;            // 9 a triangle: three unit corner normals
    std::vector<float> uvs;                // 6 a triangle: three corner coordinates
    std::vector<int32_t> slots;            // 1 a triangle: material slot
    std::vector<CornerAttribute> corners;  // by the scene's number of the attribute; 0 is unused
    Vec3 space_scale{1.0f, 1.0f, 1.0f}, space_offset{0.0f, 0.0f, 0.0f};
};

/// What passes know of the scene beside its shape: see PassView.
struct PassTables {
    std::vector<float> instance_ids, material_ids;
    int32_t matte_levels = 6;
    float mist_start = 0.0f, mist_depth = 1.0f, mist_falloff = 1.0f;
    float ambient_distance = 1e30f;
};

struct Scene {
    World world;
    std::vector<MeshAttributes> attributes;  // one a mesh
    std::vector<int32_t> slot_materials;     // slot -> material, of all instances in a row
    std::vector<int64_t> first_slot;         // one an instance: where its slots begin
    std::vector<int32_t> slot_count;         // one an instance
    std::vector<float> randoms;              // one an instance, or none
    std::vector<uint8_t> held_out;           // 1 an instance that is, or none
    bool sky_covers = false;                 // see SceneView
    PassTables passes;
    ShadingTables tables;
};

}  // namespace trg

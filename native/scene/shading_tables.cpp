#include "scene/shading_tables.h"

#include "scene/prepare_material.h"
#include "scene/table_reader.h"

namespace trg {

const std::vector<const char*> kMaterialFields = {"base_r",
                                                  "base_g",
                                                  "base_b",
                                                  "metallic",
                                                  "roughness",
                                                  "ior",
                                                  "specular",
                                                  "transmission",
                                                  "emission_r",
                                                  "emission_g",
                                                  "emission_b",
                                                  "base_texture",
                                                  "roughness_texture",
                                                  "metallic_texture",
                                                  "emission_texture",
                                                  "normal_texture",
                                                  "specular_tint_r",
                                                  "specular_tint_g",
                                                  "specular_tint_b",
                                                  "metal_grazing",
                                                  "multiscatter",
                                                  "interface",
                                                  "diffuse_roughness",
                                                  "coat",
                                                  "coat_roughness",
                                                  "coat_ior",
                                                  "coat_tint_r",
                                                  "coat_tint_g",
                                                  "coat_tint_b",
                                                  "sheen_r",
                                                  "sheen_g",
                                                  "sheen_b",
                                                  "sheen_roughness",
                                                  "alpha",
                                                  "through_r",
                                                  "through_g",
                                                  "through_b",
                                                  "alpha_texture",
                                                  "translucent",
                                                  "mix_first",
                                                  "mix_count",
                                                  "weight",
                                                  "weight_texture",
                                                  "absorption_r",
                                                  "absorption_g",
                                                  "absorption_b",
                                                  "priority",
                                                  "transmission_texture",
                                                  "coat_texture",
                                                  "sheen_texture",
                                                  "sheen_roughness_texture",
                                                  "diffuse_roughness_texture",
                                                  "holdout"};

namespace {

Vec3 next_color(TableRow& row) {
    const float r = row.next(0.0f, 3.0e38f), g = row.next(0.0f, 3.0e38f),
                b = row.next(0.0f, 3.0e38f);
    return {r, g, b};
}

/// The columns in their order.
Material read_material(TableRow row, int64_t material_count, int64_t texture_count) {
    Material m{};
    m.base = next_color(row);
    m.metallic = row.next_share();
    m.roughness = row.next_share();
    m.ior = row.next(1e-3f, 1e6f);
    m.specular = row.next(0.0f, 1e6f);
    m.transmission = row.next_share();
    m.emission = row.next_vector();
    m.emission_weight = std::fabs(luminance(m.emission));
    m.base_texture = row.next_index(-1, texture_count);
    m.roughness_texture = row.next_index(-1, texture_count);
    m.metallic_texture = row.next_index(-1, texture_count);
    m.emission_texture = row.next_index(-1, texture_count);
    m.normal_texture = row.next_index(-1, texture_count);
    m.specular_tint = next_color(row);
    m.metal_grazing = row.next_share();
    m.multiscatter = row.next_share();
    m.interface = static_cast<Interface>(row.next_index(0, 3));
    m.diffuse_roughness = row.next_share();
    m.coat = row.next_share();
    const float coat_roughness = row.next_share();
    m.coat_alpha = coat_roughness * coat_roughness;
    m.coat_ior = row.next(1.0f, 1e6f);
    m.coat_tint = next_color(row);
    m.sheen = next_color(row);
    m.sheen_roughness = row.next_share();
    m.alpha = row.next_share();
    m.through = next_color(row);
    m.alpha_texture = row.next_index(-1, texture_count);
    m.translucent = row.next_index(0, 2) == 1;
    m.mix_first = row.next_index(-1, material_count);
    m.mix_count = row.next_index(0, kMostClosures + 1);
    m.weight = row.next(0.0f, 3.0e38f);
    m.weight_texture = row.next_index(-1, texture_count);
    m.absorption = next_color(row);
    m.priority = row.next(0.0f, 1e6f);
    m.transmission_texture = row.next_index(-1, texture_count);
    m.coat_texture = row.next_index(-1, texture_count);
    m.sheen_texture = row.next_index(-1, texture_count);
    m.sheen_roughness_texture = row.next_index(-1, texture_count);
    m.diffuse_roughness_texture = row.next_index(-1, texture_count);
    m.holdout = row.next_index(0, 2) == 1;
    if (m.mix_count > 0 && (m.mix_first < 0 || m.mix_first + m.mix_count > material_count))
        throw TableError("materials: a mixture of rows that are not there");
    return m;
}

}  // namespace

void set_materials(ShadingTables& tables, const Table& table) {
    check_columns(table, "materials", kMaterialFields);
    std::vector<Material> materials;
    EnergyTables energy;
    for (int64_t row = 0; row < table.rows; ++row) {
        materials.push_back(read_material({table, "materials", kMaterialFields, row}, table.rows,
                                          static_cast<int64_t>(tables.textures.textures.size())));
        prepare_material(&materials.back(), &energy);
    }
    tables.media_count = number_media(&materials);
    tables.boundary_energy = prepare_boundaries(materials, &energy);
    tables.materials.swap(materials);
    tables.energy = std::move(energy);
}

void set_background(ShadingTables& tables, float r, float g, float b) {
    if (!is_finite(Vec3{r, g, b})) throw TableError("world: expected finite numbers");
    tables.background = {r, g, b};
}

void set_environment(ShadingTables& tables, Environment environment) {
    for (size_t k = 0; k < environment.pixels.size(); ++k)
        if (!std::isfinite(environment.pixels[k]))
            throw TableError("environment: row " +
                             std::to_string(k / (3 * static_cast<size_t>(environment.width))) +
                             " has a number that is not finite");
    prepare_environment(&environment);
    tables.environment = std::move(environment);
}

namespace {

CameraPose read_pose(const double* m) {
    for (int k = 0; k < 12; ++k)
        if (!std::isfinite(m[k])) throw TableError("matrix: expected finite numbers");
    return {to_float(Vec3d{m[0], m[4], m[8]}), to_float(Vec3d{m[1], m[5], m[9]}),
            to_float(Vec3d{m[2], m[6], m[10]}), to_float(Vec3d{m[3], m[7], m[11]})};
}

}  // namespace

void set_camera_motion(ShadingTables& tables, const double* matrices, int64_t count) {
    std::vector<CameraPose> keys;
    for (int64_t k = 0; k < count; ++k) keys.push_back(read_pose(matrices + 12 * k));
    if (count < 2) keys.clear();
    tables.camera_keys.swap(keys);
}

void set_camera(ShadingTables& tables, const CameraRequest& request) {
    if (request.kind < 0 || request.kind > 2)
        throw TableError("kind: " + std::to_string(request.kind) + ", expected 0, 1 or 2");
    if (!(request.aperture >= 0.0 && request.aperture < 1e18))
        throw TableError("aperture: expected 0 or more");
    if (!(request.focus > 0.0 && request.focus < 1e30))
        throw TableError("focus: expected more than 0");
    if (!std::isfinite(request.blade_turn) || !(request.squeeze > 0.0 && request.squeeze < 1e6))
        throw TableError("blade_turn, squeeze: expected an angle and a positive number");
    for (int k = 0; k < 4; ++k)
        if (!std::isfinite(request.window[k])) throw TableError("window: expected finite numbers");
    if (!(request.clip_start >= 0.0 && request.clip_start < request.clip_end))
        throw TableError("clip_start: expected 0 <= clip_start < clip_end");
    const double* m = request.matrix;
    CameraView& c = tables.camera;
    c.kind = static_cast<CameraKind>(request.kind);
    c.aperture = c.kind == CameraKind::panorama ? 0.0f : static_cast<float>(request.aperture);
    c.focus = static_cast<float>(request.focus);
    c.blades = request.blades;
    c.blade_turn = static_cast<float>(request.blade_turn);
    c.squeeze = static_cast<float>(request.squeeze);
    c.pose = read_pose(m);
    tables.camera_keys.clear();
    c.left = static_cast<float>(request.window[0]);
    c.right = static_cast<float>(request.window[1]);
    c.bottom = static_cast<float>(request.window[2]);
    c.top = static_cast<float>(request.window[3]);
    c.clip_start = static_cast<float>(request.clip_start);
    c.clip_end = static_cast<float>(std::fmin(request.clip_end, 3.0e38));
    tables.has_camera = true;
}

}  // namespace trg

#include "scene/frozen_scene.h"

#include <algorithm>

namespace trg {

namespace {

template <class Item>
const Item* data_or_null(const std::vector<Item>& items) {
    return items.empty() ? nullptr : items.data();
}

}  // namespace

FrozenScene::FrozenScene(const Scene& scene) {
    if (!scene.tables.has_camera) throw TableError("camera: call set_camera before start_render");
    check_materials(scene);
    if (!scene.randoms.empty() && scene.randoms.size() != scene.world.instances.size())
        throw TableError("randoms: " + std::to_string(scene.randoms.size()) + " numbers, " +
                         std::to_string(scene.world.instances.size()) + " instances");
    for (size_t k = 0; k < scene.world.meshes.size(); ++k) {
        const Mesh& mesh = scene.world.meshes[k];
        const MeshAttributes& a = scene.attributes[k];
        meshes_.push_back({mesh.vertices.data(), mesh.triangles.data(), data_or_null(a.normals),
                           data_or_null(a.uvs), data_or_null(a.slots), mesh.shape});
    }
    check_textures(scene.tables.textures);
    view_images(scene);
    view_corners(scene);
    emitters_ = build_emitters(scene);
    view_.world = &scene.world;
    view_.meshes = meshes_.data();
    view_.instances = scene.world.instances.data();
    view_.motion_keys = scene.world.motion_keys.data();
    view_.camera_keys = scene.tables.camera_keys.data();
    view_.camera_key_count = static_cast<int32_t>(scene.tables.camera_keys.size());
    view_.timed = view_.camera_key_count > 0 || !scene.world.motion_keys.empty();
    view_.slot_materials = scene.slot_materials.data();
    view_.first_slot = scene.first_slot.data();
    view_.slot_count = scene.slot_count.data();
    view_.materials = scene.tables.materials.data();
    view_.energy = scene.tables.energy.values.data();
    const TextureTables& t = scene.tables.textures;
    view_.textures = {images_.data(), t.textures.data(), t.programs.data(), t.ops.data(),
                      t.constants.data()};
    view_.texture_meshes = texture_meshes_.data();
    view_.randoms = data_or_null(scene.randoms);
    view_visibility(scene);
    view_.antialiasing = scene.tables.antialiasing;
    view_.antialiasing.one_pattern = scene.tables.is_classic;
    view_.lights = scene.tables.lights.data();
    view_.light_count = static_cast<int32_t>(scene.tables.lights.size());
    view_.emitters = view_emitters(emitters_);
    view_.background = scene.tables.background;
    view_.environment = view_environment(scene.tables.environment);
    for (const Light& light : scene.tables.lights)
        view_.environment.has_suns = view_.environment.has_suns || light.seen;
    view_.camera = scene.tables.camera;
    view_.filter = data_or_null(scene.tables.filter);
    view_classic(scene.tables);
    features_ = find_features(scene);
    view_.see_through = (features_ & kSeeThrough) != 0;
    view_.nested = scene.tables.media_count > 1;
    view_.boundary_energy = scene.tables.boundary_energy.data();
    view_.media_count = scene.tables.media_count;
    const PassTables& p = scene.passes;
    passes_ = {{},
               data_or_null(p.instance_ids),
               data_or_null(p.material_ids),
               p.mist_start,
               p.mist_depth,
               p.mist_falloff,
               p.ambient_distance};
}

void FrozenScene::check_materials(const Scene& scene) const {
    const int64_t count = static_cast<int64_t>(scene.tables.materials.size());
    for (size_t k = 0; k < scene.slot_materials.size(); ++k)
        if (scene.slot_materials[k] < 0 || scene.slot_materials[k] >= count)
            throw TableError("slot_materials: material " + std::to_string(scene.slot_materials[k]) +
                             " of " + std::to_string(count) + " materials");
    if (!scene.world.instances.empty() && count == 0)
        throw TableError("materials: the scene has instances but no material");
    const int64_t textures = static_cast<int64_t>(scene.tables.textures.textures.size());
    for (const Material& m : scene.tables.materials)
        for (int32_t index :
             {m.base_texture, m.roughness_texture, m.metallic_texture, m.emission_texture,
              m.normal_texture, m.alpha_texture, m.weight_texture, m.transmission_texture,
              m.coat_texture, m.sheen_texture, m.sheen_roughness_texture,
              m.diffuse_roughness_texture})
            if (index >= textures)
                throw TableError(
                    "textures: the table was replaced by one too short for the materials");
}

void FrozenScene::view_visibility(const Scene& scene) {
    view_.held_out = data_or_null(scene.held_out);
    view_.sky_covers = scene.sky_covers;
    for (const Instance& instance : scene.world.instances)
        view_.masked = view_.masked || instance.mask != kEveryRay;
}

void FrozenScene::view_classic(const ShadingTables& tables) {
    // The paper's patterns fill the square of their pixel.
    if (tables.antialiasing.kind != Antialiasing::even) view_.filter = nullptr;
    if (!tables.is_classic) return;
    view_.camera.aperture = 0.0f;
    if (tables.classic.size() != tables.materials.size())
        throw TableError("classic: " + std::to_string(tables.classic.size()) + " rows, " +
                         std::to_string(tables.materials.size()) + " materials");
    view_.classic = tables.classic.data();
    view_.ambient = tables.ambient;
    for (const ClassicMaterial& m : tables.classic)
        if (max_component(m.refract) > 0.0f) view_.classic_passes_light = true;
}

void FrozenScene::view_images(const Scene& scene) {
    for (int k = 0; k < kDecodeSteps + 2; ++k)
        decode_[k] = srgb_to_linear(static_cast<float>(k) / kDecodeSteps);
    for (const Image& image : scene.tables.textures.images) {
        const PixelKind kind = !image.bytes.empty()    ? PixelKind::bytes
                               : !image.halves.empty() ? PixelKind::halves
                                                       : PixelKind::floats;
        const void* pixels = kind == PixelKind::bytes ? static_cast<const void*>(image.bytes.data())
                             : kind == PixelKind::halves
                                 ? static_cast<const void*>(image.halves.data())
                                 : image.floats.data();
        const bool encoded = image.srgb && kind != PixelKind::floats;
        images_.push_back({pixels, kind, encoded ? decode_.data() : nullptr, image.width,
                           image.height, image.channels});
    }
}

void FrozenScene::view_corners(const Scene& scene) {
    size_t count = 0;
    for (const MeshAttributes& a : scene.attributes) count += std::max<size_t>(a.corners.size(), 1);
    corners_.reserve(count);  // the meshes point into it
    for (size_t k = 0; k < scene.attributes.size(); ++k) {
        const MeshAttributes& a = scene.attributes[k];
        const CornerView* first = corners_.data() + corners_.size();
        corners_.push_back({data_or_null(a.uvs), 2});
        for (size_t number = 1; number < a.corners.size(); ++number)
            corners_.push_back({data_or_null(a.corners[number].values), a.corners[number].width});
        texture_meshes_.push_back({first,
                                   static_cast<int32_t>(std::max<size_t>(a.corners.size(), 1)),
                                   scene.world.meshes[k].shape, a.space_scale, a.space_offset});
    }
}

namespace {

/// Whether textures drive what only the larger kernel sets look up.
bool has_layer_textures(const Material& m) {
    return m.transmission_texture >= 0 || m.coat_texture >= 0 || m.sheen_texture >= 0 ||
           m.sheen_roughness_texture >= 0 || m.diffuse_roughness_texture >= 0;
}

}  // namespace

uint32_t FrozenScene::find_features(const Scene& scene) const {
    uint32_t features = 0;
    for (const Texture& texture : scene.tables.textures.textures)
        if (texture.program >= 0 || texture.uv_map > 0) features |= kPrograms;
    for (const Material& m : scene.tables.materials) {
        if (m.base_texture >= 0 || m.roughness_texture >= 0 || m.metallic_texture >= 0 ||
            m.emission_texture >= 0 || m.normal_texture >= 0 || m.alpha_texture >= 0 ||
            m.weight_texture >= 0)
            features |= kTextures;
        if (has_layer_textures(m)) features |= kTextures | kLayers;
        if (m.transmission > 0.0f || m.transmission_texture >= 0 || m.translucent)
            features |= kTransmission;
        if (m.mix_count > 0) features |= kMixtures;
        if (!is_black(m.absorption) || m.priority > 0.0f) features |= kMedia;
        if (m.coat > 0.0f || max_component(m.sheen) > 0.0f || m.diffuse_roughness > 0.0f)
            features |= kLayers;
        if (m.holdout) features |= kLimits;
        if (m.alpha < 1.0f || m.alpha_texture >= 0) features |= kSeeThrough;
    }
    for (const MeshAttributes& a : scene.attributes)
        if (!a.normals.empty()) features |= kSmoothNormals;
    if (!emitters_.extended.empty() || !emitters_.triangles.empty() || emitters_.endless ||
        emitters_.tree_has_extended)
        features |= kExtendedEmitters;
    if (!scene.tables.environment.pixels.empty()) features |= kEnvironment;
    if (view_.masked || view_.held_out) features |= kLimits;
    return features;
}

}  // namespace trg

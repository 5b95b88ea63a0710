#include "scene/frozen_scene.h"

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
    for (size_t k = 0; k < scene.world.meshes.size(); ++k) {
        const Mesh& mesh = scene.world.meshes[k];
        const MeshAttributes& a = scene.attributes[k];
        meshes_.push_back({mesh.vertices.data(), mesh.triangles.data(), data_or_null(a.normals),
                           data_or_null(a.uvs), data_or_null(a.slots), mesh.shape});
    }
    view_images(scene);
    emitters_ = build_emitters(scene);
    view_.world = &scene.world;
    view_.meshes = meshes_.data();
    view_.instances = scene.world.instances.data();
    view_.slot_materials = scene.slot_materials.data();
    view_.first_slot = scene.first_slot.data();
    view_.slot_count = scene.slot_count.data();
    view_.materials = scene.tables.materials.data();
    view_.textures = {images_.data(), scene.tables.textures.data()};
    view_.lights = scene.tables.lights.data();
    view_.emitters = view_emitters(emitters_);
    view_.background = scene.tables.background;
    view_.environment = view_environment(scene.tables.environment);
    view_.camera = scene.tables.camera;
    features_ = find_features(scene);
}

void FrozenScene::check_materials(const Scene& scene) const {
    const int64_t count = static_cast<int64_t>(scene.tables.materials.size());
    for (size_t k = 0; k < scene.slot_materials.size(); ++k)
        if (scene.slot_materials[k] < 0 || scene.slot_materials[k] >= count)
            throw TableError("slot_materials: material " + std::to_string(scene.slot_materials[k]) +
                             " of " + std::to_string(count) + " materials");
    if (!scene.world.instances.empty() && count == 0)
        throw TableError("materials: the scene has instances but no material");
    const int64_t textures = static_cast<int64_t>(scene.tables.textures.size());
    for (const Material& m : scene.tables.materials)
        for (int32_t index :
             {m.base_texture, m.roughness_texture, m.metallic_texture, m.emission_texture})
            if (index >= textures)
                throw TableError(
                    "textures: the table was replaced by one too short for the materials");
}

void FrozenScene::view_images(const Scene& scene) {
    for (int k = 0; k < 256; ++k) {
        plain_bytes_[k] = static_cast<float>(k) / 255.0f;
        srgb_bytes_[k] = srgb_to_linear(plain_bytes_[k]);
    }
    for (const Image& image : scene.tables.images)
        images_.push_back({data_or_null(image.bytes), data_or_null(image.floats),
                           image.srgb ? srgb_bytes_.data() : plain_bytes_.data(), image.width,
                           image.height, image.channels});
}

uint32_t FrozenScene::find_features(const Scene& scene) const {
    uint32_t features = 0;
    for (const Material& m : scene.tables.materials) {
        if (m.base_texture >= 0 || m.roughness_texture >= 0 || m.metallic_texture >= 0 ||
            m.emission_texture >= 0)
            features |= kTextures;
        if (m.transmission > 0.0f) features |= kTransmission;
    }
    for (const MeshAttributes& a : scene.attributes)
        if (!a.normals.empty()) features |= kSmoothNormals;
    if (!emitters_.extended.empty() || !emitters_.triangles.empty() || emitters_.endless)
        features |= kExtendedEmitters;
    if (!scene.tables.environment.pixels.empty()) features |= kEnvironment;
    return features;
}

}  // namespace trg

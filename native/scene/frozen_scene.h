/// A scene made ready for kernels: views of its tables, emitters, and what it needs of the kernels.
#pragma once

#include <array>
#include <vector>

#include "kernel/pass_list.h"
#include "scene/emitters.h"

namespace trg {

class FrozenScene {
  public:
    /// `scene` must be built and must outlive this. Throws TableError for a camera that was not set
    /// and for slots that name no material.
    explicit FrozenScene(const Scene& scene);
    FrozenScene(const FrozenScene&) = delete;
    FrozenScene& operator=(const FrozenScene&) = delete;

    const SceneView& view() const { return view_; }
    /// Everything but the layout.
    const PassView& passes() const { return passes_; }
    /// Union of Feature bits.
    uint32_t features() const { return features_; }

  private:
    void check_materials(const Scene& scene) const;
    void view_visibility(const Scene& scene);
    void view_classic(const ShadingTables& tables);
    void view_images(const Scene& scene);
    void view_corners(const Scene& scene);
    uint32_t find_features(const Scene& scene) const;

    std::array<float, kDecodeSteps + 2> decode_{};
    std::vector<MeshView> meshes_;
    std::vector<ImageView> images_;
    std::vector<CornerView> corners_;
    std::vector<TextureMesh> texture_meshes_;
    EmitterTables emitters_;
    SceneView view_{};
    PassView passes_{};
    uint32_t features_ = 0;
};

}  // namespace trg

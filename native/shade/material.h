/// Materials as kernels see them: plain records and indices.
#pragma once

#include <cstdint>

#include "shade/frame.h"

namespace trg {

/// One row of the material table, ready for use. Textures are indices or -1.
struct Material {
    Vec3 base;
    float metallic, roughness, ior, specular, transmission;
    float mean_fresnel;  // of `ior`, over the hemisphere
    Vec3 emission;
    float emission_weight;  // how much emitter sampling favours it; 0: does not emit
    int32_t base_texture, roughness_texture, metallic_texture, emission_texture;
    int32_t normal_texture;  // its value is a shading normal of the world
};

}  // namespace trg

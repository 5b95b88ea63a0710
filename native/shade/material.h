/// Materials as kernels see them: plain records and indices.
#pragma once

#include <cstdint>

#include "shade/frame.h"

namespace trg {

/// What a build of the kernels knows of lobes.
enum Lobe : uint32_t {
    kGlassLobe = 1,   // light passes the interface
    kLayerLobes = 2,  // coat, sheen and a rough diffuse base
};

/// Rows that one material may be a mixture of.
constexpr int32_t kMostClosures = 64;

/// How the dielectric interface of a material treats light.
enum class Interface : int32_t { clear, stained, refraction_only };

/// Where the tables of directional albedo of a material begin (shade/energy.h); -1: none.
struct EnergyIndex {
    int32_t facets;           // all reflecting facets
    int32_t outside, inside;  // the interface, seen from either side
    int32_t gloss;            // reflection of the opaque dielectric
    int32_t coat_facets, coat;
    int32_t rows;  // of each but the coat's: 1, or kEnergyRows where roughness varies
};

/// One row of the material table, ready for use. Textures are indices or -1.
struct Material {
    Vec3 base;
    float metallic, roughness, ior, specular, transmission;
    Vec3 emission;
    float emission_weight;  // how much emitter sampling favours it; 0: does not emit
    int32_t base_texture, roughness_texture, metallic_texture, emission_texture;
    int32_t normal_texture;  // its value is a shading normal of the world
    Vec3 specular_tint;
    float metal_grazing;  // 1: metal is white at grazing angles, 0: base colour everywhere
    float multiscatter;   // 1: facets pass on what single scattering loses
    Interface interface;
    float gloss_ior, gloss_mean;  // of the opaque dielectric, `specular` applied; its mean Fresnel
    Vec3 gloss_shift, glass_shift;  // reflectance is F + shift (1 - F)
    float diffuse_roughness;
    float coat, coat_alpha, coat_ior, coat_mean;
    Vec3 coat_tint, sheen;
    float sheen_roughness;
    float alpha;   // share of the surface that is there
    Vec3 through;  // colour of what passes the rest
    int32_t alpha_texture;
    bool translucent;              // the diffuse base shines on the far side
    int32_t mix_first, mix_count;  // the rows that this is a mixture of; count 0: none
    float weight;                  // as part of a mixture
    int32_t weight_texture;
    bool holdout;     // hides what is behind, from the camera alone, and shows nothing
    Vec3 absorption;  // per unit of length, of what the surface encloses
    float priority;   // of what it encloses, over other media; 0: none
    int32_t medium;   // number among those with priorities, from 1 on
    int32_t transmission_texture, coat_texture;
    int32_t sheen_texture;  // multiplies the sheen
    int32_t sheen_roughness_texture, diffuse_roughness_texture;
    EnergyIndex energy;
};

}  // namespace trg

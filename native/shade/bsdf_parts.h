/// A mixture taken apart for passes: which kind of lobe scatters, and the colours of each kind.
#pragma once

#include "shade/bsdf.h"

namespace trg {

/// Shares of light by the kind of scattering; transmission has the rest.
struct ScatterShares {
    Vec3 diffuse, glossy;
};

/// Albedos seen from `wo`. Diffuse holds the sheen, glossy every reflection, the coat's too.
struct LobeColors {
    Vec3 diffuse, glossy, transmission;
    Vec3 coat;
};

TRG_FN float share_of(float part, float whole) {
    return whole > 0.0f ? clamp01(part / whole) : 0.0f;
}

/// Who scatters from `wi` to wo; `delta` says that the direction is that of an ideal lobe.
template <uint32_t kLobes>
TRG_FN ScatterShares split_bsdf(const Bsdf& b, Vec3 wi, bool delta) {
    const Vec3 none{0.0f, 0.0f, 0.0f}, all{1.0f, 1.0f, 1.0f};
    if (!(wi.z > 0.0f)) return {none, none};
    if (delta) return {none, all};
    Vec3 diffuse = b.diffuse * (wi.z * kInvPi);
    if constexpr ((kLobes & kLayerLobes) != 0) {
        diffuse = b.diffuse * eval_rough_diffuse(b.rough, b.wo, wi);
        if (b.p_sheen > 0.0f) diffuse = diffuse + b.sheen_weight * eval_sheen(b.sheen, wi);
    }
    const Vec3 whole = eval_bsdf<kLobes>(b, wi).f_cos;
    const Vec3 share{share_of(diffuse.x, whole.x), share_of(diffuse.y, whole.y),
                     share_of(diffuse.z, whole.z)};
    return {share, all - share};
}

/// Albedo of the opaque dielectric's facets, by the tables in `energy` where they are rough.
TRG_FN Vec3 gloss_color(const Bsdf& b, const EnergyIndex& index, const float* energy) {
    if (b.smooth) return b.gloss * shifted(fresnel_dielectric(b.wo.z, b.gloss_ior), b.gloss_shift);
    const float roughness = std::sqrt(b.alpha);
    const Energy all = look_up_energy(energy + index.facets, index.rows, roughness, b.wo.z);
    const Energy some = look_up_energy(energy + index.gloss, index.rows, roughness, b.wo.z);
    return gloss_albedo(some, all, b.gloss_shift, b.gloss);
}

/// Albedo of metal: of its facets that reflect everything, by Fresnel at the shading normal.
TRG_FN Vec3 metal_color(const Bsdf& b, const EnergyIndex& index, const float* energy) {
    const Vec3 f = b.metal * fresnel_metal(b.metal_fresnel, b.wo.z);
    if (b.smooth) return f;
    return f * look_up_energy(energy + index.facets, index.rows, std::sqrt(b.alpha), b.wo.z).at;
}

TRG_FN Vec3 coat_color(const Bsdf& b, const EnergyIndex& index, const float* energy) {
    if (b.coat_smooth) return b.coat * fresnel_dielectric(b.wo.z, b.coat_ior);
    return b.coat * look_up_energy(energy + index.coat, 1, 0.0f, b.wo.z).at;
}

/// Adds both ways of the interface, by Fresnel at the shading normal; a little of each is always
/// left: facets may send light where the normal itself would not.
TRG_FN void add_glass_colors(const Bsdf& b, const Material& m, const float* energy, LobeColors* c) {
    const int32_t table = b.eta == m.ior ? m.energy.outside : m.energy.inside;
    const bool scaled = table >= 0 && !b.smooth && m.multiscatter > 0.0f && b.reflects;
    const float kept =
        scaled ? look_up_energy(energy + table, m.energy.rows, std::sqrt(b.alpha), b.wo.z).at
               : 1.0f;
    float g;
    const float f = smaller(larger(split_glass(b, b.wo.z, &g), 1e-3f), 1.0f - 1e-3f);
    c->glossy = c->glossy + b.glass * glass_reflectance(b, f) * kept;
    c->transmission = b.glass * glass_transmittance(b, f) * kept;
}

/// Albedos of the mixture of material `m`.
TRG_FN LobeColors lobe_colors(const Bsdf& b, const Material& m, const float* energy) {
    const Vec3 none{0.0f, 0.0f, 0.0f};
    LobeColors c{b.diffuse + b.sheen_weight, none, none, none};
    if (b.p_metal > 0.0f) c.glossy = metal_color(b, m.energy, energy);
    if (b.p_gloss > 0.0f) c.glossy = c.glossy + gloss_color(b, m.energy, energy);
    if (b.p_coat > 0.0f) c.coat = coat_color(b, m.energy, energy);
    c.glossy = c.glossy + c.coat;
    if (b.p_glass > 0.0f) add_glass_colors(b, m, energy, &c);
    return c;
}

}  // namespace trg

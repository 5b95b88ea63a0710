/// A mixture taken apart for passes: which kind of lobe scatters, and the colours of each kind.
#pragma once

#include "shade/bsdf.h"

namespace trg {

/// Shares of light by the kind of scattering; transmission has the rest.
struct ScatterShares {
    Vec3 diffuse, glossy;
};

/// Albedos seen from `wo`. Diffuse holds the sheen, glossy every reflection.
struct LobeColors {
    Vec3 diffuse, glossy, transmission;
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

/// Albedos of the mixture of material `m`; metal, coat and interface by Fresnel at the shading
/// normal, a little of each way of an interface always left: its facets may send light where the
/// normal itself would not.
TRG_FN LobeColors lobe_colors(const Bsdf& b, const Material& m, const float* energy) {
    LobeColors c{b.diffuse + b.sheen_weight, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
    if (b.p_metal > 0.0f) c.glossy = b.metal * fresnel_metal(b.metal_fresnel, b.wo.z);
    if (b.p_gloss > 0.0f) c.glossy = c.glossy + gloss_color(b, m.energy, energy);
    if (b.p_coat > 0.0f) c.glossy = c.glossy + b.coat * fresnel_dielectric(b.wo.z, b.coat_ior);
    if (b.p_glass > 0.0f) {
        float g;
        const float f = smaller(larger(split_glass(b, b.wo.z, &g), 1e-3f), 1.0f - 1e-3f);
        c.glossy = c.glossy + b.glass * glass_reflectance(b, f);
        c.transmission = b.glass * glass_transmittance(b, f);
    }
    return c;
}

}  // namespace trg

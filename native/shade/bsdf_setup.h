/// The surface model of docs/architecture.md, section 4, at one point seen from one direction: from
/// the material's numbers to weights of lobes. All directions are local to the shading normal (its
/// z) and point away from the surface; wo.z > 0.
#pragma once

#include "shade/bsdf_layers.h"
#include "shade/energy.h"
#include "shade/fresnel.h"
#include "shade/ggx.h"
#include "shade/material.h"

namespace trg {

/// The lobes at one point, seen from one direction. Weights hold what lies above a lobe.
struct Bsdf {
    Vec3 wo;
    Vec3 ng;                // geometric normal on the viewer's side, local
    float alpha, slope_wo;  // of the base's facets; slope_wo: ggx_slope(wo)
    bool smooth;            // the base's mirrors and interfaces are ideal
    bool thin_step;         // eta so near 1 that refraction can only be sampled
    bool reflects;          // the interface reflects
    bool turned;            // the diffuse base shines on the far side
    float eta;              // far side over near side, for the interface
    float gloss_ior;        // of the opaque dielectric, seen from outside
    MetalFresnel metal_fresnel;
    Vec3 metal, glass, gloss, diffuse;  // weights
    Vec3 reflected, passed;             // colours of the interface's two ways
    Vec3 glass_shift, gloss_shift;      // reflectance is F + shift (1 - F)
    RoughDiffuse rough;
    Vec3 coat, sheen_weight;
    float coat_alpha, coat_slope, coat_ior;
    bool coat_smooth;
    Sheen sheen;
    // How often each lobe is sampled.
    float p_metal, p_glass, p_gloss, p_diffuse, p_coat, p_sheen;
};

/// Where a point is looked at: local directions, whether the viewer is outside, and the tables that
/// EnergyIndex points into.
struct View {
    Vec3 wo, ng;
    bool outside;
    const float* energy;
};

TRG_FN Vec3 shifted(float fresnel, Vec3 shift) {
    const Vec3 f{fresnel, fresnel, fresnel};
    return f + shift * (1.0f - fresnel);
}

/// What a layer leaves for those below it: its largest channel counts for all.
TRG_FN float left_below(Vec3 albedo) {
    return clamp01(1.0f - max_component(albedo));
}

/// Albedo of facets that reflect F + shift (1 - F), their scale `factor` taken into account; `all`
/// is that of facets which reflect everything.
TRG_FN Vec3 gloss_albedo(Energy reflected, Energy all, Vec3 shift, Vec3 factor) {
    const Vec3 f{reflected.at, reflected.at, reflected.at};
    return (f + shift * (all.at - reflected.at)) * factor;
}

/// Sheen and coat; returns the colour by which they dim everything below.
TRG_FN Vec3 add_layers(const Material& m, const View& view, Bsdf* b) {
    Vec3 below{1.0f, 1.0f, 1.0f};
    b->sheen_weight = b->coat = {0.0f, 0.0f, 0.0f};
    if (max_component(m.sheen) > 0.0f) {
        b->sheen = make_sheen(view.wo, m.sheen_roughness);
        b->sheen_weight = m.sheen * b->sheen.albedo;
        below = below * left_below(b->sheen_weight);
    }
    if (!(m.coat > 0.0f)) return below;
    const Vec3 mean{m.coat_mean, m.coat_mean, m.coat_mean}, none{0.0f, 0.0f, 0.0f};
    b->coat_alpha = m.coat_alpha;
    b->coat_smooth = m.coat_alpha < kSmoothAlpha;
    Energy all{1.0f, 1.0f}, some{fresnel_dielectric(view.wo.z, m.coat_ior), 0.0f};
    if (!b->coat_smooth) {
        all = look_up_energy(view.energy + m.energy.coat_facets, 1, 0.0f, view.wo.z);
        some = look_up_energy(view.energy + m.energy.coat, 1, 0.0f, view.wo.z);
    }
    const Vec3 factor = energy_factor(all, mean);
    b->coat_slope = ggx_slope(view.wo, m.coat_alpha);
    b->coat_ior = m.coat_ior;
    b->coat = below * factor * m.coat;
    below = below * left_below(gloss_albedo(some, all, none, factor) * m.coat);
    // Beer's law along the ray bent into a coat of thickness 1.
    const float sine2 = (1.0f - view.wo.z * view.wo.z) / (m.coat_ior * m.coat_ior);
    const float way = 1.0f / std::sqrt(larger(1e-6f, 1.0f - sine2));
    const Vec3 stain{std::pow(m.coat_tint.x, way), std::pow(m.coat_tint.y, way),
                     std::pow(m.coat_tint.z, way)};
    return below * (stain * m.coat + Vec3{1.0f, 1.0f, 1.0f} * (1.0f - m.coat));
}

/// The facets of metal and opaque dielectric, and the diffuse base under the latter.
TRG_FN void add_base(const Material& m, const View& view, Vec3 metal, Vec3 opaque, Bsdf* b) {
    const Vec3 one{1.0f, 1.0f, 1.0f};
    const bool has_metal = m.metallic > 0.0f, has_gloss = m.gloss_ior != 1.0f && !is_black(opaque);
    b->metal = b->gloss = {0.0f, 0.0f, 0.0f};
    Energy all{1.0f, 1.0f};
    if ((has_metal || has_gloss) && !b->smooth)
        all = look_up_energy(view.energy + m.energy.facets, m.energy.rows, m.roughness, view.wo.z);
    if (has_metal) {
        b->metal_fresnel = make_metal_fresnel(m.base, m.specular_tint, m.metal_grazing);
        const Vec3 mean = mean_fresnel_metal(b->metal_fresnel);
        b->metal = metal * (m.multiscatter > 0.0f ? energy_factor(all, mean) : one);
    }
    if (has_gloss) {
        const Energy some = b->smooth ? Energy{fresnel_dielectric(view.wo.z, m.gloss_ior), 0.0f}
                                      : look_up_energy(view.energy + m.energy.gloss, m.energy.rows,
                                                       m.roughness, view.wo.z);
        const Vec3 factor =
            m.multiscatter > 0.0f ? energy_factor(all, shifted(m.gloss_mean, m.gloss_shift)) : one;
        b->gloss = opaque * factor;
        opaque = opaque * left_below(gloss_albedo(some, all, m.gloss_shift, factor));
    }
    b->diffuse = m.base * opaque;
    b->rough = make_rough_diffuse(m.base, view.wo.z, m.diffuse_roughness);
}

/// The interface that lets light through.
TRG_FN void add_glass(const Material& m, const View& view, Vec3 weight, Bsdf* b) {
    b->eta = view.outside ? m.ior : 1.0f / m.ior;
    b->thin_step = is_thin_step(b->alpha, b->eta);
    b->passed = {std::sqrt(m.base.x), std::sqrt(m.base.y), std::sqrt(m.base.z)};
    b->reflects = m.interface != Interface::refraction_only;
    b->reflected = m.interface == Interface::stained ? b->passed : Vec3{1.0f, 1.0f, 1.0f};
    b->glass_shift = m.glass_shift;
    b->glass = weight;
    const int32_t table = view.outside ? m.energy.outside : m.energy.inside;
    if (table < 0 || b->smooth || !(m.multiscatter > 0.0f) || !b->reflects) return;
    const Energy e = look_up_energy(view.energy + table, m.energy.rows, m.roughness, view.wo.z);
    b->glass = weight * energy_factor(e, b->passed);
}

/// Fills in how often each lobe is sampled; false when nothing is scattered.
TRG_FN bool choose_lobes(Bsdf* b) {
    const float c1 = 1.0f - b->wo.z;
    const float c5 = c1 > 0.0f ? c1 * c1 * c1 * c1 * c1 : 0.0f;
    const float base = luminance(b->metal_fresnel.f0);
    b->p_metal = luminance(b->metal) * (base + (1.0f - base) * larger(c5, 0.02f));
    b->p_glass = luminance(b->glass);
    b->p_gloss = luminance(b->gloss);
    if (b->p_gloss > 0.0f) b->p_gloss *= larger(fresnel_dielectric(b->wo.z, b->gloss_ior), 0.02f);
    b->p_diffuse = luminance(b->diffuse);
    b->p_coat = luminance(b->coat);
    if (b->p_coat > 0.0f) b->p_coat *= larger(fresnel_dielectric(b->wo.z, b->coat_ior), 0.02f);
    b->p_sheen = luminance(b->sheen_weight);
    const float sum =
        ((b->p_metal + b->p_glass) + (b->p_gloss + b->p_diffuse)) + (b->p_coat + b->p_sheen);
    if (!(sum > 0.0f)) return false;
    const float scale = 1.0f / sum;
    b->p_metal *= scale;
    b->p_glass *= scale;
    b->p_gloss *= scale;
    b->p_diffuse *= scale;
    b->p_coat *= scale;
    b->p_sheen *= scale;
    return true;
}

/// Sets up the lobes of `m`, whose base, metallic and roughness are those at the point. `kLobes` is
/// a union of Lobe bits. False when it scatters nothing.
template <uint32_t kLobes>
TRG_FN bool make_bsdf(const Material& m, const View& view, Bsdf* b) {
    b->wo = view.wo;
    b->ng = view.ng;
    b->alpha = m.roughness * m.roughness;
    b->smooth = b->alpha < kSmoothAlpha;
    b->slope_wo = ggx_slope(view.wo, b->alpha);
    b->turned = (kLobes & kGlassLobe) != 0 && m.translucent;
    b->gloss_ior = m.gloss_ior;
    b->gloss_shift = m.gloss_shift;
    b->metal_fresnel.f0 = m.base;
    Vec3 below{1.0f, 1.0f, 1.0f};
    if constexpr ((kLobes & kLayerLobes) != 0)
        below = add_layers(m, view, b);
    else
        b->sheen_weight = b->coat = {0.0f, 0.0f, 0.0f};
    const float passes = (kLobes & kGlassLobe) != 0 ? m.transmission : 0.0f;
    b->glass = {0.0f, 0.0f, 0.0f};
    if (passes > 0.0f) add_glass(m, view, below * ((1.0f - m.metallic) * passes), b);
    add_base(m, view, below * m.metallic, below * ((1.0f - m.metallic) * (1.0f - passes)), b);
    return choose_lobes(b);
}

}  // namespace trg

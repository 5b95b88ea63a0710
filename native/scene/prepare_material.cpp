#include "scene/prepare_material.h"

#include "shade/energy.h"
#include "shade/fresnel.h"
#include "shade/ggx.h"

namespace trg {

namespace {

/// By how much a coloured reflectance at normal incidence differs from that of `ior`: shifted() of
/// shade/bsdf_setup.h applies it.
Vec3 fresnel_shift(float ior, Vec3 tint) {
    const float f0 = f0_of_ior(ior);
    const auto channel = [f0](float t) { return (smaller(f0 * t, 1.0f) - f0) / (1.0f - f0); };
    return {channel(tint.x), channel(tint.y), channel(tint.z)};
}

/// The index whose reflectance at normal incidence is `specular` times that of `ior`.
float scaled_ior(float ior, float specular) {
    if (specular == 1.0f) return ior;
    if (specular == 0.0f) return 1.0f;
    const float scaled = ior_of_f0(f0_of_ior(ior) * specular);
    return ior < 1.0f ? 1.0f / scaled : scaled;
}

}  // namespace

void prepare_material(Material* m, EnergyTables* energy) {
    m->gloss_ior = scaled_ior(m->ior, m->specular);
    m->gloss_shift = fresnel_shift(m->gloss_ior, m->specular_tint);
    m->glass_shift = fresnel_shift(m->ior, m->specular_tint);
    const bool varies = m->roughness_texture >= 0;
    const bool metal = m->metallic > 0.0f || m->metallic_texture >= 0;
    const bool dielectric = m->metallic < 1.0f || m->metallic_texture >= 0;
    const bool gloss = dielectric && (m->transmission < 1.0f || m->transmission_texture >= 0) &&
                       m->gloss_ior != 1.0f;
    const bool glass =
        dielectric && (m->transmission > 0.0f || m->transmission_texture >= 0) && m->ior != 1.0f;
    const float roughness = varies ? -1.0f : m->roughness;
    EnergyIndex& e = m->energy;
    e = {-1, -1, -1, -1, -1, -1, varies ? kEnergyRows : 1};
    if (metal || gloss) e.facets = energy->add(EnergyKind::facets, 1.0f, roughness);
    if (gloss) {
        m->gloss_mean = mean_fresnel_dielectric(m->gloss_ior);
        e.gloss = energy->add(EnergyKind::gloss, m->gloss_ior, roughness);
    }
    if (glass) {
        e.outside = energy->add(EnergyKind::glass, m->ior, roughness);
        e.inside = energy->add(EnergyKind::glass, 1.0f / m->ior, roughness);
    }
    if (m->coat > 0.0f || m->coat_texture >= 0) {
        const float coat_roughness = std::sqrt(m->coat_alpha);
        m->coat_mean = mean_fresnel_dielectric(m->coat_ior);
        e.coat_facets = energy->add(EnergyKind::facets, 1.0f, coat_roughness);
        e.coat = energy->add(EnergyKind::gloss, m->coat_ior, coat_roughness);
    }
}

int32_t number_media(std::vector<Material>* materials) {
    int32_t count = 1;
    for (Material& m : *materials) m.medium = m.priority > 0.0f ? count++ : 0;
    return count;
}

std::vector<int32_t> prepare_boundaries(const std::vector<Material>& materials,
                                        EnergyTables* energy) {
    std::vector<const Material*> media{nullptr};
    for (const Material& m : materials)
        if (m.medium > 0) media.push_back(&m);
    std::vector<int32_t> tables;
    const auto index = [](const Material* m) { return m ? m->ior : 1.0f; };
    const auto rank = [](const Material* m) { return m ? m->priority : 0.0f; };
    const auto add = [&](const Material* here, const Material* there, bool enters) {
        const Material* owner = enters ? there : here;
        const bool needed = owner && rank(owner) >= rank(enters ? here : there) &&
                            (owner->transmission > 0.0f || owner->transmission_texture >= 0) &&
                            index(here) != index(there);
        if (!needed) return -1;
        const bool varies = owner->roughness_texture >= 0;
        if (!varies && owner->roughness * owner->roughness < kSmoothAlpha) return -1;
        return energy->add(EnergyKind::glass, index(there) / index(here),
                           varies ? -1.0f : owner->roughness);
    };
    for (const bool enters : {false, true})
        for (const Material* here : media)
            for (const Material* there : media) tables.push_back(add(here, there, enters));
    return tables;
}

}  // namespace trg

/// Values, densities and samples of the lobes that bsdf_setup.h weighed: a sheen, a coat, metal, an
/// interface, an opaque dielectric, and the diffuse base under it.
#pragma once

#include "shade/bsdf_setup.h"
#include "shade/sampler.h"

namespace trg {

/// Value times |cos wi|, and density, of everything that is not a delta.
struct BsdfValue {
    Vec3 f_cos;
    float pdf;
};

/// A direction to go on. `weight` is value times |cos| over density. pdf is 0 for a delta.
struct BsdfSample {
    Vec3 wi;
    Vec3 weight;
    float pdf;
};

/// Share of the interface that reflects at cosine `c`; `g` as fresnel_dielectric.
TRG_FN float split_glass(const Bsdf& b, float c, float* g) {
    const float f = fresnel_dielectric(c, b.eta, g);
    return b.reflects || *g == 0.0f ? f : 0.0f;
}

/// Colours by which a chosen way of the interface is weighed, beyond its share.
TRG_FN Vec3 glass_reflectance(const Bsdf& b, float f) {
    if (!b.reflects) return {0.0f, 0.0f, 0.0f};
    return b.reflected * shifted(f, b.glass_shift);
}
TRG_FN Vec3 glass_transmittance(const Bsdf& b, float f) {
    return b.passed * (Vec3{1.0f, 1.0f, 1.0f} - b.glass_shift) * (1.0f - f);
}

/// Metal, interface and opaque dielectric: facets of one roughness.
TRG_FN void add_facets(const Bsdf& b, Vec3 wi, BsdfValue* value) {
    const Vec3 h = normalize(b.wo + wi);
    const float c = clamp01(dot(b.wo, h));
    const float d = ggx_density(h, b.alpha);
    float f_glass = 0.0f, g;
    Vec3 f{0.0f, 0.0f, 0.0f};
    if (b.p_glass > 0.0f) {
        f_glass = split_glass(b, c, &g);
        f = b.glass * glass_reflectance(b, f_glass);
    }
    if (b.p_gloss > 0.0f)
        f = f + b.gloss * shifted(fresnel_dielectric(c, b.gloss_ior), b.gloss_shift);
    if (b.p_metal > 0.0f) f = f + b.metal * fresnel_metal(b.metal_fresnel, c);
    const float g2 = 2.0f / (b.slope_wo + ggx_slope(wi, b.alpha));
    value->f_cos = value->f_cos + f * (d * g2 / (4.0f * b.wo.z));
    value->pdf +=
        (b.p_metal + b.p_gloss + b.p_glass * f_glass) * d / (2.0f * b.wo.z * (1.0f + b.slope_wo));
}

/// Coat and sheen.
TRG_FN void add_layer_values(const Bsdf& b, Vec3 wi, BsdfValue* value) {
    if (b.p_sheen > 0.0f) {
        const float density = eval_sheen(b.sheen, wi);
        value->f_cos = value->f_cos + b.sheen_weight * density;
        value->pdf += b.p_sheen * density;
    }
    if (!(b.p_coat > 0.0f) || b.coat_smooth) return;
    const Vec3 h = normalize(b.wo + wi);
    const float d = ggx_density(h, b.coat_alpha);
    const float f = fresnel_dielectric(clamp01(dot(b.wo, h)), b.coat_ior);
    const float g2 = 2.0f / (b.coat_slope + ggx_slope(wi, b.coat_alpha));
    value->f_cos = value->f_cos + b.coat * (f * d * g2 / (4.0f * b.wo.z));
    value->pdf += b.p_coat * d / (2.0f * b.wo.z * (1.0f + b.coat_slope));
}

template <uint32_t kLobes>
TRG_FN BsdfValue eval_reflection(const Bsdf& b, Vec3 wi) {
    BsdfValue value{{0.0f, 0.0f, 0.0f}, b.p_diffuse * wi.z * kInvPi};
    if constexpr ((kLobes & kLayerLobes) != 0) {
        value.f_cos = b.diffuse * eval_rough_diffuse(b.rough, b.wo, wi);
        add_layer_values(b, wi, &value);
    } else {
        value.f_cos = b.diffuse * (wi.z * kInvPi);
    }
    if (!b.smooth && b.p_metal + b.p_glass + b.p_gloss > 0.0f) add_facets(b, wi, &value);
    return value;
}

/// Walter et al. 2007, equations 16, 17 and 21, for light that arrives from the far side.
TRG_FN BsdfValue eval_refraction(const Bsdf& b, Vec3 wi) {
    const BsdfValue nothing{{0.0f, 0.0f, 0.0f}, 0.0f};
    if (!(b.p_glass > 0.0f) || b.smooth || b.thin_step) return nothing;
    Vec3 h = normalize(b.wo + wi * b.eta);
    if (h.z < 0.0f) h = -h;
    const float c_o = dot(b.wo, h), c_i = dot(wi, h);
    if (!(c_o > 0.0f && c_i < 0.0f)) return nothing;
    const float sum = c_o + b.eta * c_i;
    const float jacobian = b.eta * b.eta * -c_i / (sum * sum);
    float g;
    const float f = split_glass(b, clamp01(c_o), &g);
    const float facets = c_o * jacobian * ggx_density(h, b.alpha) / b.wo.z;
    const float slope_wi = ggx_slope(wi, b.alpha);
    return {b.glass * glass_transmittance(b, f) * (facets * 2.0f / (b.slope_wo + slope_wi)),
            b.p_glass * (1.0f - f) * facets * 2.0f / (1.0f + b.slope_wo)};
}

/// The diffuse base of a surface that shines on the far side.
TRG_FN BsdfValue eval_translucent(const Bsdf& b, Vec3 wi) {
    if (!(wi.z < 0.0f && dot(b.ng, wi) < 0.0f)) return {{0.0f, 0.0f, 0.0f}, 0.0f};
    return {b.diffuse * (-wi.z * kInvPi), b.p_diffuse * -wi.z * kInvPi};
}

/// What is scattered from `wi` to wo by everything but deltas.
template <uint32_t kLobes>
TRG_FN BsdfValue eval_bsdf(const Bsdf& b, Vec3 wi) {
    if ((kLobes & kGlassLobe) != 0 && b.turned) return eval_translucent(b, wi);
    const float side = dot(b.ng, wi);
    if (wi.z > 0.0f && side > 0.0f) return eval_reflection<kLobes>(b, wi);
    if ((kLobes & kGlassLobe) != 0 && wi.z < 0.0f && side < 0.0f) return eval_refraction(b, wi);
    return {{0.0f, 0.0f, 0.0f}, 0.0f};
}

/// True when `wi` lies on the side of both normals that a reflection (or a refraction) must take.
TRG_FN bool on_right_side(const Bsdf& b, Vec3 wi, bool reflected) {
    return reflected == (wi.z > 0.0f) && reflected == (dot(b.ng, wi) > 0.0f);
}

/// The ideal mirror of metal and opaque dielectric together.
TRG_FN bool sample_mirror(const Bsdf& b, BsdfSample* sample) {
    sample->wi = {-b.wo.x, -b.wo.y, b.wo.z};
    sample->pdf = 0.0f;
    Vec3 f{0.0f, 0.0f, 0.0f};
    if (b.p_gloss > 0.0f)
        f = b.gloss * shifted(fresnel_dielectric(b.wo.z, b.gloss_ior), b.gloss_shift);
    if (b.p_metal > 0.0f) f = f + b.metal * fresnel_metal(b.metal_fresnel, b.wo.z);
    sample->weight = f * (1.0f / (b.p_metal + b.p_gloss));
    return on_right_side(b, sample->wi, true);
}

/// The interface at facet `h`. `is_done`: it is ideal, or its refraction can only be sampled.
TRG_FN bool sample_glass(const Bsdf& b, Vec3 h, float u, BsdfSample* sample, bool* is_done) {
    const float c = clamp01(dot(b.wo, h));
    float g;
    const float f = split_glass(b, c, &g);
    const bool reflected = u < f;
    const Vec3 wi = reflected ? h * (2.0f * c) - b.wo : normalize(h * (c - g) - b.wo);
    *is_done = b.smooth || (b.thin_step && !reflected);
    sample->wi = wi;
    // A facet that sends light through the surface ends the path: eval_bsdf would take the
    // direction for one of the other side, whose density does not count this way of finding it.
    if (reflected != (wi.z > 0.0f)) return false;
    if (!*is_done) return true;
    sample->pdf = 0.0f;
    const Vec3 way = reflected ? glass_reflectance(b, f) * (1.0f / f)
                               : glass_transmittance(b, f) * (1.0f / (1.0f - f));
    sample->weight = b.glass * way * (1.0f / b.p_glass);
    return on_right_side(b, wi, reflected);
}

/// The facets of the base: `lobe` chooses between interface and mirror. As sample_layers.
template <uint32_t kLobes>
TRG_FN bool sample_facets(const Bsdf& b, float lobe, Sample2 uv, BsdfSample* sample,
                          bool* is_done) {
    const float p_mirror = b.p_metal + b.p_gloss;
    const Vec3 h =
        b.smooth ? Vec3{0.0f, 0.0f, 1.0f} : sample_visible_normal(b.wo, b.alpha, uv.u, uv.v);
    if ((kLobes & kGlassLobe) != 0 && (lobe < b.p_glass || p_mirror == 0.0f))
        return sample_glass(b, h, smaller(lobe / b.p_glass, kBelowOne), sample, is_done);
    *is_done = b.smooth;
    if (b.smooth) return sample_mirror(b, sample);
    sample->wi = h * (2.0f * dot(b.wo, h)) - b.wo;
    return sample->wi.z > 0.0f;
}

/// The sheen where `lobe` is below its share, else the coat. False: absorbed. `is_done`: the sample
/// is a delta and complete, else only its direction is.
TRG_FN bool sample_layers(const Bsdf& b, float lobe, Sample2 uv, BsdfSample* sample,
                          bool* is_done) {
    *is_done = false;
    if (lobe < b.p_sheen || b.p_coat == 0.0f) {
        sample->wi = sample_sheen(b.sheen, uv.u, uv.v);
        return true;
    }
    *is_done = b.coat_smooth;
    if (b.coat_smooth) {
        sample->wi = {-b.wo.x, -b.wo.y, b.wo.z};
        sample->pdf = 0.0f;
        sample->weight = b.coat * (fresnel_dielectric(b.wo.z, b.coat_ior) / b.p_coat);
        return on_right_side(b, sample->wi, true);
    }
    const Vec3 h = sample_visible_normal(b.wo, b.coat_alpha, uv.u, uv.v);
    sample->wi = h * (2.0f * dot(b.wo, h)) - b.wo;
    return sample->wi.z > 0.0f;
}

/// A direction drawn from the mixture by `lobe` (which lobe) and `uv`. False: absorbed.
template <uint32_t kLobes>
TRG_FN bool sample_bsdf(const Bsdf& b, float lobe, Sample2 uv, BsdfSample* sample) {
    const float p_facets = b.p_glass + (b.p_metal + b.p_gloss), p_layers = b.p_coat + b.p_sheen;
    bool is_done = false;
    if (lobe < b.p_diffuse || p_facets + p_layers == 0.0f) {
        sample->wi = sample_cosine(uv.u, uv.v);
        if ((kLobes & kGlassLobe) != 0 && b.turned) sample->wi.z = -sample->wi.z;
    } else if ((kLobes & kLayerLobes) != 0 && (lobe - b.p_diffuse < p_layers || p_facets == 0.0f)) {
        if (!sample_layers(b, lobe - b.p_diffuse, uv, sample, &is_done)) return false;
    } else {
        const float rest = lobe - b.p_diffuse - p_layers;
        if (!sample_facets<kLobes>(b, rest, uv, sample, &is_done)) return false;
    }
    if (is_done) return true;
    const BsdfValue value = eval_bsdf<kLobes>(b, sample->wi);
    if (!(value.pdf > 0.0f) || !std::isfinite(value.pdf)) return false;
    sample->pdf = value.pdf;
    sample->weight = value.f_cos * (1.0f / value.pdf);
    return true;
}

}  // namespace trg

/// The surface model of docs/architecture.md, section 4: a mixture of a metal, a dielectric
/// interface and an opaque dielectric over diffuse. All directions are local to the shading normal
/// (its z) and point away from the surface; wo.z > 0.
#pragma once

#include "shade/fresnel.h"
#include "shade/ggx.h"
#include "shade/material.h"
#include "shade/sampler.h"

namespace trg {

/// The mixture at one point, seen from one direction.
struct Bsdf {
    Vec3 wo;
    Vec3 ng;                     // geometric normal on the viewer's side, local
    Vec3 f0;                     // base colour
    Vec3 diffuse;                // base / pi (1 - s F(wo)) / (1 - s Fbar), times its share
    Vec3 tint;                   // of refraction
    float alpha, slope_wo;       // slope_wo: ggx_slope(wo)
    float ior;                   // seen from outside, for the opaque dielectric
    float eta;                   // far side over near side, for the interface
    float specular;              // s
    float metal, glass, opaque;  // shares of the mixture, their sum is 1
    float p_metal, p_glass, p_gloss, p_diffuse;  // how often each lobe is sampled
    bool smooth;                                 // mirrors and interfaces are ideal
    bool thin_step;  // eta so near 1 that refraction can only be sampled
};

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

/// Fills in how often each lobe is sampled; false when nothing is scattered.
TRG_FN bool choose_lobes(Bsdf* b, float f_gloss) {
    const float c1 = 1.0f - b->wo.z;
    const float c5 = c1 > 0.0f ? c1 * c1 * c1 * c1 * c1 : 0.0f;
    const float base = luminance(b->f0);
    b->p_metal = b->metal * (base + (1.0f - base) * larger(c5, 0.02f));
    b->p_glass = b->glass;
    b->p_gloss = b->ior == 1.0f ? 0.0f : b->opaque * b->specular * larger(f_gloss, 0.02f);
    b->p_diffuse = luminance(b->diffuse) * kPi;
    const float sum = b->p_metal + b->p_glass + b->p_gloss + b->p_diffuse;
    if (!(sum > 0.0f)) return false;
    const float scale = 1.0f / sum;
    b->p_metal *= scale;
    b->p_glass *= scale;
    b->p_gloss *= scale;
    b->p_diffuse *= scale;
    return true;
}

/// Where a point is looked at: local directions, and whether the viewer is outside.
struct View {
    Vec3 wo, ng;
    bool outside;
};

/// Sets up the mixture of `m`, whose base, metallic and roughness are those at the point.
/// False when it scatters nothing.
template <bool kTransmission>
TRG_FN bool make_bsdf(const Material& m, const View& view, Bsdf* b) {
    b->wo = view.wo;
    b->ng = view.ng;
    b->f0 = m.base;
    b->alpha = m.roughness * m.roughness;
    b->smooth = b->alpha < kSmoothAlpha;
    b->slope_wo = ggx_slope(view.wo, b->alpha);
    b->ior = m.ior;
    b->specular = m.specular;
    b->metal = m.metallic;
    b->glass = kTransmission ? (1.0f - m.metallic) * m.transmission : 0.0f;
    b->opaque = (1.0f - m.metallic) * (1.0f - (kTransmission ? m.transmission : 0.0f));
    b->eta = view.outside ? m.ior : 1.0f / m.ior;
    b->thin_step = b->alpha * std::fabs(b->eta - 1.0f) < 1e-5f;
    b->tint = {std::sqrt(m.base.x), std::sqrt(m.base.y), std::sqrt(m.base.z)};
    const float f = b->opaque > 0.0f ? fresnel_dielectric(view.wo.z, m.ior) : 0.0f;
    const float left = 1.0f - m.specular * m.mean_fresnel;
    const float share = left > 0.0f ? b->opaque * (1.0f - m.specular * f) / left : 0.0f;
    b->diffuse = m.base * (share * kInvPi);
    return choose_lobes(b, f);
}

TRG_FN BsdfValue eval_reflection(const Bsdf& b, Vec3 wi) {
    const float left =
        1.0f - b.specular * (b.p_diffuse > 0.0f ? fresnel_dielectric(wi.z, b.ior) : 0.0f);
    BsdfValue value{b.diffuse * (left * wi.z), b.p_diffuse * wi.z * kInvPi};
    if (b.smooth || b.p_metal + b.p_glass + b.p_gloss == 0.0f) return value;
    const Vec3 h = normalize(b.wo + wi);
    const float c = clamp01(dot(b.wo, h));
    const float d = ggx_density(h, b.alpha);
    const float f_glass = b.p_glass > 0.0f ? fresnel_dielectric(c, b.eta) : 0.0f;
    const float f_gloss = b.p_gloss > 0.0f ? b.specular * fresnel_dielectric(c, b.ior) : 0.0f;
    const float shared = b.glass * f_glass + b.opaque * f_gloss;
    Vec3 f{shared, shared, shared};
    if (b.p_metal > 0.0f) f = f + fresnel_schlick(b.f0, c) * b.metal;
    const float g2 = 2.0f / (b.slope_wo + ggx_slope(wi, b.alpha));
    value.f_cos = value.f_cos + f * (d * g2 / (4.0f * b.wo.z));
    value.pdf +=
        (b.p_metal + b.p_gloss + b.p_glass * f_glass) * d / (2.0f * b.wo.z * (1.0f + b.slope_wo));
    return value;
}

/// Walter et al. 2007, equations 16, 17 and 21, for light that arrives from the far side.
TRG_FN BsdfValue eval_refraction(const Bsdf& b, Vec3 wi) {
    const BsdfValue nothing{{0.0f, 0.0f, 0.0f}, 0.0f};
    if (b.smooth || b.thin_step || !(b.p_glass > 0.0f)) return nothing;
    Vec3 h = normalize(b.wo + wi * b.eta);
    if (h.z < 0.0f) h = -h;
    const float c_o = dot(b.wo, h), c_i = dot(wi, h);
    if (!(c_o > 0.0f && c_i < 0.0f)) return nothing;
    const float sum = c_o + b.eta * c_i;
    const float jacobian = b.eta * b.eta * -c_i / (sum * sum);
    const float passed = (1.0f - fresnel_dielectric(clamp01(c_o), b.eta)) * c_o * jacobian *
                         ggx_density(h, b.alpha) / b.wo.z;
    const float slope_wi = ggx_slope(wi, b.alpha);
    return {b.tint * (b.glass * passed * 2.0f / (b.slope_wo + slope_wi)),
            b.p_glass * passed * 2.0f / (1.0f + b.slope_wo)};
}

/// What is scattered from `wi` to wo by everything but deltas.
template <bool kTransmission>
TRG_FN BsdfValue eval_bsdf(const Bsdf& b, Vec3 wi) {
    const float side = dot(b.ng, wi);
    if (wi.z > 0.0f && side > 0.0f) return eval_reflection(b, wi);
    if (kTransmission && wi.z < 0.0f && side < 0.0f) return eval_refraction(b, wi);
    return {{0.0f, 0.0f, 0.0f}, 0.0f};
}

/// One interface event at the microfacet normal `h`: `reflected` says which.
TRG_FN Vec3 refract_or_reflect(Vec3 wo, Vec3 h, float eta, float u, bool* reflected) {
    const float c = clamp01(dot(wo, h));
    float g;
    const float f = fresnel_dielectric(c, eta, &g);
    *reflected = u < f;
    if (*reflected) return h * (2.0f * c) - wo;
    return normalize(h * (c - g) - wo);
}

/// True when `wi` lies on the side of both normals that a reflection (or a refraction) must take.
TRG_FN bool on_right_side(const Bsdf& b, Vec3 wi, bool reflected) {
    return reflected == (wi.z > 0.0f) && reflected == (dot(b.ng, wi) > 0.0f);
}

/// An interface event that is a delta, or is treated as one (`thin_step`).
TRG_FN bool sample_glass_delta(const Bsdf& b, Vec3 wi, bool reflected, BsdfSample* sample) {
    const float weight = b.glass / b.p_glass;
    sample->pdf = 0.0f;
    sample->weight = reflected ? Vec3{weight, weight, weight} : b.tint * weight;
    return on_right_side(b, wi, reflected);
}

/// The ideal mirror of metal and opaque dielectric together.
TRG_FN bool sample_mirror(const Bsdf& b, BsdfSample* sample) {
    sample->wi = {-b.wo.x, -b.wo.y, b.wo.z};
    sample->pdf = 0.0f;
    const float gloss = b.opaque * b.specular * fresnel_dielectric(b.wo.z, b.ior);
    const Vec3 f = fresnel_schlick(b.f0, b.wo.z) * b.metal + Vec3{gloss, gloss, gloss};
    sample->weight = f * (1.0f / (b.p_metal + b.p_gloss));
    return on_right_side(b, sample->wi, true);
}

/// The interface alone: an ideal one, or one whose refraction can only be sampled.
TRG_FN bool sample_glass(const Bsdf& b, Vec3 h, float u, BsdfSample* sample, bool* is_done) {
    bool reflected;
    const Vec3 wi = refract_or_reflect(b.wo, h, b.eta, u, &reflected);
    *is_done = b.smooth || (b.thin_step && !reflected);
    sample->wi = wi;
    // A facet that sends light through the surface ends the path: eval_bsdf would take the
    // direction for one of the other side, whose density does not count this way of finding it.
    if (reflected != (wi.z > 0.0f)) return false;
    if (!*is_done) return true;
    if (!sample_glass_delta(b, wi, reflected, sample)) return false;
    if (!b.smooth)
        sample->weight =
            sample->weight * ((1.0f + b.slope_wo) / (b.slope_wo + ggx_slope(wi, b.alpha)));
    return true;
}

/// A direction drawn from the mixture by `lobe` (which lobe) and `uv`. False: absorbed.
template <bool kTransmission>
TRG_FN bool sample_bsdf(const Bsdf& b, float lobe, Sample2 uv, BsdfSample* sample) {
    const float p_mirror = b.p_metal + b.p_gloss;
    if (lobe < b.p_diffuse || b.p_glass + p_mirror == 0.0f) {
        sample->wi = sample_cosine(uv.u, uv.v);
    } else {
        lobe -= b.p_diffuse;
        const Vec3 h =
            b.smooth ? Vec3{0.0f, 0.0f, 1.0f} : sample_visible_normal(b.wo, b.alpha, uv.u, uv.v);
        const bool glass = kTransmission && (lobe < b.p_glass || p_mirror == 0.0f);
        if (glass) {
            bool is_done;
            const float u = smaller(lobe / b.p_glass, kBelowOne);
            if (!sample_glass(b, h, u, sample, &is_done)) return false;
            if (is_done) return true;
        } else if (b.smooth) {
            return sample_mirror(b, sample);
        } else {
            sample->wi = h * (2.0f * dot(b.wo, h)) - b.wo;
            if (!(sample->wi.z > 0.0f)) return false;
        }
    }
    const BsdfValue value = eval_bsdf<kTransmission>(b, sample->wi);
    if (!(value.pdf > 0.0f) || !std::isfinite(value.pdf)) return false;
    sample->pdf = value.pdf;
    sample->weight = value.f_cos * (1.0f / value.pdf);
    return true;
}

}  // namespace trg

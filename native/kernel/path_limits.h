/// What cuts paths short or makes them bring less than they found, as Cycles has it: bounces by
/// kind, surfaces passed straight through, clamped contributions, caustics. Only kernels of kLimits
/// do.
#pragma once

#include "kernel/direct_light.h"

namespace trg {

/// Paths at the camera.
TRG_FN void clear_limits(LimitQueues& queues, int32_t count) {
    for (int32_t path = 0; path < count; ++path)
        queues.states[path] = {kCameraRay, false, {0, 0, 0}, 0};
}

TRG_FN uint8_t mask_of(const PathQueues& queues, const PathState& state) {
    return queues.limits.states[state.path].kind;
}
TRG_FN uint8_t mask_of(const PathQueues&, const ShadowState&) {
    return kShadowRay;
}

/// `light` after so many scatterings, its channels together no more than the rules allow.
TRG_FN Vec3 clamp_light(const PathRules& rules, int32_t scatterings, Vec3 light, int64_t* clamped) {
    const float most = scatterings > 1 ? rules.clamp_indirect : rules.clamp_direct;
    const float sum = std::fabs(light.x) + std::fabs(light.y) + std::fabs(light.z);
    if (!(most > 0.0f && sum > most)) return light;
    ++*clamped;
    return light * (most / sum);
}

/// A path went straight through a surface. After one more than the rules say, it only looks at what
/// comes next.
TRG_FN void count_sheet(const PathRules& rules, PathLimits* path) {
    if (++path->sheets > rules.sheets) path->ended = true;
}

/// How many surfaces a shadow ray from the path may pass.
TRG_FN int32_t sheets_left(const PathRules& rules, const PathLimits& path) {
    return path.sheets < rules.sheets ? rules.sheets - path.sheets : 0;
}

/// The ways of scattering that bring no light to a path which came by a ray of `kind`.
TRG_FN uint8_t dark_ways(const PathRules& rules, uint8_t kind) {
    if (kind != kDiffuseRay) return 0;
    return static_cast<uint8_t>((rules.reflective ? 0 : kGlossyRay) |
                                (rules.refractive ? 0 : kTransmissionRay));
}

/// False for a path that only collects emission from here on; else `v` learns what is dark to it.
TRG_FN bool may_scatter(const PathRules& rules, const PathLimits& path, Vertex* v) {
    v->dark = dark_ways(rules, path.kind);
    return !path.ended;
}

/// Takes coat, metal and gloss from a material where reflections are dark, as if they had never
/// lain over what is below them. What an interface reflects or passes is left to lit_share.
TRG_FN void drop_caustics(Material* m, Vertex* v) {
    if (m->translucent) v->dark &= static_cast<uint8_t>(~kTransmissionRay);
    if (!(v->dark & kGlossyRay)) return;
    v->throughput = v->throughput * (1.0f - m->metallic);
    m->coat = m->metallic = 0.0f;
    m->gloss_ior = 1.0f;
}

/// Which kind of scattering `next` was: drawn by the shares of its value, `u` from 0 to 1.
template <uint32_t F>
TRG_FN int32_t draw_kind(const Vertex& v, const BsdfSample& next, float u) {
    const ScatterShares shares = split_bsdf<lobes_of(F)>(v.bsdf, next.wi, next.pdf == 0.0f);
    const Vec3 one{1.0f, 1.0f, 1.0f};
    const float place = u * dot(next.weight, one);
    const float diffuse = dot(next.weight, shares.diffuse);
    if (place < diffuse) return 0;
    return place < diffuse + dot(next.weight, shares.glossy) ? 1 : 2;
}

/// Notes the scattering of `v` along `next`; false where it brings no light.
template <uint32_t F>
TRG_FN bool count_scattering(const PathRules& rules, const Vertex& v, const BsdfSample& next,
                             PathLimits* path) {
    const int32_t kind = draw_kind<F>(v, next, sample_uniform2(v.key, v.dimension + kClosure).v);
    path->kind = static_cast<uint8_t>(kDiffuseRay << kind);
    if (path->kind & v.dark) return false;
    if (++path->used[kind] > rules.bounces[kind]) path->ended = true;
    return true;
}

}  // namespace trg

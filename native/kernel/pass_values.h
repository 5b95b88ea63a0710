/// What paths write for passes beside their light. Nothing here runs unless a pass was asked for.
#pragma once

#include "kernel/direct_light.h"
#include "shade/bsdf_parts.h"

namespace trg {

/// Facets count as diffuse for the denoising features the more, the nearer their alpha is to this,
/// and a surface writes its own features the more, the nearer its diffuse share is to the other; as
/// Cycles 5 does. All of its other light passes on to what its mirrors show.
constexpr float kFeatureAlpha = 0.15f, kFeatureShare = 0.5f;
constexpr uint32_t kAmbientDimension = 0x5a000000u;

TRG_FN void add_to_pass(PassQueues& passes, int32_t at, int32_t path, Vec3 value) {
    if (at < 0) return;
    float* to = passes.values + static_cast<int64_t>(path) * passes.stride + at;
    to[0] += value.x;
    to[1] += value.y;
    to[2] += value.z;
}

/// Empties the rows of `count` paths.
TRG_FN void clear_passes(const PassView& view, PassQueues& passes, int32_t count) {
    const int64_t floats = static_cast<int64_t>(count) * passes.stride;
    for (int64_t k = 0; k < floats; ++k) passes.values[k] = 0.0f;
    for (int32_t path = 0; path < count; ++path) {
        passes.states[path] = {{{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}}, {1.0f, 1.0f, 1.0f}};
        passes.hits[path] = {-1, -1};
        if (view.layout.at[kMistPass] >= 0)
            passes.values[static_cast<int64_t>(path) * passes.stride + view.layout.at[kMistPass]] =
                1.0f;
    }
}

/// A path whose light has been scattered so many times.
struct PathAt {
    int32_t path, scatterings;
};

/// Light that a path scattered first by `shares` brings home: direct after one scattering.
TRG_FN void note_scattered(const PassView& view, PassQueues& passes, const PathAt& end,
                           const ScatterShares& shares, Vec3 light) {
    const int32_t path = end.path;
    const int32_t* at = view.layout.at + (end.scatterings == 1 ? kDiffuseDirect : kDiffuseIndirect);
    const Vec3 rest = Vec3{1.0f, 1.0f, 1.0f} - shares.diffuse - shares.glossy;
    add_to_pass(passes, at[0], path, light * shares.diffuse);
    add_to_pass(passes, at[kGlossyDirect - kDiffuseDirect], path, light * shares.glossy);
    add_to_pass(passes, at[kTransmissionDirect - kDiffuseDirect], path, light * rest);
}

/// Light that surface or world `source` (a PassKind) at the end of a path's ray sends along it.
TRG_FN void note_source(const RenderView& view, PassQueues& passes, const PathAt& end,
                        PassKind source, Vec3 light) {
    const int32_t path = end.path;
    const PassLayout& layout = view.passes.layout;
    const Vec3 feature = passes.states[path].feature;
    if (layout.at[kDenoisingAlbedo] >= 0 && !is_black(feature)) {
        add_to_pass(passes, layout.at[kDenoisingAlbedo], path, feature * light);
    }
    if (end.scatterings == 0)
        add_to_pass(passes, layout.at[source], path, light);
    else if (layout.lights)
        note_scattered(view.passes, passes, end, passes.states[path].shares, light);
}

/// The ray that asks how open the hemisphere above `v` is; its state holds ~path.
TRG_FN void add_ambient_ray(const RenderView& view, const Vertex& v, ShadowQueue* queue) {
    const Sample2 uv = sample_uniform2(v.key, kAmbientDimension);
    const Vec3 wi = normalize(to_world(v.frame, sample_cosine(uv.u, uv.v)));
    if (!(dot(wi, v.ng) > 0.0f)) return;
    if (v.media[0]) queue->media[queue->count] = *v.media[0];
    queue->rays[queue->count] = {ray_origin(v.surface, v.ng, wi), 0.0f, wi,
                                 view.passes.ambient_distance};
    queue->states[queue->count++] = {{1.0f, 1.0f, 1.0f}, ~v.path};
}

/// 0 at `x` = 0, 1 from `x` = `end` on, smooth between.
TRG_FN float smooth_step(float x, float end) {
    const float t = clamp01(x / end);
    return t * t * (3.0f - 2.0f * t);
}

TRG_FN float mean_of(Vec3 v) {
    return (v.x + v.y + v.z) * (1.0f / 3.0f);
}

/// Albedo and normal of surfaces as far as they are not mirrors; mirrors pass them on, coloured.
TRG_FN void note_features(const RenderView& view, PassQueues& passes, const Vertex& v,
                          const LobeColors& colors) {
    Vec3& feature = passes.states[v.path].feature;
    const PassLayout& layout = view.passes.layout;
    const Vec3 facets = colors.glossy - colors.coat + colors.transmission;
    const float rough = smooth_step(v.bsdf.smooth ? 0.0f : v.bsdf.alpha, kFeatureAlpha);
    const bool coat_mirrors = !(v.bsdf.p_coat > 0.0f) || v.bsdf.coat_smooth;
    const float rough_coat = smooth_step(coat_mirrors ? 0.0f : v.bsdf.coat_alpha, kFeatureAlpha);
    const Vec3 broad = colors.diffuse + facets * rough + colors.coat * rough_coat;
    const Vec3 sharp = facets * (1.0f - rough) + colors.coat * (1.0f - rough_coat);
    const float whole = mean_of(broad + sharp);
    const float share = whole > 0.0f ? smooth_step(mean_of(broad) / whole, kFeatureShare) : 0.0f;
    // In the space of Cycles' camera, which looks along +Z.
    const CameraView& c = view.scene.camera;
    const Vec3 n = v.frame.n;
    add_to_pass(passes, layout.at[kDenoisingAlbedo], v.path, feature * broad * share);
    add_to_pass(passes, layout.at[kDenoisingNormal], v.path,
                Vec3{dot(n, c.pose.axis_x), dot(n, c.pose.axis_y), -dot(n, c.pose.axis_z)} *
                    (share * mean_of(feature)));
    const Vec3 rest = sharp * (1.0f - share);
    feature = max_component(rest) > 1e-4f ? feature * rest : Vec3{0.0f, 0.0f, 0.0f};
}

/// Place and ids of the surface that a camera ray met `distance` away.
TRG_FN void note_place(const RenderView& view, PassQueues& passes, int32_t path, const Surface& s,
                       float distance) {
    const PassView& p = view.passes;
    passes.hits[path] = {s.at.instance, s.material};
    add_to_pass(passes, p.layout.at[kUvPass], path, {s.u, s.v, 1.0f});
    if (p.layout.at[kMistPass] < 0) return;
    const float linear = clamp01((distance - p.mist_start) / p.mist_depth);
    passes.values[static_cast<int64_t>(path) * passes.stride + p.layout.at[kMistPass]] =
        p.mist_falloff == 1.0f ? linear : std::pow(linear, p.mist_falloff);
}

/// What stands at the vertex itself, before light is asked for.
TRG_FN void note_vertex(const RenderView& view, PassQueues& passes, const Vertex& v, int32_t depth,
                        ShadowQueue* shadows) {
    const PassLayout& layout = view.passes.layout;
    const bool wants_feature = layout.features && !is_black(passes.states[v.path].feature);
    if (depth > 0 && !wants_feature) return;
    if (layout.colors) {
        const LobeColors colors =
            lobe_colors(v.bsdf, view.scene.materials[v.row], view.scene.energy);
        if (depth == 0) {
            add_to_pass(passes, layout.at[kDiffuseColor], v.path, colors.diffuse);
            add_to_pass(passes, layout.at[kGlossyColor], v.path, colors.glossy);
            add_to_pass(passes, layout.at[kTransmissionColor], v.path, colors.transmission);
        }
        if (wants_feature) note_features(view, passes, v, colors);
    }
    if (depth == 0 && layout.at[kAmbientOcclusion] >= 0) add_ambient_ray(view, v, shadows);
}

/// Shares of the light that the shadow rays from `first` on would bring to the first surface.
template <uint32_t F>
TRG_FN void split_shadows(PassQueues& passes, const Vertex& v, int32_t first,
                          const ShadowQueue& shadows) {
    for (int32_t k = first; k < shadows.count; ++k)
        passes.shadow_shares[k] = split_bsdf<lobes_of(F)>(
            v.bsdf, to_local(v.frame, normalize(shadows.rays[k].direction)), false);
}

/// Light of shadow ray `k`, which was not stopped.
TRG_FN void note_shadow(const RenderView& view, PathQueues& queues, int32_t k, int32_t depth) {
    const ShadowState& state = queues.shadows[k];
    if (state.path < 0) {
        add_to_pass(queues.passes, view.passes.layout.at[kAmbientOcclusion], ~state.path,
                    state.light);
        return;
    }
    if (!view.passes.layout.lights) return;
    const ScatterShares& shares =
        depth == 0 ? queues.passes.shadow_shares[k] : queues.passes.states[state.path].shares;
    note_scattered(view.passes, queues.passes, {state.path, depth + 1}, shares, state.light);
}

}  // namespace trg

/// Shading of the classic integrator: ambient and emitted light, the mirrored and the refracted
/// ray, and the paper's lights with coloured shadows. docs/decisions/classic.md has the model.
#pragma once

#include "kernel/classic_light.h"
#include "kernel/classic_queues.h"
#include "kernel/shade_paths.h"

namespace trg {

/// A ray all of whose weights are below is not followed.
constexpr float kClassicCut = 1.0f / 256.0f;
/// A shadow ray that crosses more surfaces than these is stopped.
constexpr int32_t kMostCrossings = 256;

struct ClassicStage {
    const RenderView& view;
    PathQueues& queues;
    ClassicQueues& classic;
    RayCounts* counts;
    int32_t vertices;
};

/// The row of the surface's material, its base texture looked up.
template <uint32_t F>
TRG_FN ClassicMaterial classic_material_at(LookUp* look) {
    const int32_t index = look->surface.material;
    ClassicMaterial m = look->scene.classic[index];
    const int32_t texture = look->scene.materials[index].base_texture;
    if constexpr (has(F, kTextures))
        if (texture >= 0) {
            const Vec3 c = look_up<F>(look, texture);
            m.diffuse = Vec3{clamp01(c.x), clamp01(c.y), clamp01(c.z)} * m.texture_share;
        }
    return m;
}

/// Normals and material of `v`, whose surface and wo are there; true on the outer side.
template <uint32_t F>
TRG_FN bool face_vertex(const SceneView& scene, ClassicVertex* v) {
    const Surface& s = v->surface;
    const bool outside = dot(s.outside, v->wo) >= 0.0f;
    v->ng = outside ? s.outside : -s.outside;
    const Vec3 smooth = smooth_normal(scene, s);
    const Vec3 turned = outside ? smooth : -smooth;
    LookUp look{scene, s, v->wo, false, {}};
    v->ns = bent_normal<F>(&look, s.material, dot(v->wo, turned) > 1e-4f ? turned : v->ng);
    v->material = classic_material_at<F>(&look);
    return outside;
}

/// Share of light that is left after `way` through `media`.
TRG_FN float left_in(const SceneView& scene, const MediaStack& media, float way) {
    const int32_t ruler = ruling_medium(scene, media);
    return ruler < 0 ? 1.0f : share_left(scene.classic[ruler].decay, way);
}

/// Brings `*hit` to the first surface that is there, `*media` to what is in front of it.
template <uint32_t F>
TRG_FN Boundary find_boundary(const SceneView& scene, const Ray& ray, Hit* hit, MediaStack* media) {
    Boundary boundary;
    boundary.ratio = boundary.slack = 0.0f;
    if (!scene.nested) return boundary;
    for (int32_t k = 0; k < kMostCrossings; ++k)
        if (!pass_boundary<F>(scene, {ray, kMiddleTime}, {hit, media, &boundary})) break;
    return boundary;
}

/// What lies on both sides of the surface of `v`, before which `v->media` are as far as is known.
TRG_FN void find_sides(const SceneView& scene, const Boundary& boundary, bool outside,
                       ClassicVertex* v) {
    if (boundary.ratio > 0.0f) {
        v->beyond = boundary.beyond;
        v->ratio = boundary.ratio;
        v->surface.error = larger(v->surface.error, boundary.slack);
        return;
    }
    const int32_t material = v->surface.material;
    if (!outside) find_beginning(scene, material, &v->media);
    v->beyond = v->media;
    cross_surface(scene, material, outside, &v->beyond);
    v->ratio = index_of(scene, ruling_medium(scene, v->beyond)) /
               index_of(scene, ruling_medium(scene, v->media));
}

/// Queues `next` unless it weighs too little or lies too deep.
TRG_FN void push_ray(ClassicStage& stage, const PendingRay& next) {
    const bool kept = max_component(next.weight) >= kClassicCut &&
                      next.depth <= stage.view.max_bounces && next.depth <= kDeepestClassic &&
                      stage.classic.count < stage.classic.capacity;
    if (kept)
        stage.classic.pending[stage.classic.count++] = next;
    else if (!is_black(next.weight))
        ++stage.counts->cut;
}

TRG_FN Vec3 mirror_about(Vec3 wo, Vec3 n) {
    return n * (2.0f * dot(wo, n)) - wo;
}

/// Snell's law about `n`, on wo's side; false under total reflection. `ratio`: index of this side
/// over that of the far one.
TRG_FN bool refract_about(Vec3 wo, Vec3 n, float ratio, Vec3* wi) {
    const float c = dot(wo, n);
    const float k = 1.0f - ratio * ratio * (1.0f - c * c);
    if (!(k >= 0.0f)) return false;
    *wi = n * (ratio * c - std::sqrt(k)) - wo * ratio;
    return true;
}

/// Queues the ray that `from` sends on from `v` along `wi`.
TRG_FN void send_ray(ClassicStage& stage, const PendingRay& from, const ClassicVertex& v, Vec3 wi,
                     PendingRay next) {
    next.ray = {ray_origin(v.surface, v.ng, wi), 0.0f, normalize(wi), kFar};
    next.path = from.path;
    next.depth = from.depth + 1;
    push_ray(stage, next);
}

/// The paper's two rays. Where a smooth normal would send one to the wrong side, the flat one does.
TRG_FN void send_on(ClassicStage& stage, const PendingRay& from, const ClassicVertex& v) {
    const ClassicMaterial& m = v.material;
    Vec3 mirrored = mirror_about(v.wo, v.ns);
    if (!(dot(mirrored, v.ng) > 0.0f)) mirrored = mirror_about(v.wo, v.ng);
    PendingRay next{};
    next.weight = v.weight * m.reflect;
    next.media = v.media;
    if (!is_black(next.weight)) send_ray(stage, from, v, mirrored, next);
    next.weight = v.weight * m.refract;
    if (is_black(next.weight)) return;
    const float ratio = 1.0f / v.ratio;
    Vec3 wi;
    bool passes = refract_about(v.wo, v.ns, ratio, &wi);
    if (passes && !(dot(wi, v.ng) < 0.0f)) passes = refract_about(v.wo, v.ng, ratio, &wi);
    if (passes) next.media = v.beyond;
    send_ray(stage, from, v, passes ? wi : mirrored, next);
}

TRG_FN void add_light(PathQueues& queues, int32_t path, Vec3 light) {
    queues.results[path].radiance = queues.results[path].radiance + light;
}

/// What ray number `slot` of the batch has met.
template <uint32_t F>
TRG_FN void meet_surface(ClassicStage& stage, int32_t slot) {
    const SceneView& scene = stage.view.scene;
    const PendingRay from = stage.classic.batch[slot];
    Hit hit = stage.queues.hits[slot];
    MediaStack media = from.media;
    const Boundary boundary = find_boundary<F>(scene, from.ray, &hit, &media);
    if (hit.triangle < 0) {
        const Vec3 weight = from.weight * left_in(scene, media, kFar);
        add_light(stage.queues, from.path,
                  weight * world_seen<F>(scene, from.ray.direction, 0.0f, from.depth));
        return;
    }
    ClassicVertex& v = stage.classic.vertices[stage.vertices++];
    v.surface = surface_of_hit<F>(scene, {from.ray, kMiddleTime}, hit);
    v.wo = -normalize(from.ray.direction);
    v.path = from.path;
    v.media = media;
    const bool outside = face_vertex<F>(scene, &v);
    find_sides(scene, boundary, outside, &v);
    v.weight = from.weight * left_in(scene, v.media, hit.t);
    if (from.depth == 0) {
        stage.queues.results[v.path].hit = true;
        stage.queues.results[v.path].normal = v.ns;
    }
    add_light(
        stage.queues, v.path,
        v.weight * (eval_emission<F>(scene, v.surface, v.wo) + v.material.ambient * scene.ambient));
    send_on(stage, from, v);
}

/// What `v` sends to its viewer of light with irradiance `sample.light`: Phong's model about the
/// mirrored view ray, for lights whose colour is irradiance / pi.
TRG_FN Vec3 phong(const ClassicVertex& v, const LightSample& sample) {
    const float cosine = dot(v.ns, sample.wi);
    if (!(cosine > 0.0f) || !(dot(v.ng, sample.wi) > 0.0f)) return {0.0f, 0.0f, 0.0f};
    const float along = dot(mirror_about(v.wo, v.ns), sample.wi);
    const float gloss = along > 0.0f ? std::pow(along, v.material.power) : 0.0f;
    return (v.material.diffuse * cosine + v.material.specular * gloss) * sample.light * kInvPi;
}

/// Queues a shadow ray from each vertex to `light`; returns how many.
TRG_FN int32_t ask_light(ClassicStage& stage, const Light& light) {
    int32_t count = 0;
    for (int32_t k = 0; k < stage.vertices; ++k) {
        const ClassicVertex& v = stage.classic.vertices[k];
        LightSample sample;
        if (!light_from_middle(light, v.surface.position, &sample)) continue;
        const Vec3 sent = v.weight * phong(v, sample);
        if (is_black(sent)) continue;
        const float t_max = sample.distance < kFar ? sample.distance * 0.999998f : kFar;
        stage.queues.shadow_rays[count] = {ray_origin(v.surface, v.ng, sample.wi), 0.0f, sample.wi,
                                           t_max};
        stage.classic.shadows[count++] = {sent, v.media, v.path};
    }
    return count;
}

/// Light `shadow` where its ray has met a surface: tinted, and the ray goes on behind; or stopped.
template <uint32_t F>
TRG_FN bool pass_through(const SceneView& scene, const Hit& hit, Ray* ray, ClassicShadow* shadow,
                         const Boundary& boundary) {
    Surface s = surface_of_hit<F>(scene, {*ray, kMiddleTime}, hit);
    const ClassicMaterial& m = scene.classic[s.material];
    const bool entering = dot(s.outside, ray->direction) < 0.0f;
    if (!entering) find_beginning(scene, s.material, &shadow->media);
    shadow->light = shadow->light * m.refract * left_in(scene, shadow->media, hit.t);
    if (boundary.ratio > 0.0f) {
        shadow->media = boundary.beyond;
        s.error = larger(s.error, boundary.slack);
    } else {
        cross_surface(scene, s.material, entering, &shadow->media);
    }
    ray->origin = leave_surface(s, entering ? -s.outside : s.outside);
    if (ray->t_max < kFar) ray->t_max -= hit.t;
    return !is_black(shadow->light) && ray->t_max > 0.0f;
}

/// Coloured shadows: every surface on the way to the light tints it.
template <uint32_t F>
TRG_FN void add_tinted_light(ClassicStage& stage, int32_t count) {
    const SceneView& scene = stage.view.scene;
    PathQueues& queues = stage.queues;
    for (int32_t crossing = 0; count > 0 && crossing < kMostCrossings; ++crossing) {
        stage.counts->shadow += count;
        intersect_closest(*scene.world, queues.shadow_rays, queues.hits, count);
        int32_t left = 0;
        for (int32_t k = 0; k < count; ++k) {
            Ray ray = queues.shadow_rays[k];
            ClassicShadow shadow = stage.classic.shadows[k];
            Hit hit = queues.hits[k];
            const Boundary boundary = find_boundary<F>(scene, ray, &hit, &shadow.media);
            if (hit.triangle < 0) {
                add_light(queues, shadow.path,
                          shadow.light * left_in(scene, shadow.media, ray.t_max));
            } else if (pass_through<F>(scene, hit, &ray, &shadow, boundary)) {
                queues.shadow_rays[left] = ray;
                stage.classic.shadows[left++] = shadow;
            }
        }
        count = left;
    }
}

/// Shadows of a scene through which no light passes.
TRG_FN void add_plain_light(ClassicStage& stage, int32_t count) {
    PathQueues& queues = stage.queues;
    stage.counts->shadow += count;
    intersect_any(*stage.view.scene.world, queues.shadow_rays, queues.hidden, count);
    for (int32_t k = 0; k < count; ++k)
        if (!queues.hidden[k])
            add_light(queues, stage.classic.shadows[k].path, stage.classic.shadows[k].light);
}

}  // namespace trg

/// The shading stage: every living path meets its surface (or none), collects emission, asks for
/// light and goes on.
#pragma once

#include "kernel/nested_media.h"
#include "kernel/pass_values.h"
#include "kernel/path_limits.h"
#include "shade/horizon.h"

namespace trg {

/// Roulette begins at this surface; the camera sees surface 0.
constexpr int32_t kFirstRoulette = 2;

/// The stage's own view of its queues.
struct ShadeStage {
    const RenderView& view;
    PathQueues& queues;
    int32_t depth;  // surface number, 0 for the one that the camera sees
    ShadowQueue shadows;
    int32_t next_count;
};

/// How a path came here, and how light was drawn where it started.
struct Arrival {
    const Ray& ray;
    const Hit& hit;
    float pdf;        // of the ray's direction; 0 after a delta or from the camera
    Vec3 receiver;    // as PathQueues has it
    Vec3 absorption;  // per unit of length on the way
};

/// What `light`, drawn with chance `share`, adds to a bounce ray.
template <uint32_t F>
TRG_FN Vec3 gather_light(const Light& light, const Arrival& by, float share) {
    LightHit hit;
    const float t_end = by.hit.triangle >= 0 ? by.hit.t : kFar;
    if (!intersect_light(light, by.ray.origin, by.ray.direction, t_end, &hit))
        return {0.0f, 0.0f, 0.0f};
    if constexpr (has(F, kMedia))
        hit.radiance = hit.radiance * light_left(by.absorption, hit.distance);
    return hit.radiance * (by.pdf > 0.0f ? power_heuristic(by.pdf, share * hit.pdf) : 1.0f);
}

/// What the lights of the tree add to a bounce ray.
template <uint32_t F>
TRG_FN Vec3 gather_tree(const SceneView& scene, const Arrival& by) {
    const float t_end = by.hit.triangle >= 0 ? by.hit.t : kFar;
    struct Branch {
        int32_t node;
        float chance;
    };
    constexpr int kDeepest = 64;
    const LightTreeView& tree = scene.emitters.tree;
    Branch stack[kDeepest];
    int height = 0;
    stack[height++] = {0, tree.share};
    Vec3 sum{0.0f, 0.0f, 0.0f};
    while (height > 0) {
        const Branch at = stack[--height];
        const LightNode& node = tree.nodes[at.node];
        if (!ray_meets_node(node, by.ray.origin, by.ray.direction, t_end)) continue;
        if (node.second >= 0) {
            const float first = first_chance(tree, at.node, by.ray.origin, by.receiver);
            const bool dark = first < 0.0f;
            stack[height++] = {at.node + 1, dark ? 0.0f : at.chance * first};
            stack[height++] = {node.second, dark ? 0.0f : at.chance * (1.0f - first)};
            continue;
        }
        if (node.emitter >= 0 && scene.lights[node.emitter].extended)
            sum = sum + gather_light<F>(scene.lights[node.emitter], by, at.chance);
    }
    return sum;
}

/// What lights with extent add to a bounce ray.
template <uint32_t F>
TRG_FN Vec3 gather_lights(const SceneView& scene, const Arrival& by) {
    Vec3 sum{0.0f, 0.0f, 0.0f};
    const EmitterView& e = scene.emitters;
    for (int32_t k = 0; k < e.extended_count; ++k)
        sum = sum + gather_light<F>(scene.lights[e.extended[k]], by, e.extended_shares[k]);
    if (e.tree.has_extended) sum = sum + gather_tree<F>(scene, by);
    return sum;
}

/// What a camera ray along unit `wi` sees of suns that belong to the environment.
TRG_RARE_FN Vec3 suns_seen(const SceneView& scene, Vec3 wi) {
    Vec3 sum{0.0f, 0.0f, 0.0f};
    for (int32_t k = 0; k < scene.light_count; ++k) {
        LightHit hit;
        if (scene.lights[k].seen && scene.lights[k].extended &&
            intersect_light(scene.lights[k], scene.camera.pose.origin, wi, kFar, &hit))
            sum = sum + hit.radiance;
    }
    return sum;
}

/// What a ray that leaves the scene along `direction` (any length) sees of the world; `pdf` is the
/// density of a bounce ray's direction, `depth` 0 for a camera ray.
template <uint32_t F>
TRG_FN Vec3 world_seen(const SceneView& scene, Vec3 direction, float pdf, int32_t depth) {
    if constexpr (has(F, kEnvironment)) {
        const EnvironmentView& sky = scene.environment;
        if (!sky.pixels) return scene.background;
        if (depth == 0 && !sky.seen_by_camera) return {0.0f, 0.0f, 0.0f};
        const Vec3 wi = normalize(direction);
        const SkyPlace at = sky_place(sky, wi);
        if (depth == 0 && sky.has_suns) return eval_sky(sky, at) + suns_seen(scene, wi);
        const float weight =
            pdf > 0.0f && sky.sampled ? power_heuristic(pdf, pdf_sky(sky, at)) : 1.0f;
        return eval_sky(sky, at) * weight;
    }
    return scene.background;
}

/// How often the points of the emissive triangle hit are drawn, by area and unit of weight.
TRG_FN float triangle_density(const EmitterView& e, Vec3 p, const Hit& hit, Vec3 receiver) {
    if (!e.tree.nodes) return e.triangle_density;
    const int32_t first = e.tree.first_leaf[hit.instance];
    const int32_t leaf = first < 0 ? -1 : e.tree.leaves[first + hit.triangle];
    return leaf < 0 ? 0.0f : tree_chance(e.tree, leaf, p, receiver) / e.tree.nodes[leaf].power;
}

/// Emission of the surface met, weighted against the chance of sampling it as a light.
template <uint32_t F>
TRG_FN Vec3 emission_seen(const SceneView& scene, const Surface& s, const Arrival& by) {
    const Material& m = scene.materials[s.material];
    const Vec3 light = eval_emission<F>(scene, s, -normalize(by.ray.direction));
    if (!(by.pdf > 0.0f)) return light;
    const float cosine = std::fabs(dot(s.outside, by.ray.direction));
    const float chosen = triangle_density(scene.emitters, by.ray.origin, by.hit, by.receiver);
    if (!(cosine > 0.0f) || !(chosen > 0.0f)) return light;
    const float density = chosen * s.sampling * m.emission_weight;
    return light * power_heuristic(by.pdf, density * by.hit.t * by.hit.t / cosine);
}

/// Looks up the textures of what only the larger kernel sets have.
template <uint32_t F>
TRG_FN void look_up_layers(LookUp* look, Material* m) {
    const auto share = [&](int32_t texture, float* value) {
        if (texture >= 0) *value = clamp01(look_up<F>(look, texture).x);
    };
    share(m->transmission_texture, &m->transmission);
    share(m->coat_texture, &m->coat);
    share(m->sheen_roughness_texture, &m->sheen_roughness);
    share(m->diffuse_roughness_texture, &m->diffuse_roughness);
    if (m->sheen_texture >= 0) m->sheen = m->sheen * clamp01(look_up<F>(look, m->sheen_texture).x);
}

/// The material in `row` at the point, its textures looked up; `*room` holds one that they change.
template <uint32_t F>
TRG_FN const Material& material_at(LookUp* look, int32_t row, Material* room) {
    const Material& plain = look->scene.materials[row];
    if constexpr (has(F, kTextures)) {
        Material& m = *room = plain;
        if (m.base_texture >= 0) m.base = look_up<F>(look, m.base_texture);
        if (m.roughness_texture >= 0)
            m.roughness = clamp01(look_up<F>(look, m.roughness_texture).x);
        if (m.metallic_texture >= 0) m.metallic = clamp01(look_up<F>(look, m.metallic_texture).x);
        if constexpr (has(F, kLayers)) look_up_layers<F>(look, &m);
        m.base = {clamp01(m.base.x), clamp01(m.base.y), clamp01(m.base.z)};
        return m;
    }
    return plain;
}

/// The shading normal that the normal texture of the material in `row` asks for, on the viewer's
/// side, where it asks for one that the viewer can see; else `normal`.
template <uint32_t F>
TRG_FN Vec3 bent_normal(LookUp* look, int32_t row, Vec3 normal) {
    if constexpr (has(F, kPrograms)) {
        const int32_t texture = look->scene.materials[row].normal_texture;
        if (texture < 0) return normal;
        const Vec3 bent = normalize_safe(look_up<F>(look, texture));
        if (dot(look->wo, bent) > 1e-4f) return bent;
    }
    return normal;
}

/// Normals and lobes at the surface in `v`, seen along `wo`; false when it scatters nothing. Of a
/// mixture one row is drawn and the throughput set right.
/// `normal` receives the shading normal turned to the viewer.
template <uint32_t F>
TRG_FN bool make_vertex(const SceneView& scene, Vec3 wo, Vertex* v, Vec3* normal) {
    const Surface& s = v->surface;
    const float facing = dot(s.outside, wo);
    v->ng = facing < 0.0f ? -s.outside : s.outside;
    *normal = v->ng;
    if constexpr (has(F, kSmoothNormals)) {
        const Vec3 smooth = smooth_normal(scene, s);
        const Vec3 turned = facing < 0.0f ? -smooth : smooth;
        if (dot(wo, turned) > 1e-4f) *normal = turned;
    }
    LookUp look{scene, s, wo, false, {}, {}};
    int32_t row = s.material;
    if constexpr (has(F, kMixtures)) {
        float scale;
        row = choose_closure<F>(&look, sample_uniform2(v->key, v->dimension + kClosure).u, &scale);
        v->throughput = v->throughput * scale;
    }
    v->row = row;
    *normal = bent_normal<F>(&look, row, *normal);
    if (!(dot(wo, *normal) > 0.0f)) return false;
    Material room;
    const Material& m = material_at<F>(&look, row, &room);
    Vec3 up = *normal;
    if constexpr (has(F, kSmoothNormals) || has(F, kPrograms))
        if (has_facets(m)) up = bend_to_horizon(up, v->ng, wo);
    v->frame = make_frame(up);
    const View view{to_local(v->frame, wo), to_local(v->frame, v->ng), facing >= 0.0f,
                    scene.energy};
    if constexpr (has(F, kMedia) || has(F, kLimits)) {
        if (has(F, kLimits) || v->boundary) {
            Material changed = m;
            if constexpr (has(F, kMedia))
                if (v->boundary)
                    face_medium(*v->boundary, view.outside, row == s.material, &changed);
            if constexpr (has(F, kLimits)) drop_caustics(&changed, v);
            return make_bsdf<lobes_of(F)>(changed, view, &v->bsdf);
        }
    }
    return make_bsdf<lobes_of(F)>(m, view, &v->bsdf);
}

/// The path goes through the surface.
TRG_FN void enter_beyond(ShadeStage& stage, const Vertex& v) {
    MediaStack& media = stage.queues.media[v.path];
    if (v.media[1])
        media = *v.media[1];
    else
        cross_surface(stage.view.scene, v.surface.material, dot(v.ng, v.surface.outside) > 0.0f,
                      &media);
}

/// Draws the next direction and keeps the path if it survives roulette.
template <uint32_t F>
TRG_FN void continue_path(ShadeStage& stage, const Vertex& v) {
    const Sample2 choice = uniform_of_block(v.drawn, kLobe);
    const Sample2 uv = uniform_of_block(v.drawn, kDirection);
    BsdfSample next;
    if (!sample_bsdf<lobes_of(F)>(v.bsdf, choice.u, uv, &next)) return;
    Vec3 throughput = v.throughput * next.weight;
    if (stage.depth >= kFirstRoulette) {
        const float chance = std::sqrt(max_component(throughput));
        if (chance < 1.0f) {
            if (!(choice.v < chance)) return;
            throughput = throughput / chance;
        }
    }
    if (is_black(throughput)) return;
    if constexpr (has(F, kLimits))
        if (!count_scattering<F>(stage.view.rules, v, next, &stage.queues.limits.states[v.path]))
            return;
    const Vec3 wi = normalize(to_world(v.frame, next.wi));
    if constexpr (has(F, kMedia))
        if (dot(v.ng, wi) < 0.0f) enter_beyond(stage, v);
    const int32_t slot = stage.next_count++;
    stage.queues.rays[slot] = {ray_origin(v.surface, v.ng, wi), 0.0f, wi, kFar};
    stage.queues.states[slot] = {throughput, next.pdf, v.path};
    if (stage.view.scene.emitters.tree.nodes) stage.queues.receivers[v.path] = receiver_of<F>(v);
}

/// Light from the end of a path's ray: of the world or of a surface (`source`).
template <uint32_t F>
TRG_FN void add_light(const RenderView& view, PathQueues& queues, const PathAt& end,
                      PassKind source, Vec3 light) {
    PathResult& result = queues.results[end.path];
    if constexpr (has(F, kLimits))
        light = clamp_light(view.rules, end.scatterings, light, &queues.limits.clamped);
    result.radiance = result.radiance + light;
    if constexpr (has(F, kPasses)) note_source(view, queues.passes, end, source, light);
}

/// Asks for light at `v` and sends the path on.
template <uint32_t F>
TRG_FN void scatter_path(ShadeStage& stage, const Vertex& v) {
    const int32_t first_shadow = stage.shadows.count, first_path = stage.next_count;
    add_light_samples<F>(stage.view.scene, v, &stage.shadows);
    if constexpr (has(F, kPasses)) {
        if (stage.depth == 0 && stage.view.passes.layout.lights)
            split_shadows<F>(stage.queues.passes, v, first_shadow, stage.shadows);
        note_vertex(stage.view, stage.queues.passes, v, stage.depth, &stage.shadows);
    }
    continue_path<F>(stage, v);
    if constexpr (has(F, kPasses)) {
        if (stage.depth > 0 || stage.next_count == first_path) return;
        const Vec3 wi = to_local(v.frame, stage.queues.rays[first_path].direction);
        stage.queues.passes.states[v.path].shares =
            split_bsdf<lobes_of(F)>(v.bsdf, wi, stage.queues.states[first_path].pdf == 0.0f);
    }
}

/// What lies on the way to the surface and on both its sides.
template <uint32_t F>
TRG_FN void find_media(const ShadeStage& stage, const Ray& ray, Vertex* v) {
    const SceneView& scene = stage.view.scene;
    MediaStack& media = stage.queues.media[v->path];
    const bool outside = dot(v->surface.outside, ray.direction) <= 0.0f;
    if (!outside) find_beginning(scene, v->surface.material, &media);
    v->absorption[0] = absorption_of(scene, media);
    MediaStack beyond = media;
    if (scene.nested && stage.queues.boundaries[v->path].ratio > 0.0f) {
        v->boundary = &stage.queues.boundaries[v->path];
        beyond = v->boundary->beyond;
        v->surface.error = larger(v->surface.error, v->boundary->slack);
    } else {
        cross_surface(scene, v->surface.material, outside, &beyond);
    }
    v->absorption[1] = absorption_of(scene, beyond);
    if (!scene.nested) return;
    stage.queues.boundaries[v->path].beyond = beyond;
    v->media[0] = &media;
    v->media[1] = &stage.queues.boundaries[v->path].beyond;
}

/// One path at the end of its ray. Slots are written at or before the one being read.
template <uint32_t F>
TRG_FN void shade_path(ShadeStage& stage, int32_t slot) {
    const SceneView& scene = stage.view.scene;
    const Ray ray = stage.queues.rays[slot];
    const Hit hit = stage.queues.hits[slot];
    const PathState state = stage.queues.states[slot];
    const PathAt end{state.path, stage.depth};
    PathResult& result = stage.queues.results[state.path];
    Vertex v;
    v.path = state.path;
    v.throughput = state.throughput;
    v.media[0] = v.media[1] = nullptr;
    v.boundary = nullptr;
    const bool met = hit.triangle >= 0;
    if (met)
        v.surface =
            surface_of_hit<F>(scene, {ray, path_time(scene, stage.queues, state.path)}, hit);
    Arrival by{ray, hit, state.pdf, stage.queues.receivers[state.path], {0.0f, 0.0f, 0.0f}};
    if constexpr (has(F, kMedia)) {
        if (met) find_media<F>(stage, ray, &v);
        by.absorption =
            met ? v.absorption[0] : absorption_of(scene, stage.queues.media[state.path]);
        const float way = met ? hit.t * length(ray.direction) : kFar;
        v.throughput = v.throughput * light_left(by.absorption, way);
    }
    if constexpr (has(F, kExtendedEmitters))
        if (stage.depth > 0)
            add_light<F>(stage.view, stage.queues, end, kEmissionPass,
                         state.throughput * gather_lights<F>(scene, by));
    if (!met) {
        if constexpr (has(F, kLimits))
            result.hit = result.hit || (stage.depth == 0 && scene.sky_covers);
        add_light<F>(stage.view, stage.queues, end, kEnvironmentPass,
                     v.throughput * world_seen<F>(scene, ray.direction, state.pdf, stage.depth));
        return;
    }
    if constexpr (has(F, kLimits))
        if (stage.depth == 0 && scene.held_out && scene.held_out[hit.instance]) return;
    if (stage.depth == 0) result.hit = true;
    if constexpr (has(F, kExtendedEmitters))
        if (scene.materials[v.surface.material].emission_weight > 0.0f)
            add_light<F>(stage.view, stage.queues, end, kEmissionPass,
                         v.throughput * emission_seen<F>(scene, v.surface, by));
    if constexpr (has(F, kPasses))
        if (stage.depth == 0)
            note_place(stage.view, stage.queues.passes, state.path, v.surface,
                       hit.t * length(ray.direction));
    if (stage.depth > stage.view.max_bounces) return;
    if constexpr (has(F, kLimits))
        if (!may_scatter(stage.view.rules, stage.queues.limits.states[state.path], &v)) return;
    v.key = stage.queues.keys[state.path];
    v.dimension = kFirstBounceDimension + kDimensionsPerBounce * static_cast<uint32_t>(stage.depth);
    Vec3 normal;
    const bool scatters = make_vertex<F>(scene, -normalize(ray.direction), &v, &normal);
    if (stage.depth == 0) result.normal = normal;
    if constexpr (has(F, kLimits))
        if (stage.depth == 0 && scene.materials[v.row].holdout) result.hit = false;
    if (!scatters) return;
    draw_dimensions(v.key, v.dimension, &v.drawn);
    scatter_path<F>(stage, v);
}

}  // namespace trg

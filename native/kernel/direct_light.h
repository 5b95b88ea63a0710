/// Next-event estimation: shadow rays for the lights that always get one and for one of the pool.
#pragma once

#include "kernel/closures.h"
#include "kernel/media.h"
#include "shade/bsdf.h"

namespace trg {

/// Where a path scatters, ready for light and for the next direction.
struct Vertex {
    Surface surface;
    int32_t row;  // of the material, or the one drawn of a mixture
    Vec3 ng;      // geometric normal on the viewer's side
    Frame frame;  // around the shading normal on the viewer's side
    Bsdf bsdf;
    Vec3 throughput;
    Vec3 absorption[2];          // per unit of length, on the side of ng and beyond the surface
    const MediaStack* media[2];  // likewise, where media have priorities; else null
    const Boundary* boundary;    // between media with priorities, or null
    SampleKey key;
    uint32_t dimension;
    DimensionBlock drawn;  // of `dimension` and those after it
    int32_t path;
    uint8_t dark = 0;  // RayKinds of scattering that bring no light here
};

struct ShadowQueue {
    Ray* rays;
    ShadowState* states;
    int32_t count;
    MediaStack* media;  // where each starts, if media have priorities
};

/// Tells the next shadow ray, from `v` along `wi`, which media it starts in.
template <uint32_t F>
TRG_FN void tell_media(const Vertex& v, Vec3 wi, ShadowQueue* queue) {
    if constexpr (has(F, kMedia))
        if (v.media[0]) queue->media[queue->count] = *v.media[dot(v.ng, wi) < 0.0f];
}

/// Emission of the surface `s` towards `wo`.
template <uint32_t F>
TRG_FN Vec3 eval_emission(const SceneView& scene, const Surface& s, Vec3 wo) {
    const Material& m = scene.materials[s.material];
    if constexpr (has(F, kTextures))
        if (m.emission_texture >= 0) {
            LookUp look{scene, s, wo, false, {}, {}};
            return m.emission * look_up<F>(&look, m.emission_texture);
        }
    return m.emission;
}

/// Where a ray that leaves `s` along `wi` starts.
TRG_FN Vec3 ray_origin(const Surface& s, Vec3 ng, Vec3 wi) {
    return leave_surface(s, dot(ng, wi) > 0.0f ? ng : -ng);
}

/// Share of light that is left after `way` from `v` along `wi`.
template <uint32_t F>
TRG_FN Vec3 dimmed_to(const Vertex& v, Vec3 wi, float way) {
    if constexpr (has(F, kMedia)) return light_left(v.absorption[dot(v.ng, wi) < 0.0f], way);
    return {1.0f, 1.0f, 1.0f};
}

/// Share, by channel, of the light from `wi` that is scattered in ways among `kinds` that are lit.
template <uint32_t F>
TRG_FN Vec3 lit_share(const Vertex& v, Vec3 wi, uint8_t kinds) {
    const uint32_t lit = kinds & ~v.dark & kBounceRays;
    if (lit == kBounceRays) return {1.0f, 1.0f, 1.0f};
    const ScatterShares shares = split_bsdf<lobes_of(F)>(v.bsdf, to_local(v.frame, wi), false);
    const Vec3 rest = Vec3{1.0f, 1.0f, 1.0f} - shares.diffuse - shares.glossy;
    Vec3 sum{0.0f, 0.0f, 0.0f};
    if (lit & kDiffuseRay) sum = sum + shares.diffuse;
    if (lit & kGlossyRay) sum = sum + shares.glossy;
    if (lit & kTransmissionRay) sum = sum + rest;
    return sum;
}

/// Queues `sample` of an emitter that was chosen with chance `share`.
template <uint32_t F>
TRG_FN void queue_sample(const LightSample& sample, const Vertex& v, float share,
                         ShadowQueue* queue) {
    const BsdfValue f = eval_bsdf<lobes_of(F)>(v.bsdf, to_local(v.frame, sample.wi));
    const float weight =
        sample.pdf > 0.0f ? power_heuristic(share * sample.pdf, f.pdf) / share : 1.0f / share;
    Vec3 light = v.throughput * f.f_cos * sample.light * weight;
    if constexpr (has(F, kLimits)) light = light * lit_share<F>(v, sample.wi, kEveryRay);
    if constexpr (has(F, kMedia)) light = light * dimmed_to<F>(v, sample.wi, sample.distance);
    if (is_black(light)) return;
    // The last bit of the way is left out: geometry may touch the light.
    const float t_max = sample.distance < kFar ? sample.distance * 0.999998f : kFar;
    tell_media<F>(v, sample.wi, queue);
    queue->rays[queue->count] = {ray_origin(v.surface, v.ng, sample.wi), 0.0f, sample.wi, t_max};
    queue->states[queue->count++] = {light, v.path};
}

/// Queues what `emitter`, chosen with chance `share`, sends to `v`.
template <uint32_t F>
TRG_FN void add_light_sample(const Light& emitter, const Vertex& v, float share, Sample2 uv,
                             ShadowQueue* queue) {
    LightSample sample;
    if (sample_light(emitter, v.surface.position, uv, &sample))
        queue_sample<F>(sample, v, share, queue);
}

/// Queues what a direction drawn from the environment sends to `v`.
template <uint32_t F>
TRG_FN void add_sky_sample(const EnvironmentView& sky, const Vertex& v, ShadowQueue* queue) {
    uint32_t bits[2];
    sample_bits(v.key, v.dimension + kSkyLight, bits);
    LightSample sample;
    if (sample_sky(sky, bits, &sample)) queue_sample<F>(sample, v, 1.0f, queue);
}

/// An emissive triangle and how often its points are drawn, by area and unit of emission_weight.
struct TriangleChoice {
    EmissiveTriangle at;
    float density;
};

/// Queues what a random point of an emissive triangle sends to `v`.
template <uint32_t F>
TRG_FN void add_triangle_sample(const SceneView& scene, const Vertex& v,
                                const TriangleChoice& choice, Sample2 uv, ShadowQueue* queue) {
    const EmissiveTriangle& at = choice.at;
    const Surface s = sample_emitter<F>(scene, at, uv, v.surface.time);
    const Material& m = scene.materials[s.material];
    const bool in_front = dot(s.outside, v.surface.position - s.position) > 0.0f;
    const Vec3 target = leave_surface(s, in_front ? s.outside : -s.outside);
    const Vec3 to = target - v.surface.position;
    const float d2 = dot(to, to);
    const Vec3 wi = to / std::sqrt(d2);
    const float cosine = std::fabs(dot(s.outside, wi));
    if (!(d2 > 0.0f) || !(cosine > 0.0f)) return;
    const float pdf = choice.density * s.sampling * m.emission_weight * d2 / cosine;
    const BsdfValue f = eval_bsdf<lobes_of(F)>(v.bsdf, to_local(v.frame, wi));
    float scale = power_heuristic(pdf, f.pdf) / pdf;
    if constexpr (has(F, kSeeThrough)) scale *= alpha_of<F>(scene, s, -wi);
    Vec3 light = v.throughput * f.f_cos * eval_emission<F>(scene, s, -wi) * scale;
    if constexpr (has(F, kLimits))
        light = light * lit_share<F>(v, wi, scene.instances[at.instance].mask);
    if constexpr (has(F, kMedia)) light = light * dimmed_to<F>(v, wi, std::sqrt(d2));
    if (is_black(light)) return;
    const Vec3 origin = ray_origin(v.surface, v.ng, wi);
    tell_media<F>(v, wi, queue);
    queue->rays[queue->count] = {origin, 0.0f, target - origin, 1.0f};
    queue->states[queue->count++] = {light, v.path};
}

/// The normal of the side that light must come from to be scattered; null where it may be any.
template <uint32_t F>
TRG_FN Vec3 receiver_of(const Vertex& v) {
    if (has(F, kTransmission) && (v.bsdf.p_glass > 0.0f || v.bsdf.turned))
        return {0.0f, 0.0f, 0.0f};
    return v.frame.n;
}

/// Queues one sample of the emitters in the tree.
template <uint32_t F>
TRG_FN void add_tree_sample(const SceneView& scene, const Vertex& v, const uint32_t bits[2],
                            Sample2 uv, ShadowQueue* queue) {
    const LightTreeView& tree = scene.emitters.tree;
    const TreeChoice choice = sample_tree(tree, v.surface.position, receiver_of<F>(v), bits);
    if (!(choice.chance > 0.0f)) return;
    const LightNode& leaf = tree.nodes[choice.node];
    if (leaf.emitter >= 0) {
        add_light_sample<F>(scene.lights[leaf.emitter], v, choice.chance, uv, queue);
        return;
    }
    if constexpr (has(F, kExtendedEmitters))
        add_triangle_sample<F>(
            scene, v, {scene.emitters.triangles[~leaf.emitter], choice.chance / leaf.power}, uv,
            queue);
}

/// All light samples of one vertex.
template <uint32_t F>
TRG_FN void add_light_samples(const SceneView& scene, const Vertex& v, ShadowQueue* queue) {
    const EmitterView& e = scene.emitters;
    for (int32_t k = 0; k < e.always_count; ++k)
        add_light_sample<F>(scene.lights[e.always[k]], v, 1.0f,
                            uniform_of_block(v.drawn, kAlwaysLight + k), queue);
    if constexpr (has(F, kEnvironment))
        if (scene.environment.sampled) add_sky_sample<F>(scene.environment, v, queue);
    if (e.pool_count == 0) return;
    const Sample2 uv = uniform_of_block(v.drawn, kPoolPoint);
    uint32_t choice[2] = {v.drawn.first[kPoolChoice], v.drawn.second[kPoolChoice]};
    if (e.tree.nodes && e.pool_count == 1) {
        add_tree_sample<F>(scene, v, choice, uv, queue);
        return;
    }
    const int32_t entry = find_share(e.pool_limits, e.pool_count, choice[0]);
    if (e.pool[entry] >= 0) {
        add_light_sample<F>(scene.lights[e.pool[entry]], v, e.pool_shares[entry], uv, queue);
    } else if (e.tree.nodes) {
        sample_bits(v.key, v.dimension + kTreeChoice, choice);
        add_tree_sample<F>(scene, v, choice, uv, queue);
    } else {
        if constexpr (has(F, kExtendedEmitters)) {
            const int32_t k = find_share(e.triangle_limits, e.triangle_count, choice[1]);
            add_triangle_sample<F>(scene, v, {e.triangles[k], e.triangle_density}, uv, queue);
        }
    }
}

}  // namespace trg

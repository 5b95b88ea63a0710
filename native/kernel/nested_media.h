/// Media with priorities: where several overlap, one rules, and the boundaries of the others are
/// not there (Schmidt and Budge 2002, "Simple nested dielectrics in ray traced images"). Boundaries
/// that lie upon one another, as far as numbers can tell, count as one, so that a liquid may fill
/// its glass exactly.
#pragma once

#include "kernel/media.h"
#include "kernel/shape_surface.h"

namespace trg {

/// A hit, the media on the way to it and what lies at it; all are written.
struct MetMedia {
    Hit* hit;
    MediaStack* media;
    Boundary* boundary;
};

/// So many surfaces are looked at to find what a camera stands in.
constexpr int32_t kMostSurfacesAround = 4096;

/// Index of what fills a place ruled by `medium`.
TRG_FN float index_of(const SceneView& scene, int32_t medium) {
    if (medium < 0) return 1.0f;
    return scene.classic ? scene.classic[medium].ior : scene.materials[medium].ior;
}

TRG_FN float priority_of(const SceneView& scene, int32_t medium) {
    return medium < 0 ? 0.0f : scene.materials[medium].priority;
}

/// The surface at one hit among those that lie upon one another.
struct Coincident {
    Surface surface;
    float cosine;  // between the ray and its normal
};

/// Goes through the surface at `hit`, with `inside` the media before and `*beyond` those behind all
/// surfaces so far.
template <uint32_t F>
TRG_FN Coincident cross_one(const SceneView& scene, const TimedRay& ray, const Hit& hit,
                            MediaStack* inside, MediaStack* beyond) {
    Coincident one{surface_of_hit<F>(scene, ray, hit), 0.0f};
    const float along = dot(one.surface.outside, ray.ray.direction);
    one.cosine = std::fabs(along) / length(ray.ray.direction);
    bool known = along <= 0.0f;
    for (int32_t k = 0; k < beyond->count; ++k)
        known = known || beyond->materials[k] == one.surface.material;
    if (!known) {
        cross_surface(scene, one.surface.material, true, inside);
        cross_surface(scene, one.surface.material, true, beyond);
    }
    cross_surface(scene, one.surface.material, along <= 0.0f, beyond);
    return one;
}

TRG_FN bool has_priority(const SceneView& scene, const Hit& hit) {
    return hit.triangle >= 0 &&
           scene.materials[material_of(scene, {hit.instance, hit.triangle})].priority > 0.0f;
}

/// Surfaces that lie upon one another.
struct Pile {
    Hit hits[kMostMedia];
    float errors[kMostMedia];
    int32_t materials[kMostMedia];
    int32_t count;
};

TRG_FN void note_hit(const Hit& hit, const Surface& surface, Pile* pile) {
    pile->hits[pile->count] = hit;
    pile->errors[pile->count] = surface.error;
    pile->materials[pile->count++] = surface.material;
}

/// Which of them is that of `medium`; -1 for none.
TRG_FN int32_t find_surface(const Pile& pile, int32_t medium) {
    for (int32_t k = 0; k < pile.count; ++k)
        if (pile.materials[k] == medium) return k;
    return -1;
}

/// What boundary a ray from one ruling medium into another meets; `enters`: its surface is that of
/// the latter.
TRG_FN void describe_boundary(const SceneView& scene, int32_t here, int32_t there, bool enters,
                              Boundary* b) {
    b->ratio = index_of(scene, there) / index_of(scene, here);
    const int32_t row = here < 0 ? 0 : scene.materials[here].medium;
    const int32_t column = there < 0 ? 0 : scene.materials[there].medium;
    const int32_t table = (enters ? scene.media_count : 0) + row;
    b->energy = scene.boundary_energy[table * scene.media_count + column];
}

/// Looks at the boundary at `met.hit`, where a medium with a priority has its surface there. True
/// where it is none because the same medium rules on both sides: `met` is then what lies behind.
template <uint32_t F>
TRG_RARE_FN bool pass_boundary(const SceneView& scene, const TimedRay& ray, const MetMedia& met) {
    met.boundary->ratio = met.boundary->slack = 0.0f;
    const Hit first = *met.hit;
    if (!has_priority(scene, first)) return false;
    MediaStack beyond = *met.media;
    const Coincident face = cross_one<F>(scene, ray, first, met.media, &beyond);
    const float size = 1.0f / length(ray.ray.direction);
    const float reach =
        first.t * 1.0000005f + 4.0f * face.surface.error * size / larger(face.cosine, 0.02f);
    Pile pile{};
    note_hit(first, face.surface, &pile);
    Hit next = intersect_beyond(*scene.world, ray.ray, {ray.time, ray.mask}, first);
    while (pile.count < kMostMedia && next.t <= reach && has_priority(scene, next)) {
        note_hit(next, cross_one<F>(scene, ray, next, met.media, &beyond).surface, &pile);
        next = intersect_beyond(*scene.world, ray.ray, {ray.time, ray.mask}, next);
    }
    const int32_t here = ruling_medium(scene, *met.media), there = ruling_medium(scene, beyond);
    if (here == there) {
        *met.media = beyond;
        *met.hit = next;
        return true;
    }
    // The surface is that of the stronger of both.
    const float more = priority_of(scene, there) - priority_of(scene, here);
    const int32_t entered = find_surface(pile, there);
    const bool enters = more > 0.0f || (more == 0.0f && entered >= 0);
    const int32_t found = enters ? entered : find_surface(pile, here);
    const int32_t chosen = found < 0 ? 0 : found;
    *met.hit = pile.hits[chosen];
    for (int32_t k = 0; k < pile.count; ++k)
        met.boundary->slack =
            larger(met.boundary->slack,
                   pile.errors[k] + std::fabs(pile.hits[k].t - met.hit->t) * face.cosine / size);
    met.boundary->beyond = beyond;
    describe_boundary(scene, here, there, enters, met.boundary);
    return false;
}

/// What a camera at `origin` stands in: media whose surfaces a ray from there leaves without having
/// entered them, the nearest entered last.
template <uint32_t F>
TRG_RARE_FN MediaStack media_around(const SceneView& scene, Vec3 origin) {
    const TimedRay up{{origin, 0.0f, {0.0f, 0.0f, 1.0f}, kFar}, kMiddleTime};
    MediaStack around{}, entered{};
    Hit hit = no_hit();
    intersect_closest(*scene.world, &up.ray, &hit, 1);
    for (int32_t k = 0; k < kMostSurfacesAround && hit.triangle >= 0; ++k) {
        const Surface s = surface_of_hit<F>(scene, up, hit);
        const bool enters = dot(s.outside, up.ray.direction) <= 0.0f;
        const int32_t known = entered.count;
        cross_surface(scene, s.material, enters, &entered);
        if (!enters && entered.count == known) cross_surface(scene, s.material, true, &around);
        hit = intersect_beyond(*scene.world, up.ray, {up.time, up.mask}, hit);
    }
    for (int32_t k = 0; 2 * k + 1 < around.count; ++k) {
        const int32_t other = around.count - 1 - k, kept = around.materials[k];
        around.materials[k] = around.materials[other];
        around.materials[other] = kept;
    }
    return around;
}

/// Tells all paths of the queue what the camera stands in; rays of an orthographic one start
/// anywhere and are taken to start in nothing.
template <uint32_t F>
TRG_FN void begin_media(const SceneView& scene, PathQueues& queues, int32_t count) {
    if (scene.camera.kind == CameraKind::orthographic) return;
    const MediaStack around = media_around<F>(scene, scene.camera.pose.origin);
    for (int32_t k = 0; k < count; ++k) queues.media[k] = around;
}

/// Gives the interface of `m` the indices on both sides of `boundary`; `is_whole`: its facets are
/// those that tables were made for.
TRG_FN void face_medium(const Boundary& boundary, bool outside, bool is_whole, Material* m) {
    m->ior = outside ? boundary.ratio : 1.0f / boundary.ratio;
    if (!is_whole) return;
    if (outside)
        m->energy.outside = boundary.energy;
    else
        m->energy.inside = boundary.energy;
}

}  // namespace trg

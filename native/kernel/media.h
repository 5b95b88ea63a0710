/// What fills things: it absorbs by Beer's law on the way through. Where media overlap, those with
/// priorities give way to one of them (kernel/nested_media.h), the others add up.
#pragma once

#include "kernel/path_queues.h"

namespace trg {

/// The medium that rules where `media` overlap: of those with priorities the highest, of equal ones
/// the last that was entered; -1 where none has one. In the classic integrator every medium counts.
TRG_FN int32_t ruling_medium(const SceneView& scene, const MediaStack& media) {
    int32_t ruler = -1;
    float most = 0.0f;
    for (int32_t k = 0; k < media.count; ++k) {
        const float priority = scene.materials[media.materials[k]].priority;
        if (!(priority > 0.0f || scene.classic) || !(priority >= most)) continue;
        ruler = media.materials[k];
        most = priority;
    }
    return ruler;
}

/// Absorption per unit of length of all that a path is in and that counts.
TRG_FN Vec3 absorption_of(const SceneView& scene, const MediaStack& media) {
    const int32_t ruler = scene.nested ? ruling_medium(scene, media) : -1;
    Vec3 sum{0.0f, 0.0f, 0.0f};
    if (ruler >= 0) sum = scene.materials[ruler].absorption;
    for (int32_t k = 0; k < media.count; ++k) {
        const Material& m = scene.materials[media.materials[k]];
        if (!(m.priority > 0.0f)) sum = sum + m.absorption;
    }
    return sum;
}

TRG_FN float share_left(float absorption, float way) {
    return absorption > 0.0f ? std::exp(-absorption * way) : 1.0f;
}

/// Share of light that is left after `way` through something of `absorption`.
TRG_FN Vec3 light_left(Vec3 absorption, float way) {
    return {share_left(absorption.x, way), share_left(absorption.y, way),
            share_left(absorption.z, way)};
}

/// Whether rays are told of what surfaces of `material` enclose.
TRG_FN bool tells_media(const SceneView& scene, int32_t material) {
    const Material& m = scene.materials[material];
    if (scene.classic) return max_component(scene.classic[material].refract) > 0.0f;
    return !is_black(m.absorption) || m.priority > 0.0f;
}

/// A path goes through a surface of `material` to its inside, or out of it.
TRG_FN void cross_surface(const SceneView& scene, int32_t material, bool enters,
                          MediaStack* media) {
    if (!tells_media(scene, material)) return;
    if (enters) {
        if (media->count < kMostMedia) media->materials[media->count++] = material;
        return;
    }
    int32_t last = media->count - 1;
    while (last >= 0 && media->materials[last] != material) --last;
    if (last < 0) return;
    for (int32_t k = last; k + 1 < media->count; ++k) media->materials[k] = media->materials[k + 1];
    --media->count;
}

/// Tells a path that met the inside of a medium which it never entered that it began there.
TRG_FN void find_beginning(const SceneView& scene, int32_t material, MediaStack* media) {
    for (int32_t k = 0; k < media->count; ++k)
        if (media->materials[k] == material) return;
    cross_surface(scene, material, true, media);
}

}  // namespace trg

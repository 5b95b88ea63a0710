/// What fills things: it absorbs by Beer's law on the way through. Media that overlap add up.
#pragma once

#include "kernel/path_queues.h"

namespace trg {

/// Absorption per unit of length of all that a path is in.
TRG_FN Vec3 absorption_of(const SceneView& scene, const MediaStack& media) {
    Vec3 sum{0.0f, 0.0f, 0.0f};
    for (int32_t k = 0; k < media.count; ++k)
        sum = sum + scene.materials[media.materials[k]].absorption;
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

/// A path goes through a surface of `material` to its inside, or out of it.
TRG_FN void cross_surface(const SceneView& scene, int32_t material, bool enters,
                          MediaStack* media) {
    if (is_black(scene.materials[material].absorption)) return;
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

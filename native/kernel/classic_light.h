/// Lights of the classic integrator: every light shines from its middle.
#pragma once

#include "shade/lights.h"

namespace trg {

/// Direction to `light` from `p`, and its irradiance on a surface there that faces it; false when
/// nothing arrives.
TRG_FN bool light_from_middle(const Light& light, Vec3 p, LightSample* sample) {
    sample->pdf = 0.0f;
    if (light.kind == LightKind::sun) {
        sample->wi = light.direction;
        sample->distance = kFar;
        sample->light = light.color * (light.extended ? light.solid_angle : 1.0f);
        return true;
    }
    const Vec3 to = light.position - p;
    const float d2 = dot(to, to);
    if (!(d2 > 0.0f)) return false;
    sample->distance = std::sqrt(d2);
    sample->wi = to / sample->distance;
    if (light.kind == LightKind::point || light.kind == LightKind::spot) {
        // The colour of a sphere is its radiance.
        const float size = light.extended ? kPi * light.radius * light.radius : 1.0f;
        sample->light = light.color * (size * eval_falloff(light, sample->distance) *
                                       eval_spot(light, -sample->wi));
        return true;
    }
    const float cosine = -dot(sample->wi, light.direction);
    if (!(cosine > 0.0f)) return false;
    sample->light = light.color * (light.area * cosine * eval_spread(light, cosine) / d2);
    return true;
}

}  // namespace trg

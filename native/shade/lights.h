/// Lights as kernels see them: how they are sampled from a point, and what a bounce ray sees of
/// them.
#pragma once

#include "shade/rectangle_light.h"

namespace trg {

enum class LightKind : int32_t { sun, point, spot, rectangle, ellipse };

/// One light. `color` is what the estimate needs: irradiance of a delta sun, radiance of anything
/// with extent, intensity of a delta point, irradiance at distance 0 under a falloff.
struct Light {
    LightKind kind;
    bool extended;        // seen by bounce rays; otherwise a delta
    bool inverse_square;  // false: the falloff coefficients hold
    Vec3 color;
    Vec3 position;
    Vec3 direction;       // sun: towards the light; others: along which it shines; unit
    Vec3 axis_u, axis_v;  // half axes
    float radius;
    float area;            // rectangle, ellipse
    float near2;           // rectangle, ellipse: squared distance below which it is seen as large
    float half_u, half_v;  // lengths of the half axes
    float solid_angle;     // sun
    float chord2;          // sun: squared chord from the centre of the disc to its rim
    float cos_outer, cos_inner;
    float falloff[3];
    bool soft;    // point, spot: a disc that faces whoever it lights
    bool seen;    // sun: by the camera too, where it sees the environment
    bool spread;  // area: shines into a cone only
    float spread_tangent, spread_scale;
};

/// A direction towards a light. `light` is radiance over density (or, for a delta, irradiance on a
/// surface facing it); pdf is by solid angle, 0 for a delta.
struct LightSample {
    Vec3 wi;
    float distance;
    Vec3 light;
    float pdf;
};

constexpr float kFar = 3.0e38f;

/// Share of a spot's intensity along `travel`, the unit direction of the light.
TRG_FN float eval_spot(const Light& light, Vec3 travel) {
    if (light.kind != LightKind::spot) return 1.0f;
    const float above = dot(light.direction, travel) - light.cos_outer;
    const float width = light.cos_inner - light.cos_outer;
    if (!(width > 0.0f)) return above > 0.0f ? 1.0f : 0.0f;
    const float t = clamp01(above / width);
    return t * t * (3.0f - 2.0f * t);
}

/// Share of an area light's radiance that leaves it at `cosine` to its axis.
TRG_FN float eval_spread(const Light& light, float cosine) {
    if (!light.spread) return 1.0f;
    const float tangent = std::sqrt(larger(0.0f, 1.0f - cosine * cosine)) / cosine;
    return larger(light.spread_tangent - tangent, 0.0f) * light.spread_scale;
}

/// Half of the unit cone of squared chord `chord2` around `axis`, uniform by solid angle.
TRG_FN Vec3 sample_cone(Vec3 axis, float chord2, Sample2 uv) {
    const float drop = 0.5f * chord2 * uv.u;  // 1 - cos
    const float sine = std::sqrt(larger(0.0f, drop * (2.0f - drop)));
    const SineCosine phi = sine_cosine_of_turn(uv.v);
    return to_world(make_frame(axis), {sine * phi.cosine, sine * phi.sine, 1.0f - drop});
}

TRG_FN bool sample_sun(const Light& light, Sample2 uv, LightSample* sample) {
    sample->distance = kFar;
    sample->wi = light.direction;
    sample->light = light.color;
    sample->pdf = 0.0f;
    if (!light.extended) return true;
    sample->wi = sample_cone(light.direction, light.chord2, uv);
    sample->pdf = 1.0f / light.solid_angle;
    sample->light = light.color * light.solid_angle;
    return true;
}

TRG_FN float eval_falloff(const Light& light, float distance) {
    if (light.inverse_square) return 1.0f / (distance * distance);
    const float below =
        light.falloff[0] + distance * (light.falloff[1] + distance * light.falloff[2]);
    return below > 1.0f ? 1.0f / below : 1.0f;
}

TRG_FN bool sample_delta_point(const Light& light, Vec3 p, LightSample* sample) {
    const Vec3 to = light.position - p;
    sample->distance = length(to);
    if (!(sample->distance > 0.0f)) return false;
    sample->wi = to / sample->distance;
    sample->pdf = 0.0f;
    sample->light =
        light.color * (eval_falloff(light, sample->distance) * eval_spot(light, -sample->wi));
    return true;
}

/// Squared chord of the cone that a sphere of `radius` fills at squared distance `d2` (> radius^2).
TRG_FN float sphere_chord2(float radius, float d2) {
    const float sine2 = radius * radius / d2;
    return 2.0f * sine2 / (1.0f + std::sqrt(larger(0.0f, 1.0f - sine2)));
}

/// Distance along unit `wi` from `p` to the near side of the sphere, if it is ahead.
TRG_FN bool intersect_sphere_light(const Light& light, Vec3 p, Vec3 wi, float* distance) {
    const Vec3 to = light.position - p;
    const float along = dot(to, wi);
    const Vec3 miss = to - wi * along;
    const float h2 = light.radius * light.radius - dot(miss, miss);
    if (!(h2 >= 0.0f) || !(dot(to, to) > light.radius * light.radius)) return false;
    *distance = along - std::sqrt(h2);
    return *distance > 0.0f;
}

TRG_FN bool sample_sphere(const Light& light, Vec3 p, Sample2 uv, LightSample* sample) {
    const Vec3 to = light.position - p;
    const float d2 = dot(to, to);
    if (!(d2 > light.radius * light.radius)) return false;
    const float chord2 = sphere_chord2(light.radius, d2);
    sample->wi = sample_cone(to / std::sqrt(d2), chord2, uv);
    if (!intersect_sphere_light(light, p, sample->wi, &sample->distance)) {
        // Rounding at the rim: the tangent point stands in.
        sample->distance = std::sqrt(larger(0.0f, d2 - light.radius * light.radius));
    }
    const float solid_angle = kPi * chord2;
    sample->pdf = 1.0f / solid_angle;
    sample->light = light.color * (solid_angle * eval_spot(light, -sample->wi));
    return true;
}

/// The light's rectangle, or the one around its ellipse, as seen from `p`, where directions even by
/// solid angle serve better than points even by area: near rectangles, and ellipses so near or so
/// flat that nearly all of their rectangle counts. False elsewhere, and where float has too few
/// digits. `offset` leads from `p` to the light's centre.
TRG_FN bool see_rectangle(const Light& light, Vec3 offset, SeenRectangle* r) {
    constexpr float kSmallest = 4e-3f, kSteep2 = 0.4f, kBeside2 = 9.0f;
    const float d2 = dot(offset, offset);
    if (!(d2 < light.near2)) return false;
    r->height = -dot(offset, light.direction);
    if (!(r->height > 0.0f)) return false;
    if (light.kind == LightKind::ellipse && r->height * r->height > kSteep2 * d2 &&
        kBeside2 * d2 > light.near2)
        return false;
    const float x = dot(offset, light.axis_u) / light.half_u;
    const float y = dot(offset, light.axis_v) / light.half_v;
    r->x0 = x - light.half_u;
    r->x1 = x + light.half_u;
    r->y0 = y - light.half_v;
    r->y1 = y + light.half_v;
    measure_rectangle(r);
    return r->solid_angle > kSmallest;
}

TRG_FN bool sample_seen(const Light& light, const SeenRectangle& r, Sample2 uv,
                        LightSample* sample) {
    float x, y;
    sample_rectangle(r, uv, &x, &y);
    if (light.kind == LightKind::ellipse) {
        const float a = (2.0f * x - r.x0 - r.x1) / (r.x1 - r.x0);
        const float b = (2.0f * y - r.y0 - r.y1) / (r.y1 - r.y0);
        if (a * a + b * b > 1.0f) return false;
    }
    const Vec3 to = light.axis_u * (x / light.half_u) + light.axis_v * (y / light.half_v) +
                    light.direction * -r.height;
    sample->distance = length(to);
    sample->wi = to / sample->distance;
    sample->pdf = 1.0f / r.solid_angle;
    sample->light = light.color * (eval_spread(light, r.height / sample->distance) * r.solid_angle);
    return true;
}

TRG_FN bool sample_area(const Light& light, Vec3 p, Sample2 uv, LightSample* sample) {
    SeenRectangle seen;
    if (see_rectangle(light, light.position - p, &seen))
        return sample_seen(light, seen, uv, sample);
    float a = 2.0f * uv.u - 1.0f, b = 2.0f * uv.v - 1.0f;
    if (light.kind == LightKind::ellipse) sample_disc(uv.u, uv.v, &a, &b);
    const Vec3 to = light.position + light.axis_u * a + light.axis_v * b - p;
    const float d2 = dot(to, to);
    if (!(d2 > 0.0f)) return false;
    sample->distance = std::sqrt(d2);
    sample->wi = to / sample->distance;
    const float cosine = -dot(sample->wi, light.direction);
    if (!(cosine > 0.0f)) return false;
    sample->pdf = d2 / (cosine * light.area);
    sample->light = light.color * (eval_spread(light, cosine) / sample->pdf);
    return true;
}

/// Squared chord of the cone that a disc of `radius` fills which faces a point at squared distance
/// `d2`.
TRG_FN float disc_chord2(float radius, float d2) {
    const float h2 = d2 + radius * radius;
    return 2.0f * radius * radius / (h2 + std::sqrt(d2 * h2));
}

TRG_FN bool sample_soft(const Light& light, Vec3 p, Sample2 uv, LightSample* sample) {
    const Vec3 to = light.position - p;
    const float d2 = dot(to, to);
    if (!(d2 > 0.0f)) return false;
    const float away = std::sqrt(d2), chord2 = disc_chord2(light.radius, d2);
    const Vec3 axis = to / away;
    sample->wi = sample_cone(axis, chord2, uv);
    const float cosine = dot(axis, sample->wi);
    if (!(cosine > 0.0f)) return false;
    sample->distance = away / cosine;
    const float solid_angle = kPi * chord2;
    sample->pdf = 1.0f / solid_angle;
    sample->light = light.color * (solid_angle * eval_spot(light, -sample->wi));
    return true;
}

/// Draws a direction from `p` to `light`; false when nothing arrives.
TRG_FN bool sample_light(const Light& light, Vec3 p, Sample2 uv, LightSample* sample) {
    switch (light.kind) {
        case LightKind::sun:
            return sample_sun(light, uv, sample);
        case LightKind::point:
        case LightKind::spot:
            if (light.extended && light.soft) return sample_soft(light, p, uv, sample);
            return light.extended ? sample_sphere(light, p, uv, sample)
                                  : sample_delta_point(light, p, sample);
        default:
            return sample_area(light, p, uv, sample);
    }
}

/// What a ray from `p` along unit `wi`, ending at `t_max`, sees of a light with extent.
struct LightHit {
    Vec3 radiance;
    float pdf;  // of sample_light for this direction
    float distance;
};

TRG_FN bool intersect_area_light(const Light& light, Vec3 p, Vec3 wi, float t_max, LightHit* hit) {
    const float cosine = -dot(wi, light.direction);
    if (!(cosine > 0.0f)) return false;
    const float t = dot(p - light.position, light.direction) / cosine;
    if (!(t > 0.0f && t < t_max)) return false;
    const Vec3 at = p + wi * t - light.position;
    const float uu = dot(light.axis_u, light.axis_u), vv = dot(light.axis_v, light.axis_v);
    const float uvd = dot(light.axis_u, light.axis_v);
    const float det = uu * vv - uvd * uvd;
    const float pu = dot(at, light.axis_u), pv = dot(at, light.axis_v);
    const float a = (pu * vv - pv * uvd) / det, b = (pv * uu - pu * uvd) / det;
    const bool inside = light.kind == LightKind::ellipse
                            ? a * a + b * b <= 1.0f
                            : std::fabs(a) <= 1.0f && std::fabs(b) <= 1.0f;
    if (!inside) return false;
    hit->radiance = light.color * eval_spread(light, cosine);
    SeenRectangle seen;
    hit->pdf = see_rectangle(light, light.position - p, &seen) ? 1.0f / seen.solid_angle
                                                               : t * t / (cosine * light.area);
    hit->distance = t;
    return true;
}

TRG_FN bool intersect_soft_light(const Light& light, Vec3 p, Vec3 wi, float t_max, LightHit* hit) {
    const Vec3 to = light.position - p;
    const float along = dot(to, wi);
    if (!(along > 0.0f)) return false;
    const float t = dot(to, to) / along;
    const Vec3 off = wi * t - to;
    if (!(t < t_max) || dot(off, off) > light.radius * light.radius) return false;
    hit->radiance = light.color * eval_spot(light, -wi);
    hit->pdf = 1.0f / (kPi * disc_chord2(light.radius, dot(to, to)));
    hit->distance = t;
    return true;
}

TRG_FN bool intersect_light(const Light& light, Vec3 p, Vec3 wi, float t_max, LightHit* hit) {
    if (light.kind == LightKind::sun) {
        const Vec3 off = wi - light.direction;
        if (t_max < kFar || dot(off, off) > light.chord2) return false;
        hit->radiance = light.color;
        hit->pdf = 1.0f / light.solid_angle;
        hit->distance = kFar;
        return true;
    }
    if (light.kind == LightKind::rectangle || light.kind == LightKind::ellipse)
        return intersect_area_light(light, p, wi, t_max, hit);
    if (light.soft) return intersect_soft_light(light, p, wi, t_max, hit);
    float t;
    if (!intersect_sphere_light(light, p, wi, &t) || !(t < t_max)) return false;
    const Vec3 to = light.position - p;
    hit->radiance = light.color * eval_spot(light, -wi);
    hit->pdf = 1.0f / (kPi * sphere_chord2(light.radius, dot(to, to)));
    hit->distance = t;
    return true;
}

}  // namespace trg

/// Arithmetic of colours as Blender's colour nodes do it.
#pragma once

#include "shade/frame.h"

namespace trg {

/// Blend modes in the order of Blender's list.
enum class Blend : int32_t {
    mix,
    darken,
    multiply,
    burn,
    lighten,
    screen,
    dodge,
    add,
    overlay,
    soft_light,
    linear_light,
    difference,
    exclusion,
    subtract,
    divide,
    hue,
    saturation,
    color,
    value
};

TRG_FN Vec3 rgb_to_hsv(Vec3 c) {
    const float top = max_component(c), low = smaller(c.x, smaller(c.y, c.z));
    const float spread = top - low;
    const float s = top != 0.0f ? spread / top : 0.0f;
    if (s == 0.0f) return {0.0f, s, top};
    float h = c.x == top   ? (c.y - c.z) / spread
              : c.y == top ? 2.0f + (c.z - c.x) / spread
                           : 4.0f + (c.x - c.y) / spread;
    h /= 6.0f;
    return {h < 0.0f ? h + 1.0f : h, s, top};
}

TRG_FN Vec3 hsv_to_rgb(Vec3 c) {
    if (c.y == 0.0f) return {c.z, c.z, c.z};
    const float h = (c.x == 1.0f ? 0.0f : c.x) * 6.0f, sector = std::floor(h), f = h - sector;
    const float p = c.z * (1.0f - c.y), q = c.z * (1.0f - c.y * f),
                t = c.z * (1.0f - c.y * (1.0f - f));
    if (sector == 0.0f) return {c.z, t, p};
    if (sector == 1.0f) return {q, c.z, p};
    if (sector == 2.0f) return {p, c.z, t};
    if (sector == 3.0f) return {p, q, c.z};
    if (sector == 4.0f) return {t, p, c.z};
    return {c.z, p, q};
}

TRG_FN Vec3 rgb_to_hsl(Vec3 c) {
    const float top = max_component(c), low = smaller(c.x, smaller(c.y, c.z));
    const float spread = top - low, light = smaller(1.0f, 0.5f * (top + low));
    if (spread == 0.0f) return {0.0f, 0.0f, light};
    const float s = light > 0.5f ? spread / (2.0f - top - low) : spread / (top + low);
    const float h = top == c.x   ? (c.y - c.z) / spread + (c.y < c.z ? 6.0f : 0.0f)
                    : top == c.y ? (c.z - c.x) / spread + 2.0f
                                 : (c.x - c.y) / spread + 4.0f;
    return {h / 6.0f, s, light};
}

TRG_FN Vec3 hsl_to_rgb(Vec3 c) {
    const float h = c.x * 6.0f;
    const float chroma = (1.0f - std::fabs(2.0f * c.z - 1.0f)) * c.y;
    const Vec3 n{clamp01(std::fabs(h - 3.0f) - 1.0f), clamp01(2.0f - std::fabs(h - 2.0f)),
                 clamp01(2.0f - std::fabs(h - 4.0f))};
    return {(n.x - 0.5f) * chroma + c.z, (n.y - 0.5f) * chroma + c.z, (n.z - 0.5f) * chroma + c.z};
}

/// One channel of the blends that treat each channel by itself.
TRG_FN float blend_channel(Blend mode, float t, float a, float b) {
    const float s = 1.0f - t;
    switch (mode) {
        case Blend::mix:
            return s * a + t * b;
        case Blend::darken:
            return s * a + t * smaller(a, b);
        case Blend::lighten:
            return s * a + t * larger(a, b);
        case Blend::multiply:
            return a * (s + t * b);
        case Blend::screen:
            return 1.0f - (s + t * (1.0f - b)) * (1.0f - a);
        case Blend::add:
            return a + t * b;
        case Blend::subtract:
            return a - t * b;
        case Blend::divide:
            return b != 0.0f ? s * a + t * a / b : a;
        case Blend::difference:
            return s * a + t * std::fabs(a - b);
        case Blend::exclusion:
            return larger(s * a + t * (a + b - 2.0f * a * b), 0.0f);
        case Blend::overlay:
            return a < 0.5f ? a * (s + 2.0f * t * b)
                            : 1.0f - (s + 2.0f * t * (1.0f - b)) * (1.0f - a);
        case Blend::soft_light:
            return s * a + t * ((1.0f - a) * b * a + a * (1.0f - (1.0f - b) * (1.0f - a)));
        case Blend::linear_light:
            return a + t * (2.0f * b - 1.0f);
        case Blend::dodge: {
            if (a == 0.0f) return a;
            const float left = 1.0f - t * b;
            return left <= 0.0f ? 1.0f : smaller(a / left, 1.0f);
        }
        default: {  // burn
            const float left = s + t * b;
            return left <= 0.0f ? 0.0f : clamp01(1.0f - (1.0f - a) / left);
        }
    }
}

TRG_FN Vec3 lerp(Vec3 a, Vec3 b, float t) {
    return a * (1.0f - t) + b * t;
}

/// The blends that go through hue, saturation and value.
TRG_FN Vec3 blend_hsv(Blend mode, float t, Vec3 a, Vec3 b) {
    const Vec3 from = rgb_to_hsv(a), to = rgb_to_hsv(b);
    switch (mode) {
        case Blend::hue:
            return to.y != 0.0f ? lerp(a, hsv_to_rgb({to.x, from.y, from.z}), t) : a;
        case Blend::color:
            return to.y != 0.0f ? lerp(a, hsv_to_rgb({to.x, to.y, from.z}), t) : a;
        case Blend::saturation:
            return from.y != 0.0f ? hsv_to_rgb({from.x, (1.0f - t) * from.y + t * to.y, from.z})
                                  : a;
        default:
            return hsv_to_rgb({from.x, from.y, (1.0f - t) * from.z + t * to.z});
    }
}

/// `b` laid over `a` by the share `t` of each channel.
TRG_FN Vec3 blend_colors(Blend mode, Vec3 t, Vec3 a, Vec3 b) {
    if (mode >= Blend::hue) return blend_hsv(mode, t.x, a, b);
    return {blend_channel(mode, t.x, a.x, b.x), blend_channel(mode, t.y, a.y, b.y),
            blend_channel(mode, t.z, a.z, b.z)};
}

/// Hue turned by h, saturation times s, value times v, mixed with `c` by the share t.
TRG_FN Vec3 adjust_hsv(Vec3 c, Vec3 by, float t) {
    const Vec3 old = rgb_to_hsv(c);
    const float h = old.x + by.x + 0.5f;
    const Vec3 turned = hsv_to_rgb({h - std::floor(h), clamp01(old.y * by.y), old.z * by.z});
    const Vec3 mixed = turned * t + c * (1.0f - t);
    return {larger(mixed.x, 0.0f), larger(mixed.y, 0.0f), larger(mixed.z, 0.0f)};
}

}  // namespace trg

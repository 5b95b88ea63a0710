/// The operations of Blender's Math, Vector Math and Map Range nodes.
#pragma once

#include <cfloat>
#include <cstdint>

#include "shade/frame.h"

namespace trg {

TRG_FN float divide_safe(float a, float b) {
    return b != 0.0f ? a / b : 0.0f;
}

TRG_FN float power_safe(float a, float b) {
    if (b == 0.0f) return 1.0f;
    if (a == 0.0f || (a < 0.0f && b != std::trunc(b))) return 0.0f;
    return std::pow(a, b);
}

TRG_FN float sign_of(float a) {
    return a == 0.0f ? 0.0f : (a < 0.0f ? -1.0f : 1.0f);
}

TRG_FN float smooth_minimum(float a, float b, float k) {
    if (k == 0.0f) return std::fmin(a, b);
    const float h = std::fmax(k - std::fabs(a - b), 0.0f) / k;
    return std::fmin(a, b) - h * h * h * k * (1.0f / 6.0f);
}

TRG_FN float wrap_between(float a, float high, float low) {
    const float range = high - low;
    return range != 0.0f ? a - range * std::floor((a - low) / range) : low;
}

TRG_FN float ping_pong(float a, float b) {
    if (b == 0.0f) return 0.0f;
    const float x = (a - b) / (b * 2.0f);
    return std::fabs((x - std::floor(x)) * b * 2.0f - b);
}

/// Operations in the order of MATH_OPERATIONS in texture_ops.py.
TRG_FN float eval_rounding(int32_t operation, float a, float b, float c) {
    switch (operation) {
        case 19:
            return std::floor(a + 0.5f);
        case 20:
            return std::floor(a);
        case 21:
            return std::ceil(a);
        case 22:
            return std::trunc(a);
        case 23:
            return a - std::floor(a);
        case 24:
            return b != 0.0f ? std::fmod(a, b) : 0.0f;
        case 25:
            return b != 0.0f ? a - std::floor(a / b) * b : 0.0f;
        case 26:
            return wrap_between(a, b, c);
        case 27:
            return std::floor(divide_safe(a, b)) * b;
        default:
            return ping_pong(a, b);
    }
}

TRG_FN float eval_trigonometry(int32_t operation, float a, float b) {
    switch (operation) {
        case 29:
            return std::sin(a);
        case 30:
            return std::cos(a);
        case 31:
            return std::tan(a);
        case 32:
            return std::asin(smaller(larger(a, -1.0f), 1.0f));
        case 33:
            return std::acos(smaller(larger(a, -1.0f), 1.0f));
        case 34:
            return std::atan(a);
        case 35:
            return a == 0.0f && b == 0.0f ? 0.0f : std::atan2(a, b);
        case 36:
            return std::sinh(a);
        case 37:
            return std::cosh(a);
        case 38:
            return std::tanh(a);
        case 39:
            return a * (kPi / 180.0f);
        default:
            return a * (180.0f / kPi);
    }
}

TRG_FN float eval_math(int32_t operation, float a, float b, float c) {
    switch (operation) {
        case 0:
            return a + b;
        case 1:
            return a - b;
        case 2:
            return a * b;
        case 3:
            return divide_safe(a, b);
        case 4:
            return a * b + c;
        case 5:
            return power_safe(a, b);
        case 6:
            return a > 0.0f && b > 0.0f ? divide_safe(std::log(a), std::log(b)) : 0.0f;
        case 7:
            return std::sqrt(larger(a, 0.0f));
        case 8:
            return a > 0.0f ? 1.0f / std::sqrt(a) : 0.0f;
        case 9:
            return std::fabs(a);
        case 10:
            return std::exp(a);
        case 11:
            return std::fmin(a, b);
        case 12:
            return std::fmax(a, b);
        case 13:
            return a < b ? 1.0f : 0.0f;
        case 14:
            return a > b ? 1.0f : 0.0f;
        case 15:
            return sign_of(a);
        case 16:
            return a == b || std::fabs(a - b) <= std::fmax(c, FLT_EPSILON) ? 1.0f : 0.0f;
        case 17:
            return smooth_minimum(a, b, c);
        case 18:
            return -smooth_minimum(-a, -b, c);
        default:
            return operation < 29 ? eval_rounding(operation, a, b, c)
                                  : eval_trigonometry(operation, a, b);
    }
}

/// Operations of whole vectors, in the order of VECTOR_OPERATIONS in texture_ops.py.
TRG_FN Vec3 eval_vector_math(int32_t operation, Vec3 a, Vec3 b, Vec3 c, float scale) {
    const auto grey = [](float x) { return Vec3{x, x, x}; };
    switch (operation) {
        case 0:
            return cross(a, b);
        case 1: {
            const float square = dot(b, b);
            return square != 0.0f ? b * (dot(a, b) / square) : grey(0.0f);
        }
        case 2: {
            const Vec3 n = normalize_safe(b);
            return a - n * (2.0f * dot(a, n));
        }
        case 3: {
            const Vec3 n = normalize_safe(b);
            const float k = 1.0f - scale * scale * (1.0f - dot(n, a) * dot(n, a));
            return k < 0.0f ? grey(0.0f) : a * scale - n * (scale * dot(n, a) + std::sqrt(k));
        }
        case 4:
            return dot(c, b) < 0.0f ? a : -a;
        case 5:
            return grey(dot(a, b));
        case 6:
            return grey(length(a - b));
        case 7:
            return grey(length(a));
        case 8:
            return a * scale;
        default:
            return normalize_safe(a);
    }
}

struct Range {
    float from_low, from_high, to_low, to_high, steps;
};

TRG_FN float ease_range(float low, float high, float x, bool smoother) {
    const float t = clamp01(divide_safe(x - low, high - low));
    return smoother ? t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f) : t * t * (3.0f - 2.0f * t);
}

/// Map Range of kind 0 linear, 1 stepped, 2 smooth step, 3 smoother step; not clamped.
TRG_FN float map_range(int32_t kind, float x, const Range& r) {
    if (r.from_high == r.from_low) return 0.0f;
    float t = (x - r.from_low) / (r.from_high - r.from_low);
    if (kind == 1) t = r.steps > 0.0f ? std::floor(t * (r.steps + 1.0f)) / r.steps : 0.0f;
    if (kind >= 2)
        t = r.from_low > r.from_high ? 1.0f - ease_range(r.from_high, r.from_low, x, kind == 3)
                                     : ease_range(r.from_low, r.from_high, x, kind == 3);
    return r.to_low + t * (r.to_high - r.to_low);
}

}  // namespace trg

/// Checker, brick, wave and gradient: Blender's procedural patterns but for noise.
#pragma once

#include "shade/noise.h"

namespace trg {

/// Cycles moves its patterns by this, lest whole coordinates fall on either side by rounding.
TRG_FN float nudge(float x) {
    return (x + 1e-6f) * 0.999999f;
}

TRG_FN float remainder_floor(float a, float b) {
    return a - b * std::floor(a / b);
}

/// 1 in the cubes whose whole coordinates add up to an odd number, 0 in the others.
TRG_FN float eval_checker(Vec3 p) {
    const float sum = std::floor(nudge(p.x)) + std::floor(nudge(p.y)) + std::floor(nudge(p.z));
    return remainder_floor(sum, 2.0f) != 0.0f ? 1.0f : 0.0f;
}

struct BrickShape {
    float mortar_size, mortar_smooth, bias, width, row_height;
    float offset, squash;
    float offset_frequency, squash_frequency;  // whole numbers
};

/// Tint of the brick at p (0 the first colour, 1 the second) and how much of it is mortar.
struct BrickPoint {
    float tint, mortar;
};

/// A whole number as 32 bits, wrapped around where it is larger.
TRG_FN uint32_t wrap_number(float whole) {
    if (!(std::fabs(whole) < 2147483520.0f)) return 0u;
    return static_cast<uint32_t>(static_cast<int32_t>(whole));
}

/// Random shade of a brick, 0 to 1.
TRG_FN float hash_brick(float row, float brick) {
    uint32_t n = (wrap_number(row) << 16) + (wrap_number(brick) & 0xffffu);
    n = (n + 1013u) & 0x7fffffffu;
    n = (n >> 13) ^ n;
    const uint32_t mixed = (n * (n * n * 60493u + 19990303u) + 1376312589u) & 0x7fffffffu;
    return 0.5f * (static_cast<float>(mixed) / 1073741824.0f);
}

TRG_FN float smooth_step(float x) {
    const float t = clamp01(x);
    return t * t * (3.0f - 2.0f * t);
}

TRG_FN BrickPoint eval_brick(Vec3 p, const BrickShape& b) {
    const float row = std::floor(p.y / b.row_height);
    float width = b.width, shift = 0.0f;
    if (b.offset_frequency != 0.0f && b.squash_frequency != 0.0f) {
        if (std::fmod(row, b.squash_frequency) == 0.0f) width *= b.squash;
        if (std::fmod(row, b.offset_frequency) == 0.0f) shift = width * b.offset;
    }
    const float brick = std::floor((p.x + shift) / width);
    const float x = p.x + shift - width * brick, y = p.y - b.row_height * row;
    const float tint = clamp01(hash_brick(row, brick) + b.bias);
    const float edge = smaller(smaller(x, y), smaller(width - x, b.row_height - y));
    if (edge >= b.mortar_size) return {tint, 0.0f};
    if (b.mortar_smooth == 0.0f) return {tint, 1.0f};
    return {tint, smooth_step((1.0f - edge / b.mortar_size) / b.mortar_smooth)};
}

/// Bits of the mode of a wave: where its direction, rings and profile stand.
constexpr int32_t kWaveRings = 4, kWaveProfileShift = 3;

struct WaveShape {
    int32_t mode;
    float distortion, detail, detail_scale, detail_roughness, phase;
};

TRG_FN float eval_wave(Vec3 at, const WaveShape& w) {
    const Vec3 p{nudge(at.x), nudge(at.y), nudge(at.z)};
    const int32_t direction = w.mode & 3;
    float n;
    if (w.mode & kWaveRings) {
        const Vec3 across{direction == 0 ? 0.0f : p.x, direction == 1 ? 0.0f : p.y,
                          direction == 2 ? 0.0f : p.z};
        n = length(across) * 20.0f;
    } else {
        n = direction == 3 ? (p.x + p.y + p.z) * 10.0f
                           : (direction == 0 ? p.x : (direction == 1 ? p.y : p.z)) * 20.0f;
    }
    n += w.phase;
    if (w.distortion != 0.0f) {
        const float scaled[3] = {p.x * w.detail_scale, p.y * w.detail_scale, p.z * w.detail_scale};
        const Fractal fractal{NoiseKind::fbm,
                              true,
                              smaller(larger(w.detail, 0.0f), 15.0f),
                              larger(w.detail_roughness, 0.0f),
                              2.0f,
                              0.0f,
                              0.0f};
        n += w.distortion * (eval_fractal<3>(scaled, fractal) * 2.0f - 1.0f);
    }
    constexpr float kTurn = 2.0f * kPi;
    switch (w.mode >> kWaveProfileShift) {
        case 0:
            return 0.5f + 0.5f * std::sin(n - 0.5f * kPi);
        case 1:
            return n / kTurn - std::floor(n / kTurn);
        default:
            return std::fabs(n / kTurn - std::floor(n / kTurn + 0.5f)) * 2.0f;
    }
}

/// The gradient of number `kind` in Blender's list, 0 to 1.
TRG_FN float eval_gradient(Vec3 p, int32_t kind) {
    const float ball = larger(0.999999f - length(p), 0.0f);
    switch (kind) {
        case 0:
            return clamp01(p.x);
        case 1:
            return clamp01(larger(p.x, 0.0f) * larger(p.x, 0.0f));
        case 2:
            return smooth_step(p.x);
        case 3:
            return clamp01((p.x + p.y) * 0.5f);
        case 4:
            return clamp01(ball);
        case 5:
            return clamp01(ball * ball);
        default:
            return clamp01(std::atan2(p.y, p.x) / (2.0f * kPi) + 0.5f);
    }
}

}  // namespace trg

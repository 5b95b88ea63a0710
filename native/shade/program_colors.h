/// Instructions of colours: ramps, curves, blends, adjustments.
#pragma once

#include "shade/color_nodes.h"
#include "shade/program_machine.h"

namespace trg {

/// Row of a table of `count` rows of four values at `x` between 0 and 1.
TRG_FN Texel eval_table(const float* table, int32_t count, float x, bool smooth) {
    const float at = clamp01(x) * static_cast<float>(count - 1);
    const int32_t row = static_cast<int32_t>(at);
    const float rest = smooth ? at - static_cast<float>(row) : 0.0f;
    const float* low = table + 4 * row;
    const float* high = rest > 0.0f ? low + 4 : low;
    const float keep = 1.0f - rest;
    return {low[0] * keep + high[0] * rest, low[1] * keep + high[1] * rest,
            low[2] * keep + high[2] * rest, low[3] * keep + high[3] * rest};
}

/// Channel `k` of a curve table at x, which goes on straight beyond its ends when `extend`.
TRG_FN float eval_curve(const float* table, int32_t count, float x, int k, bool extend) {
    if (extend && x < 0.0f) return table[k] + (table[k] - table[4 + k]) * -x * (count - 1.0f);
    const float* last = table + 4 * (count - 1) + k;
    if (extend && x > 1.0f) return *last + (*last - last[-4]) * (x - 1.0f) * (count - 1.0f);
    const Texel t = eval_table(table, count, x, true);
    return k == 0 ? t.r : (k == 1 ? t.g : t.b);
}

/// Bits of the mode of curves and ramps: rows of the table, then this (ramp: smooth, curve:
/// extend).
constexpr int32_t kTableFlag = 1 << 16;

TRG_FN Vec3 run_curves(const Machine& m, const ProgramOp& op) {
    const Vec3 color = vector(m, op, 1);
    const float* table = operand(m, op, 2);
    const float low = number(m, op, 3), range = number(m, op, 4) - low;
    const int32_t count = op.mode & (kTableFlag - 1);
    const bool extend = (op.mode & kTableFlag) != 0;
    const Vec3 curved{eval_curve(table, count, (color.x - low) / range, 0, extend),
                      eval_curve(table, count, (color.y - low) / range, 1, extend),
                      eval_curve(table, count, (color.z - low) / range, 2, extend)};
    return lerp(color, curved, number(m, op, 0));
}

TRG_FN Vec3 gamma_color(Vec3 c, float gamma) {
    if (gamma == 0.0f) return {1.0f, 1.0f, 1.0f};
    const auto power = [gamma](float x) { return x > 0.0f ? std::pow(x, gamma) : x; };
    return {power(c.x), power(c.y), power(c.z)};
}

TRG_FN Vec3 separate_color(int32_t mode, Vec3 c) {
    return mode == 0 ? c : (mode == 1 ? rgb_to_hsv(c) : rgb_to_hsl(c));
}
TRG_FN Vec3 combine_color(int32_t mode, Vec3 c) {
    return mode == 0 ? c : (mode == 1 ? hsv_to_rgb(c) : hsl_to_rgb(c));
}

TRG_FN void run_color(Machine& m, const ProgramOp& op) {
    switch (op.op) {
        case TextureOp::ramp:
            return store_texel(m, op,
                               eval_table(operand(m, op, 1), op.mode & (kTableFlag - 1),
                                          number(m, op, 0), (op.mode & kTableFlag) != 0));
        case TextureOp::curves:
            return store(m, op, run_curves(m, op));
        case TextureOp::blend:
            return store(m, op,
                         blend_colors(static_cast<Blend>(op.mode), vector(m, op, 0),
                                      vector(m, op, 1), vector(m, op, 2)));
        case TextureOp::adjust_hsv:
            return store(m, op, adjust_hsv(vector(m, op, 0), vector(m, op, 1), number(m, op, 2)));
        case TextureOp::contrast: {
            const float slope = 1.0f + number(m, op, 2),
                        base = number(m, op, 1) - number(m, op, 2) * 0.5f;
            const Vec3 c = vector(m, op, 0) * slope + Vec3{base, base, base};
            return store(m, op, {larger(c.x, 0.0f), larger(c.y, 0.0f), larger(c.z, 0.0f)});
        }
        case TextureOp::invert: {
            const Vec3 c = vector(m, op, 0);
            return store(m, op, lerp(c, Vec3{1.0f, 1.0f, 1.0f} - c, number(m, op, 1)));
        }
        case TextureOp::gamma:
            return store(m, op, gamma_color(vector(m, op, 0), number(m, op, 1)));
        case TextureOp::separate:
            return store(m, op, separate_color(op.mode, vector(m, op, 0)));
        case TextureOp::combine:
            return store(
                m, op,
                combine_color(op.mode, {number(m, op, 0), number(m, op, 1), number(m, op, 2)}));
        default: {
            const float grey = luminance(vector(m, op, 0));
            return store(m, op, {grey, grey, grey});
        }
    }
}

}  // namespace trg

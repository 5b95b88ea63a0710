/// Instructions that say where a point lies and what an image or a pattern shows there.
#pragma once

#include "shade/color_nodes.h"
#include "shade/patterns.h"
#include "shade/program_machine.h"

namespace trg {

/// Normals by mode: 0 shading, 1 geometric, 2 shading in the object's space, 3 towards the viewer,
/// 4 the mirrored view.
TRG_FN Vec3 pick_direction(const TexturePoint& p, int32_t mode) {
    switch (mode) {
        case 0:
            return p.normal;
        case 1:
            return p.flat;
        case 2:
            return normal_into(*p.instance, p.normal);
        case 3:
            return p.wo;
        default:
            return p.normal * (2.0f * dot(p.wo, p.normal)) - p.wo;
    }
}

/// Places and facts: what a program starts from.
TRG_FN void run_place(Machine& m, const ProgramOp& op) {
    const TexturePoint& p = m.here;
    switch (op.op) {
        case TextureOp::attribute:
            eval_attribute(p, op.mode, m.registers + op.out);
            break;
        case TextureOp::generated:
            store(m, op, generated_place(p));
            break;
        case TextureOp::object:
            store(m, op, p.local);
            break;
        case TextureOp::position:
            store(m, op, p.position);
            break;
        case TextureOp::normal:
            store(m, op, pick_direction(p, op.mode));
            break;
        case TextureOp::shift: {
            const Frame frame = make_frame(m.home.flat);
            const Vec3 by = op.mode == 1 ? frame.s : frame.t;
            m.here =
                op.mode == 0 ? m.home : move_point(m.home, by * (m.home.step * number(m, op, 0)));
            break;
        }
        default: {  // info: 0 random, 1 backfacing, 2 location
            const auto& t = p.instance->object_to_world.m;
            if (op.mode == 2)
                store(m, op, {t[0][3], t[1][3], t[2][3]});
            else
                m.registers[op.out] = op.mode == 0 ? p.random : (p.outside ? 0.0f : 1.0f);
        }
    }
}

TRG_FN Texel look_up(const Machine& m, int32_t texture, float u, float v) {
    const Texture& t = m.set.textures[texture];
    return eval_texels(m.set.images[t.image], t, u, v);
}

/// The image laid on from three sides (mode: the texture).
TRG_FN Texel eval_box(const Machine& m, int32_t texture, Vec3 at, float blend) {
    const Vec3 n = normal_into(*m.here.instance, m.here.normal);
    const Vec3 w = box_weights(n, blend);
    Texel sum{0.0f, 0.0f, 0.0f, 0.0f};
    if (w.x > 0.0f) sum = sum + look_up(m, texture, n.x < 0.0f ? 1.0f - at.y : at.y, at.z) * w.x;
    if (w.y > 0.0f) sum = sum + look_up(m, texture, n.y > 0.0f ? 1.0f - at.x : at.x, at.z) * w.y;
    if (w.z > 0.0f) sum = sum + look_up(m, texture, n.z > 0.0f ? 1.0f - at.y : at.y, at.x) * w.z;
    return sum;
}

/// Bits of the mode of noise: dimensions - 1, then kind, then these.
constexpr int32_t kNoiseKindShift = 2, kNoiseNormalize = 32, kNoiseColored = 64;

TRG_FN Vec3 run_noise(const Machine& m, const ProgramOp& op) {
    const Vec3 at = vector(m, op, 0);
    const float scale = number(m, op, 2), w = number(m, op, 1) * scale;
    const Fractal fractal{static_cast<NoiseKind>((op.mode >> kNoiseKindShift) & 7),
                          (op.mode & kNoiseNormalize) != 0,
                          smaller(larger(number(m, op, 3), 0.0f), 15.0f),
                          larger(number(m, op, 4), 0.0f),
                          number(m, op, 5),
                          number(m, op, 6),
                          number(m, op, 7)};
    const float distortion = number(m, op, 8);
    const bool colored = (op.mode & kNoiseColored) != 0;
    const float p[4] = {at.x * scale, at.y * scale, at.z * scale, w};
    switch (op.mode & 3) {
        case 0:
            return eval_noise_texture<1>(&w, fractal, distortion, colored);
        case 1:
            return eval_noise_texture<2>(p, fractal, distortion, colored);
        case 2:
            return eval_noise_texture<3>(p, fractal, distortion, colored);
        default:
            return eval_noise_texture<4>(p, fractal, distortion, colored);
    }
}

/// Two colours, a mortar, and what shapes the bricks; writes the colour and the share of mortar.
TRG_FN Texel run_brick(const Machine& m, const ProgramOp& op) {
    const float* fixed = operand(m, op, 10);
    const BrickShape shape{number(m, op, 5), number(m, op, 6), number(m, op, 7),
                           number(m, op, 8), number(m, op, 9), fixed[0],
                           fixed[1],         fixed[2],         fixed[3]};
    const BrickPoint at = eval_brick(vector(m, op, 0) * number(m, op, 4), shape);
    const Vec3 brick = lerp(vector(m, op, 1), vector(m, op, 2), at.tint);
    const Vec3 color = lerp(brick, vector(m, op, 3), at.mortar);
    return {color.x, color.y, color.z, at.mortar};
}

TRG_FN void run_texture(Machine& m, const ProgramOp& op) {
    const Vec3 at = vector(m, op, 0);
    switch (op.op) {
        case TextureOp::image:
            return store_texel(m, op, look_up(m, op.mode, at.x, at.y));
        case TextureOp::box:
            return store_texel(m, op, eval_box(m, op.mode, at, number(m, op, 1)));
        case TextureOp::checker: {
            const float first = eval_checker(at * number(m, op, 3));
            const Vec3 c = first == 1.0f ? vector(m, op, 1) : vector(m, op, 2);
            return store_texel(m, op, {c.x, c.y, c.z, first});
        }
        case TextureOp::noise:
            return store(m, op, run_noise(m, op));
        case TextureOp::brick:
            return store_texel(m, op, run_brick(m, op));
        case TextureOp::wave: {
            const WaveShape wave{op.mode,          number(m, op, 2), number(m, op, 3),
                                 number(m, op, 4), number(m, op, 5), number(m, op, 6)};
            const float value = eval_wave(at * number(m, op, 1), wave);
            return store(m, op, {value, value, value});
        }
        default: {
            const float value = eval_gradient(at, op.mode);
            return store(m, op, {value, value, value});
        }
    }
}

}  // namespace trg

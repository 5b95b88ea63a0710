/// Instructions of numbers and vectors.
#pragma once

#include "shade/math_nodes.h"
#include "shade/program_machine.h"

namespace trg {

/// x, y and z turned by Euler angles in that order; backwards undoes it.
TRG_FN Vec3 rotate_euler(Vec3 v, Vec3 angles, bool backwards) {
    const float cx = std::cos(angles.x), cy = std::cos(angles.y), cz = std::cos(angles.z);
    const float sx = std::sin(angles.x), sy = std::sin(angles.y), sz = std::sin(angles.z);
    const Vec3 r0{cy * cz, sy * sx * cz - cx * sz, sy * cx * cz + sx * sz};
    const Vec3 r1{cy * sz, sy * sx * sz + cx * cz, sy * cx * sz - sx * cz};
    const Vec3 r2{-sy, cy * sx, cy * cx};
    if (backwards) return r0 * v.x + r1 * v.y + r2 * v.z;
    return {dot(r0, v), dot(r1, v), dot(r2, v)};
}

/// The Mapping node of kind 0 point, 1 texture, 2 vector, 3 normal.
TRG_FN Vec3 eval_mapping(int32_t kind, Vec3 v, Vec3 location, Vec3 rotation, Vec3 scale) {
    const auto divided = [](Vec3 a, Vec3 b) {
        return Vec3{divide_safe(a.x, b.x), divide_safe(a.y, b.y), divide_safe(a.z, b.z)};
    };
    switch (kind) {
        case 0:
            return rotate_euler(v * scale, rotation, false) + location;
        case 1:
            return divided(rotate_euler(v - location, rotation, true), scale);
        case 2:
            return rotate_euler(v * scale, rotation, false);
        default:
            return normalize_safe(rotate_euler(divided(v, scale), rotation, false));
    }
}

TRG_FN Vec3 affine_place(const float* a, Vec3 v) {
    return {a[0] * v.x + a[1] * v.y + a[2] * v.z + a[3],
            a[4] * v.x + a[5] * v.y + a[6] * v.z + a[7],
            a[8] * v.x + a[9] * v.y + a[10] * v.z + a[11]};
}

TRG_FN Vec3 channel_math(int32_t operation, Vec3 a, Vec3 b, Vec3 c) {
    return {eval_math(operation, a.x, b.x, c.x), eval_math(operation, a.y, b.y, c.y),
            eval_math(operation, a.z, b.z, c.z)};
}

/// The mode of vector_math: those of eval_math, then from here on those of eval_vector_math.
constexpr int32_t kVectorModes = 64;

TRG_FN Vec3 run_vector_math(const Machine& m, const ProgramOp& op) {
    const Vec3 a = vector(m, op, 0), b = vector(m, op, 1), c = vector(m, op, 2);
    if (op.mode < kVectorModes) return channel_math(op.mode, a, b, c);
    return eval_vector_math(op.mode - kVectorModes, a, b, c, number(m, op, 3));
}

TRG_FN Vec3 run_map_range(const Machine& m, const ProgramOp& op) {
    const float* x[6];
    for (int k = 0; k < 6; ++k) x[k] = operand(m, op, k);
    float out[3];
    for (int k = 0; k < 3; ++k)
        out[k] = map_range(op.mode, x[0][k], {x[1][k], x[2][k], x[3][k], x[4][k], x[5][k]});
    return {out[0], out[1], out[2]};
}

TRG_FN void run_number(Machine& m, const ProgramOp& op) {
    switch (op.op) {
        case TextureOp::copy:
            return store(m, op, {number(m, op, 0), number(m, op, 1), number(m, op, 2)});
        case TextureOp::project:
            return store(m, op, project_place(vector(m, op, 0), op.mode));
        case TextureOp::affine:
            return store(m, op, affine_place(operand(m, op, 1), vector(m, op, 0)));
        case TextureOp::mapping:
            return store(m, op,
                         eval_mapping(op.mode, vector(m, op, 0), vector(m, op, 1), vector(m, op, 2),
                                      vector(m, op, 3)));
        case TextureOp::math:
            m.registers[op.out] =
                eval_math(op.mode, number(m, op, 0), number(m, op, 1), number(m, op, 2));
            return;
        case TextureOp::vector_math:
            return store(m, op, run_vector_math(m, op));
        case TextureOp::map_range:
            return store(m, op, run_map_range(m, op));
        default: {  // clamp each channel between two, whichever is the lower
            const Vec3 x = vector(m, op, 0), a = vector(m, op, 1), b = vector(m, op, 2);
            const auto hold = [](float v, float low, float high) {
                return smaller(larger(v, smaller(low, high)), larger(low, high));
            };
            return store(m, op, {hold(x.x, a.x, b.x), hold(x.y, a.y, b.y), hold(x.z, a.z, b.z)});
        }
    }
}

}  // namespace trg

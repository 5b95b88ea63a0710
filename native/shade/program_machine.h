/// What runs a texture program: its place and its registers.
#pragma once

#include "shade/texture_places.h"

namespace trg {

/// A running program: its place may move (for bumps), its registers fill.
struct Machine {
    const TextureSet& set;
    const TexturePoint& home;
    TexturePoint here;
    float* registers;  // kProgramRegisters
};

TRG_FN const float* operand(const Machine& m, const ProgramOp& op, int k) {
    const int32_t at = op.in[k];
    return at >= 0 ? m.registers + at : m.set.constants + (-1 - at);
}
TRG_FN float number(const Machine& m, const ProgramOp& op, int k) {
    return *operand(m, op, k);
}
TRG_FN Vec3 vector(const Machine& m, const ProgramOp& op, int k) {
    const float* v = operand(m, op, k);
    return {v[0], v[1], v[2]};
}
TRG_FN void store(Machine& m, const ProgramOp& op, Vec3 v) {
    float* out = m.registers + op.out;
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}
TRG_FN void store_texel(Machine& m, const ProgramOp& op, Texel t) {
    store(m, op, {t.r, t.g, t.b});
    m.registers[op.out + 3] = t.a;
}

}  // namespace trg

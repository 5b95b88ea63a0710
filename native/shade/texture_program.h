/// Programs: the node graph of one material input as instructions over registers.
#pragma once

#include "shade/program_colors.h"
#include "shade/program_numbers.h"
#include "shade/program_surface.h"
#include "shade/program_textures.h"

namespace trg {

TRG_FN void run_op(Machine& m, const ProgramOp& op) {
    switch (op.op) {
        case TextureOp::attribute:
        case TextureOp::generated:
        case TextureOp::object:
        case TextureOp::position:
        case TextureOp::normal:
        case TextureOp::info:
        case TextureOp::shift:
            return run_place(m, op);
        case TextureOp::image:
        case TextureOp::box:
        case TextureOp::checker:
        case TextureOp::noise:
        case TextureOp::brick:
        case TextureOp::gradient:
        case TextureOp::wave:
            return run_texture(m, op);
        case TextureOp::copy:
        case TextureOp::project:
        case TextureOp::affine:
        case TextureOp::mapping:
        case TextureOp::math:
        case TextureOp::vector_math:
        case TextureOp::map_range:
        case TextureOp::clamp:
            return run_number(m, op);
        case TextureOp::fresnel:
        case TextureOp::layer_weight:
        case TextureOp::bump:
        case TextureOp::normal_map:
            return run_surface(m, op);
        default:
            return run_color(m, op);
    }
}

/// Value of program `number` at `p`; null where a channel is not finite.
TRG_RARE_FN Vec3 eval_program(const TextureSet& set, int32_t number, const TexturePoint& p) {
    float registers[kProgramRegisters];
    Machine m{set, p, p, registers};
    const Program& program = set.programs[number];
    for (int32_t k = 0; k < program.count; ++k) run_op(m, set.ops[program.first + k]);
    const float* value = m.registers + program.result;
    const auto finite = [](float x) { return std::isfinite(x) ? x : 0.0f; };
    return {finite(value[0]), finite(value[1]), finite(value[2])};
}

}  // namespace trg

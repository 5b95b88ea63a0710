/// Instructions that depend on the view or give a normal.
#pragma once

#include "shade/fresnel.h"
#include "shade/program_machine.h"

namespace trg {

TRG_FN float facing_weight(float cosine, float blend) {
    float f = std::fabs(cosine);
    if (blend != 0.5f) {
        const float b = smaller(larger(blend, 0.0f), 1.0f - 1e-5f);
        f = std::pow(f, b < 0.5f ? 2.0f * b : 0.5f / (1.0f - b));
    }
    return 1.0f - f;
}

/// A bumped normal (Mikkelsen 2010) from the heights here, along the frame's s and along its t.
TRG_FN Vec3 run_bump(const Machine& m, const ProgramOp& op) {
    const TexturePoint& p = m.home;
    const float here = number(m, op, 0), along_s = number(m, op, 1), along_t = number(m, op, 2);
    const float strength = larger(number(m, op, 3), 0.0f), distance = number(m, op, 4);
    const Vec3 n = vector(m, op, 5);
    const Frame frame = make_frame(p.flat);
    const float step = p.step * number(m, op, 6);
    const Vec3 rs = cross(frame.t, n), rt = cross(n, frame.s);
    const Vec3 gradient = (rs * (along_s - here) + rt * (along_t - here)) * (1.0f / step);
    const float det = dot(frame.s, rs);
    const Vec3 bumped =
        normalize_safe(n * std::fabs(det) - gradient * (det < 0.0f ? -distance : distance));
    if (is_black(bumped)) return n;
    return normalize_safe(bumped * strength + n * (1.0f - strength));
}

/// Normal Map of space 0 tangent (operand 2: tangent and sign), 1 object, 2
/// world; of 3 and 4, too, with y and z turned as Blender's baker had them.
TRG_FN Vec3 run_normal_map(const Machine& m, const ProgramOp& op) {
    const TexturePoint& p = m.here;
    Vec3 c = vector(m, op, 0) * 2.0f - Vec3{1.0f, 1.0f, 1.0f};
    const float strength = number(m, op, 1), side = p.outside ? 1.0f : -1.0f;
    Vec3 n;
    if (op.mode == 0) {
        const float* tangent = operand(m, op, 2);
        const Vec3 t{tangent[0], tangent[1], tangent[2]};
        if (is_black(t)) return p.normal;
        const Vec3 normal = normal_into(*p.instance, p.normal * side);
        c = {c.x * strength, c.y * strength, 1.0f + (c.z - 1.0f) * clamp01(strength)};
        n = t * c.x + cross(normal, t) * (tangent[3] * c.y) + normal * c.z;
        n = normal_out_of(*p.instance, n) * side;
    } else {
        if (op.mode > 2) c = {c.x, -c.y, -c.z};
        const bool local = op.mode == 1 || op.mode == 3;
        n = (local ? normal_out_of(*p.instance, c) : normalize_safe(c)) * side;
        n = normalize_safe(p.normal + (n - p.normal) * larger(strength, 0.0f));
    }
    return is_black(n) ? p.normal : n;
}

TRG_FN void run_surface(Machine& m, const ProgramOp& op) {
    const TexturePoint& p = m.here;
    switch (op.op) {
        case TextureOp::fresnel: {
            const float ior = larger(number(m, op, 0), 1e-5f);
            const float cosine = clamp01(std::fabs(dot(p.wo, vector(m, op, 1))));
            m.registers[op.out] = fresnel_dielectric(cosine, p.outside ? ior : 1.0f / ior);
            return;
        }
        case TextureOp::layer_weight: {
            const float blend = number(m, op, 0), cosine = dot(p.wo, vector(m, op, 1));
            const float ior = 1.0f / larger(1.0f - blend, 1e-5f);
            const float f =
                fresnel_dielectric(clamp01(std::fabs(cosine)), p.outside ? ior : 1.0f / ior);
            m.registers[op.out] = op.mode == 0 ? f : facing_weight(cosine, blend);
            return;
        }
        case TextureOp::bump:
            return store(m, op, run_bump(m, op));
        default:
            return store(m, op, run_normal_map(m, op));
    }
}

}  // namespace trg

/// Materials of the classic integrator: the paper's row of constants.
#pragma once

#include <cstdint>

#include "base/vec3.h"

namespace trg {

/// Ambient, diffuse and Phong constants, and what share of a ray is reflected and passes.
struct ClassicMaterial {
    Vec3 ambient, diffuse, specular;
    float power;  // of (R.L)
    Vec3 reflect, refract;
    float ior;
    float decay;          // of light inside, per unit of length
    float texture_share;  // a base texture times this takes the place of `diffuse`
};

}  // namespace trg

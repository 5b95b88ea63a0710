/// Builds the tree over many emitters.
#pragma once

#include <cstdint>
#include <vector>

#include "shade/light_tree.h"

namespace trg {

/// What the tree has to know of one emitter.
struct EmitterBounds {
    Vec3 low, high;
    Vec3 axis;            // unit; along which it shines
    float spread, reach;  // angles: of its axes, and how far beyond them it shines
    bool two_sided;
    double power;
    int32_t emitter;  // as LightNode::emitter
};

/// The nodes, root first; `emitters` (at least one) is left in another order.
std::vector<LightNode> build_light_tree(std::vector<EmitterBounds>& emitters);

}  // namespace trg

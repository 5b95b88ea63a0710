/// What `build_world` makes of a World: soups, and where they stand.
#pragma once

#include "accel/kernels.h"
#include "accel/soup.h"

namespace trg {

/// A soup placed in the world. The inverse map is kept in double, with the translation apart, so that
/// a small object far from the origin keeps its precision.
struct Placement {
    const Soup* soup;
    int32_t instance;   // -1: a merged soup, whose items tell
    bool identity;
    double inverse[3][3];
    double translation[3];
};

struct WorldIndex {
    TriangleTest triangle_test = TriangleTest::watertight;
    std::vector<std::unique_ptr<Soup>> soups;
    std::vector<Placement> placements;   // in the order of the leaves of `top`
    Tree top;                            // over placements; unused when there is only one
    Kernels kernels{};
};

}  // namespace trg

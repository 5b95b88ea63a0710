#include "accel/tree_build.h"

namespace trg {

double tree_cost(const Tree& tree) {
    double sum = 0;
    for (const WideNode& node : tree.nodes) {
        for (int lane = 0; lane < kWidth; ++lane) {
            if (node.child[lane] == kNoNode) continue;
            const auto& b = node.bound;
            sum += half_area({{b[0][0][lane], b[0][1][lane], b[0][2][lane]},
                              {b[1][0][lane], b[1][1][lane], b[1][2][lane]}});
        }
    }
    const double whole = half_area(tree.bounds);
    return whole > 0 ? sum / whole : 0;
}

}  // namespace trg

/// The tree of the TRG paper: boxes halved along their longest axis, equal numbers of triangles on
/// both sides, four triangles a leaf.
#pragma once

#include "accel/split.h"
#include "accel/tree_build.h"

namespace trg {

/// A node with two children, at `first` and after it, or a leaf (`leaf`), which is block `first`.
struct PairNode {
    float bound[2][3];  // low and high corner
    uint32_t first;
    uint32_t leaf;
};

struct PairTree {
    std::vector<PairNode> nodes;  // the root is node 0
    std::vector<LeafRange> leaves;
};

/// Triangles a leaf holds at most.
constexpr int64_t kPairLeaf = 4;

/// The tree over `refs`, which are put in the order of the leaves. At most 32 levels deep.
PairTree build_pair_tree(PrimRefs& refs);

}  // namespace trg

/// Building an eight-wide tree over boxes, top down, over several threads.
#pragma once

#include "accel/split.h"
#include "accel/wide_node.h"
#include "base/aligned.h"

namespace trg {

/// A run of `count` references from `begin` that became one leaf; leaf k is block k.
struct LeafRange {
    int64_t begin;
    int32_t count;
};

struct Tree {
    AlignedVector<WideNode> nodes;
    std::vector<LeafRange> leaves;
    NodeRef root = kNoNode;  // a leaf when there are few items, kNoNode when there are none
    Bounds bounds = empty_bounds();
};

/// The tree over `refs`, which are put in the order of the leaves, with gaps where items could be
/// but were not cut. A leaf is one block of at most `settings.block_width` items; an item that was
/// cut is in several. The tree does not depend on the number of threads.
Tree build_tree(PrimRefs& refs, const SplitSettings& settings);

/// What a random ray that meets the tree's box is expected to cost, in boxes met: the sum of all
/// boxes' surfaces over the surface of the whole; 0 without nodes.
double tree_cost(const Tree& tree);

}  // namespace trg

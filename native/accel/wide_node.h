/// Nodes of the eight-wide tree and the references that tie it together.
#pragma once

#include <cstdint>

namespace trg {

constexpr int kWidth = 8;

/// Boxes of up to eight children; bound[0] are the low, bound[1] the high corners, so that the sign
/// of a ray's direction chooses the near plane. Missing children have an inverted box.
struct alignas(64) WideNode {
    float bound[2][3][kWidth];
    uint32_t child[kWidth];
    uint32_t unused[kWidth];
};

/// A child is a node's index, or with kLeafBit the index of the one block of a leaf.
using NodeRef = uint32_t;
constexpr NodeRef kLeafBit = 0x80000000u;
constexpr NodeRef kNoNode = 0xffffffffu;
constexpr int64_t kMostBlocks = 0x7ffffffe;

/// Levels of a tree at most; with eight children a level it bounds the stack of a walk through two,
/// one of them in a leaf of the other.
constexpr int kMostLevels = 64;
constexpr int kStackSize = 2 * kMostLevels * (kWidth - 1) + kWidth;

}  // namespace trg

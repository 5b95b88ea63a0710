/// Triangles gathered under one index: those of one mesh, or of many meshes placed where they are.
#pragma once

#include "accel/grid.h"
#include "accel/tree_build.h"
#include "accel/triangle_block.h"

namespace trg {

/// Which triangle of which instance item k of a merged soup is.
struct PrimOrigin {
    int32_t instance;
    int32_t triangle;
};

/// Blocks of one of the two kinds under a tree, a grid, or nothing (every block is tried).
/// `prim` of a block is a triangle's index, or an index into `origins` when that is not empty.
struct Soup {
    AccelKind accel = AccelKind::none;
    Tree tree;
    Grid grid;
    AlignedVector<CornerBlock> corner_blocks;
    AlignedVector<PlaneBlock> plane_blocks;
    std::vector<PrimOrigin> origins;
    Bounds bounds = empty_bounds();
    int64_t triangles = 0;
    int64_t degenerate = 0;
};

struct SoupSettings {
    AccelKind accel;
    TriangleTest triangle_test;
    int threads;
};

/// The soup of one mesh in its own space.
Soup build_mesh_soup(const Mesh& mesh, const SoupSettings& settings);

/// The soup of the given instances, all of which have the identity transform.
Soup build_merged_soup(const World& world, const std::vector<int32_t>& instances,
                       const SoupSettings& settings);

int64_t soup_bytes(const Soup& soup);

}  // namespace trg

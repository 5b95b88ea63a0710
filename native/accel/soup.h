/// Triangles gathered under one index: those of one mesh, or of many meshes placed where they are.
#pragma once

#include "accel/grid_build.h"
#include "accel/pair_tree.h"
#include "accel/tree_build.h"
#include "accel/triangle_block.h"

namespace trg {

/// Which triangle of which instance item k of a merged soup is.
struct PrimOrigin {
    int32_t instance;
    int32_t triangle;
};

/// Blocks of one of the two kinds under one of the indices, or under nothing (every block is
/// tried). A soup of another shape than triangles is that shape alone and has none of them. `prim`
/// of a block is a triangle's index, or an index into `origins` when that is not empty.
struct Soup {
    Shape shape = Shape::triangles;
    AccelKind accel = AccelKind::none;
    Tree tree;
    PairTree pairs;
    GridIndex grid;
    AlignedVector<CornerBlock> corner_blocks;
    AlignedVector<PlaneBlock> plane_blocks;
    std::vector<PrimOrigin> origins;
    Bounds bounds = empty_bounds();
    int64_t triangles = 0;
    int64_t degenerate = 0;
    double built_cost = 0;  // of the tree when it was built
};

struct SoupSettings {
    AccelKind accel;
    TriangleTest triangle_test;
    int threads;
};

/// The soup of one mesh or other shape in its own space.
Soup build_mesh_soup(const Mesh& mesh, const SoupSettings& settings);

/// The soup of the given instances, all of which have the identity transform.
Soup build_merged_soup(const World& world, const std::vector<int32_t>& instances,
                       const SoupSettings& settings);

/// Takes the triangles from where the vertices are now (`mesh`; null: the soup is merged from
/// `world`) and fits the boxes of its tree to them. Returns how much the tree's cost has grown
/// since it was built. False instead of a number means that the soup must be built anew: it has no
/// tree, or triangles without area came or may have gone.
struct Refit {
    bool possible;
    double growth;
};
Refit refit_soup(Soup& soup, const World& world, const Mesh* mesh, int threads);

/// Nodes of the soup's tree, or cells of its grids.
int64_t soup_nodes(const Soup& soup);
int64_t soup_bytes(const Soup& soup);

}  // namespace trg

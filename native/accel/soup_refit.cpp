#include <atomic>

#include "accel/soup_source.h"
#include "base/parallel.h"

namespace trg {

namespace {

constexpr int64_t kGrain = 1 << 10;

/// Writes the triangles of block `block` anew; its box, empty when one of them has no area.
template <class Block>
Bounds repack_block(Block& block, const SoupSource& source) {
    Bounds box = empty_bounds();
    for (int lane = 0; lane < kWidth; ++lane) {
        const int32_t item = block.prim[lane];
        if (item < 0) continue;
        const TriangleCorners triangle = corners_of(source, item);
        if (!is_sound(triangle)) return empty_bounds();
        put_triangle(block, lane, triangle, item);
        box = united(box, box_of(triangle));
    }
    return box;
}

/// Boxes of all blocks, repacked; none at all when one of them is empty.
template <class Block>
std::vector<Bounds> repack_blocks(AlignedVector<Block>& blocks, const SoupSource& source,
                                  int threads) {
    std::vector<Bounds> boxes(blocks.size());
    std::atomic<bool> sound{true};
    parallel_for(static_cast<int64_t>(blocks.size()), kGrain, threads,
                 [&](int64_t begin, int64_t end) {
                     for (int64_t k = begin; k < end; ++k) {
                         boxes[k] = repack_block(blocks[k], source);
                         if (is_empty(boxes[k])) sound = false;
                     }
                 });
    if (!sound) boxes.clear();
    return boxes;
}

/// Fits the boxes below `ref`, children first; returns the box of it all.
Bounds fit_boxes(Tree& tree, NodeRef ref, const std::vector<Bounds>& blocks) {
    if (ref & kLeafBit) return blocks[ref & ~kLeafBit];
    Bounds all = empty_bounds();
    for (int lane = 0; lane < kWidth; ++lane) {
        const NodeRef child = tree.nodes[ref].child[lane];
        if (child == kNoNode) continue;
        const Bounds box = fit_boxes(tree, child, blocks);
        const float lo[3] = {box.lo.x, box.lo.y, box.lo.z}, hi[3] = {box.hi.x, box.hi.y, box.hi.z};
        for (int axis = 0; axis < 3; ++axis) {
            tree.nodes[ref].bound[0][axis][lane] = lo[axis];
            tree.nodes[ref].bound[1][axis][lane] = hi[axis];
        }
        all = united(all, box);
    }
    return all;
}

}  // namespace

Refit refit_soup(Soup& soup, const World& world, const Mesh* mesh, int threads) {
    if (soup.accel != AccelKind::bvh || soup.degenerate > 0) return {false, 0};
    const SoupSource source{&world, &soup.origins, mesh, soup.triangles};
    const std::vector<Bounds> boxes = soup.plane_blocks.empty()
                                          ? repack_blocks(soup.corner_blocks, source, threads)
                                          : repack_blocks(soup.plane_blocks, source, threads);
    if (boxes.empty()) return {false, 0};
    soup.bounds = soup.tree.bounds = fit_boxes(soup.tree, soup.tree.root, boxes);
    const double cost = tree_cost(soup.tree);
    return {true, soup.built_cost > 0 ? cost / soup.built_cost : 1};
}

}  // namespace trg

#include "accel/pair_tree.h"

#include <algorithm>

namespace trg {

namespace {

struct Part {
    int64_t begin, end;
    uint32_t node;
};

double centre_along(const PrimRef& ref, int axis) {
    return static_cast<double>((&ref.lo.x)[axis]) + (&ref.hi.x)[axis];
}

int longest_axis(const Bounds& box) {
    const double x = static_cast<double>(box.hi.x) - box.lo.x;
    const double y = static_cast<double>(box.hi.y) - box.lo.y;
    const double z = static_cast<double>(box.hi.z) - box.lo.z;
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

Bounds measure(const PrimRefs& refs, int64_t begin, int64_t end) {
    Bounds box = empty_bounds();
    for (int64_t k = begin; k < end; ++k) box = united(box, box_of(refs[k]));
    return box;
}

/// Moves the half of [begin, end) that lies lower along `axis` to the front; equal centres go by
/// item.
int64_t halve(PrimRefs& refs, int64_t begin, int64_t end, int axis) {
    const int64_t middle = begin + (end - begin) / 2;
    std::nth_element(refs.begin() + begin, refs.begin() + middle, refs.begin() + end,
                     [axis](const PrimRef& a, const PrimRef& b) {
                         const double x = centre_along(a, axis), y = centre_along(b, axis);
                         return x != y ? x < y : a.item < b.item;
                     });
    return middle;
}

}  // namespace

PairTree build_pair_tree(PrimRefs& refs) {
    PairTree tree;
    tree.nodes.push_back({});
    std::vector<Part> open{{0, static_cast<int64_t>(refs.size()), 0}};
    while (!open.empty()) {
        const Part part = open.back();
        open.pop_back();
        const Bounds box = measure(refs, part.begin, part.end);
        PairNode node{{{box.lo.x, box.lo.y, box.lo.z}, {box.hi.x, box.hi.y, box.hi.z}}, 0, 0};
        if (part.end - part.begin <= kPairLeaf) {
            node.leaf = 1;
            node.first = static_cast<uint32_t>(tree.leaves.size());
            tree.leaves.push_back({part.begin, static_cast<int32_t>(part.end - part.begin)});
        } else {
            const int64_t middle = halve(refs, part.begin, part.end, longest_axis(box));
            node.first = static_cast<uint32_t>(tree.nodes.size());
            tree.nodes.resize(tree.nodes.size() + 2);
            open.push_back({part.begin, middle, node.first});
            open.push_back({middle, part.end, node.first + 1});
        }
        tree.nodes[part.node] = node;
    }
    return tree;
}

}  // namespace trg

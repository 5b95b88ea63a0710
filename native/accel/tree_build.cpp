#include "accel/tree_build.h"

#include <algorithm>
#include <stdexcept>

#include "base/parallel.h"

namespace trg {

namespace {

/// Deeper than this, ranges are halved by count, so that the depth stays below kMostLevels.
constexpr int kDeepLevel = 30;
constexpr int64_t kSmallestTask = 4096;
constexpr int64_t kTasksPerTree = 64;

/// A subtree that is built apart, and the child slot of the upper tree that waits for it.
struct Task {
    PrimRange range;
    int level;
    uint32_t node;
    int lane;
};

struct Builder {
    std::vector<PrimRef>& refs;
    const SplitSettings settings;
    const int64_t task_size;      // ranges up to this size become tasks; 0: none does
    std::vector<Task> tasks;
    Tree tree;
};

int64_t item_count(const PrimRange& range) { return range.end - range.begin; }

NodeRef add_leaf(Builder& builder, const PrimRange& range) {
    const auto leaf = static_cast<uint32_t>(builder.tree.leaves.size());
    builder.tree.leaves.push_back({range.begin, static_cast<int32_t>(item_count(range))});
    return kLeafBit | leaf;
}

/// Opens the child of largest surface again and again until there are eight; returns how many.
int open_children(Builder& builder, const PrimRange& range, int level, PrimRange children[kWidth]) {
    children[0] = range;
    int count = 1;
    while (count < kWidth) {
        int widest = -1;
        double area = -1.0;
        for (int k = 0; k < count; ++k) {
            if (item_count(children[k]) <= builder.settings.block_width) continue;
            if (half_area(children[k].box) > area) {
                area = half_area(children[k].box);
                widest = k;
            }
        }
        if (widest < 0) break;
        PrimRange halves[2];
        if (level > kDeepLevel) split_by_count(builder.refs.data(), children[widest], halves);
        else split_range(builder.refs.data(), children[widest], builder.settings, halves);
        children[widest] = halves[0];
        children[count++] = halves[1];
    }
    return count;
}

void set_child_box(WideNode& node, int lane, const Bounds& box) {
    const float lo[3] = {box.lo.x, box.lo.y, box.lo.z}, hi[3] = {box.hi.x, box.hi.y, box.hi.z};
    for (int axis = 0; axis < 3; ++axis) {
        node.bound[0][axis][lane] = lo[axis];
        node.bound[1][axis][lane] = hi[axis];
    }
}

WideNode empty_node() {
    WideNode node{};
    for (int lane = 0; lane < kWidth; ++lane) {
        set_child_box(node, lane, empty_bounds());
        node.child[lane] = kNoNode;
    }
    return node;
}

NodeRef build_range(Builder& builder, const PrimRange& range, int level) {
    if (item_count(range) <= builder.settings.block_width) return add_leaf(builder, range);
    const auto index = static_cast<uint32_t>(builder.tree.nodes.size());
    builder.tree.nodes.push_back(empty_node());
    PrimRange children[kWidth];
    const int count = open_children(builder, range, level, children);
    for (int lane = 0; lane < count; ++lane) {
        set_child_box(builder.tree.nodes[index], lane, children[lane].box);
        if (item_count(children[lane]) <= builder.task_size) {
            builder.tasks.push_back({children[lane], level + 1, index, lane});
            continue;
        }
        const NodeRef child = build_range(builder, children[lane], level + 1);
        builder.tree.nodes[index].child[lane] = child;
    }
    return index;
}

NodeRef moved_ref(NodeRef ref, uint32_t node_shift, uint32_t leaf_shift) {
    if (ref == kNoNode) return ref;
    return ref + (ref & kLeafBit ? leaf_shift : node_shift);
}

/// Appends `part` to `tree`; returns the reference of its root there.
NodeRef append_tree(Tree& tree, const Tree& part) {
    const auto node_shift = static_cast<uint32_t>(tree.nodes.size());
    const auto leaf_shift = static_cast<uint32_t>(tree.leaves.size());
    for (WideNode node : part.nodes) {
        for (NodeRef& child : node.child) child = moved_ref(child, node_shift, leaf_shift);
        tree.nodes.push_back(node);
    }
    tree.leaves.insert(tree.leaves.end(), part.leaves.begin(), part.leaves.end());
    return moved_ref(part.root, node_shift, leaf_shift);
}

}  // namespace

Tree build_tree(std::vector<PrimRef>& refs, const SplitSettings& settings) {
    const auto count = static_cast<int64_t>(refs.size());
    if (count > kMostBlocks) throw std::length_error("more items than a tree can hold");
    if (count == 0) return {};

    // The upper part, whose large ranges are binned by all threads together.
    const PrimRange all = measure_range(refs.data(), 0, count);
    const int64_t task_size = std::max(kSmallestTask, count / kTasksPerTree);
    Builder upper{refs, settings, count > kSmallestTask ? task_size : 0, {}, {}};
    upper.tree.root = build_range(upper, all, 0);
    upper.tree.bounds = all.box;

    // The subtrees, a thread each, joined in the order of the tree.
    std::vector<Tree> parts(upper.tasks.size());
    parallel_for(static_cast<int64_t>(parts.size()), 1, settings.threads, [&](int64_t k, int64_t) {
        Builder lower{refs, {settings.block_width, 1}, 0, {}, {}};
        lower.tree.root = build_range(lower, upper.tasks[k].range, upper.tasks[k].level);
        parts[k] = std::move(lower.tree);
    });
    for (size_t k = 0; k < parts.size(); ++k) {
        const NodeRef child = append_tree(upper.tree, parts[k]);
        upper.tree.nodes[upper.tasks[k].node].child[upper.tasks[k].lane] = child;
        parts[k] = {};
    }
    return std::move(upper.tree);
}

}  // namespace trg

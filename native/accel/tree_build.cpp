#include "accel/tree_build.h"

#include <algorithm>
#include <stdexcept>

#include "accel/cut_split.h"
#include "base/parallel.h"

namespace trg {

namespace {

/// Deeper than this, ranges are halved by count, so that the depth stays below kMostLevels.
constexpr int kDeepLevel = 30;
constexpr int64_t kSmallestTask = 4096;
constexpr int64_t kTasksPerTree = 64;
constexpr double kSplinterWeight = 0.3;

/// A subtree that is built apart, and the child slot of the upper tree that waits for it.
struct Task {
    PrimRange range;
    int level;
    uint32_t node;
    int lane;
};

struct Builder {
    PrimRefs& refs;
    const SplitSettings settings;
    const int64_t task_size;  // ranges up to this size become tasks; 0: none does
    std::vector<Task> tasks;
    Tree tree;
};

int64_t item_count(const PrimRange& range) {
    return range.end - range.begin;
}

NodeRef add_leaf(Builder& builder, const PrimRange& range) {
    const auto leaf = static_cast<uint32_t>(builder.tree.leaves.size());
    builder.tree.leaves.push_back({range.begin, static_cast<int32_t>(item_count(range))});
    return kLeafBit | leaf;
}

/// The child to open next: the widest, where a small one whose leaves would not all find room in
/// the free slots counts for less, because its parts become nodes with few children. -1: all are
/// leaves.
int choose_child(const PrimRange children[kWidth], int count, int block_width) {
    const int64_t fits_one_node = int64_t{kWidth} * block_width * 7 / 8;
    const int64_t fits_free_slots = int64_t{kWidth + 1 - count} * block_width;
    int chosen = -1;
    double chosen_area = -1.0;
    for (int k = 0; k < count; ++k) {
        const int64_t items = item_count(children[k]);
        if (items <= block_width) continue;
        const bool splinters = items > fits_free_slots && items <= fits_one_node;
        const double area = half_area(children[k].box) * (splinters ? kSplinterWeight : 1.0);
        if (area <= chosen_area) continue;
        chosen = k;
        chosen_area = area;
    }
    return chosen;
}

/// Opens children of `range` until there are eight or only leaves; returns how many there are.
int open_children(Builder& builder, const PrimRange& range, int level, PrimRange children[kWidth]) {
    children[0] = range;
    int count = 1;
    while (count < kWidth) {
        const int opened = choose_child(children, count, builder.settings.block_width);
        if (opened < 0) break;
        PrimRange halves[2];
        if (level > kDeepLevel)
            split_by_count(builder.refs.data(), children[opened], halves);
        else
            split_range(builder.refs.data(), children[opened], builder.settings, halves);
        children[opened] = halves[0];
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

/// Where the nodes and leaves of a part begin in the whole.
struct Shift {
    uint32_t nodes, leaves;
};

/// Copies `part` into its place in `tree`.
void place_part(const Tree& part, const Shift& shift, Tree& tree) {
    for (size_t k = 0; k < part.nodes.size(); ++k) {
        WideNode& node = tree.nodes[shift.nodes + k];
        node = part.nodes[k];
        for (NodeRef& child : node.child) child = moved_ref(child, shift.nodes, shift.leaves);
    }
    std::copy(part.leaves.begin(), part.leaves.end(), tree.leaves.begin() + shift.leaves);
}

/// Joins the parts, one for each task, to the upper tree in the order of the tasks.
void join_parts(Builder& upper, std::vector<Tree>& parts) {
    Tree& tree = upper.tree;
    std::vector<Shift> shifts;
    size_t nodes = tree.nodes.size(), leaves = tree.leaves.size();
    for (size_t k = 0; k < parts.size(); ++k) {
        shifts.push_back({static_cast<uint32_t>(nodes), static_cast<uint32_t>(leaves)});
        const NodeRef root = moved_ref(parts[k].root, shifts[k].nodes, shifts[k].leaves);
        tree.nodes[upper.tasks[k].node].child[upper.tasks[k].lane] = root;
        nodes += parts[k].nodes.size();
        leaves += parts[k].leaves.size();
    }
    tree.nodes.resize(nodes);
    tree.leaves.resize(leaves);
    parallel_for(static_cast<int64_t>(parts.size()), 1, upper.settings.threads,
                 [&](int64_t k, int64_t) {
                     place_part(parts[k], shifts[k], tree);
                     parts[k] = {};
                 });
}

/// What the ranges of a tree over `all` are divided by: cuts need room.
SplitSettings settings_for(const SplitSettings& settings, const PrimRange& all, int threads) {
    return {settings.block_width, threads, all.room > 0 ? settings.corners : nullptr,
            half_area(all.box)};
}

}  // namespace

Tree build_tree(PrimRefs& refs, const SplitSettings& settings) {
    const auto count = static_cast<int64_t>(refs.size());
    if (count > kMostBlocks) throw std::length_error("more items than a tree can hold");
    if (count == 0) return {};

    // The upper part, whose large ranges are binned by all threads together.
    PrimRange all = measure_range(refs.data(), 0, count, settings.threads);
    all.room = settings.corners ? measure_needs(refs, all.box, settings) : 0;
    const SplitSettings upper_settings = settings_for(settings, all, settings.threads);
    refs.resize(count + all.room);
    const int64_t task_size = std::max(kSmallestTask, count / kTasksPerTree);
    Builder upper{refs, upper_settings, count > kSmallestTask ? task_size : 0, {}, {}};
    upper.tree.root = build_range(upper, all, 0);
    upper.tree.bounds = all.box;

    // The subtrees, a thread each.
    std::vector<Tree> parts(upper.tasks.size());
    const SplitSettings lower_settings = settings_for(settings, all, 1);
    parallel_for(static_cast<int64_t>(parts.size()), 1, settings.threads, [&](int64_t k, int64_t) {
        const Task& task = upper.tasks[k];
        Builder lower{refs, lower_settings, 0, {}, {}};
        lower.tree.nodes.reserve(item_count(task.range) / (2 * settings.block_width) + 1);
        lower.tree.leaves.reserve(item_count(task.range) / (settings.block_width / 2 + 1) + 1);
        lower.tree.root = build_range(lower, task.range, task.level);
        parts[k] = std::move(lower.tree);
    });
    join_parts(upper, parts);
    return std::move(upper.tree);
}

}  // namespace trg

/// Rays of a batch that take turns: while the memory that one needs is fetched, the others go on.
///
/// A ray alone in a tree that no cache holds waits at nearly every node. Here each of kInFlight
/// rays takes one step (a node, or a leaf), asks for the memory of its next step, and lets the
/// others step. The steps and decisions are those of a ray alone, in the same order, so answers are
/// the same bits. (Lookahead by software prefetch: e.g. Kim et al., PVLDB 2009, for index trees.)
#pragma once

#include "accel/trace_world.h"

namespace trg::TRG_ISA {

constexpr int kInFlight = 8;

/// Rays of a batch that may wait for their turn.
constexpr int kMostWaiting = 256;

/// Worlds smaller than this lie in caches well enough that turns cost more than they save.
constexpr int64_t kCachedBytes = int64_t{16} << 20;

/// Stands in the stack between the subtrees of a placed soup and those of the top level.
constexpr NodeRef kLeaveSoup = kNoNode;

/// A ray on its way through a world. `blocks` is null while it walks the top level.
template <class Block>
struct StreamRay {
    TracedRay world, local;   // local: in the space of a placed soup
    const TracedRay* traced;  // the one of these that walks
    NodeTest<QuickBoxTest> test;
    const WideNode* nodes;
    const Block* blocks;
    Search search;
    NodeRef ref;
    int number;  // in the batch
    float scale;
    WalkStack stack;
};

/// What a step leaves a ray to do.
enum class Turn { go_on, pop, met };

TRG_FN bool takes_streams(const WorldIndex& index) {
    return index.bytes > kCachedBytes && !index.placements.empty() && !index.moving;
}

template <class Block>
TRG_INLINE_FN void fetch_next(const WorldIndex& index, const StreamRay<Block>& ray) {
    const NodeRef ref = ray.ref, leaf = ref & ~kLeafBit;
    const void* next = ray.nodes + ref;
    if (ref & kLeafBit)
        next = ray.blocks ? static_cast<const void*>(ray.blocks + leaf)
                          : static_cast<const void*>(index.placements.data() + leaf);
    constexpr int kLine = 64, kLines = 5;
    for (int line = 0; line < kLines; ++line)
        prefetch(static_cast<const char*>(next) + line * kLine);
}

/// Makes `traced`, one of the ray's own, walk `tree`; false when its box test is not for that ray.
template <class Block>
TRG_FN bool enter_tree(StreamRay<Block>& ray, const TracedRay& traced, const Tree& tree) {
    const RayBounds bounds = bounds_of(traced);
    if (!QuickBoxTest::fits(bounds)) return false;
    ray.test = NodeTest<QuickBoxTest>(bounds);
    ray.traced = &traced;
    ray.nodes = tree.nodes.data();
    ray.ref = tree.root;
    return true;
}

/// Makes the ray walk a placed soup, where that is a tree; false, with nothing changed, elsewhere.
template <class Block>
TRG_FN bool enter_soup(StreamRay<Block>& ray, const Placement& placement) {
    const Soup& soup = *placement.soup;
    if (soup.shape != Shape::triangles || soup.accel != AccelKind::bvh) return false;
    if (!placement.identity) ray.local = enter_placement(placement, ray.world);
    if (!enter_tree(ray, placement.identity ? ray.world : ray.local, soup.tree)) return false;
    ray.blocks = blocks_of(soup, static_cast<const Block*>(nullptr));
    ray.search.current = &placement;
    return true;
}

template <class Block>
TRG_FN bool enter_top(const WorldIndex& index, StreamRay<Block>& ray) {
    ray.blocks = nullptr;
    return enter_tree(ray, ray.world, index.top);
}

/// Readies ray k of the batch; false when it is better traced alone.
template <class Block, class Query>
TRG_FN bool start_ray(const Query& query, int k, StreamRay<Block>& ray) {
    const WorldIndex& index = query.index;
    if (!is_traceable(query.rays[k]) || !index.unbounded.empty()) return false;
    const ScaledRay scaled = scale_ray(query.rays[k]);
    ray.world = prepare_ray(scaled.ray.origin, scaled.ray.direction, scaled.ray.t_min);
    ray.scale = scaled.scale;
    ray.search = start_search(scaled.ray.t_max);
    ray.number = k;
    ray.stack.size = 0;
    return index.placements.size() == 1 ? enter_soup(ray, index.placements[0])
                                        : enter_top(index, ray);
}

template <class Block, class Query>
TRG_FN Turn visit_placement(const Query& query, StreamRay<Block>& ray) {
    const Placement& placement = query.index.placements[ray.ref & ~kLeafBit];
    if (!enter_soup(ray, placement)) return query.test(placement, ray) ? Turn::met : Turn::pop;
    ray.stack.ref[ray.stack.size] = kLeaveSoup;
    ray.stack.entry[ray.stack.size++] = -1.0f;  // never too far
    return Turn::go_on;
}

template <class Block, class Query>
TRG_INLINE_FN Turn visit_next(const Query& query, StreamRay<Block>& ray) {
    if (ray.ref & kLeafBit) {
        if (!ray.blocks) return visit_placement(query, ray);
        return query.test(ray.blocks[ray.ref & ~kLeafBit], ray) ? Turn::met : Turn::pop;
    }
    const WideNode& node = ray.nodes[ray.ref];
    const ChildHits hits = ray.test.meet(node, ray.search.limit);
    if (!hits.mask) return Turn::pop;
    if (!(hits.mask & (hits.mask - 1)))
        ray.ref = node.child[lowest_bit(hits.mask)];
    else if (Query::kAny)
        ray.ref = push_all_but_one(node, hits, ray.stack);
    else
        ray.ref = push_all_but_nearest(node, hits, ray.stack);
    return Turn::go_on;
}

/// Takes the next subtree from the stack; false when none is left.
template <bool kSorted, class Block>
TRG_INLINE_FN bool pop_next(const WorldIndex& index, StreamRay<Block>& ray) {
    WalkStack& stack = ray.stack;
    while (stack.size > 0) {
        --stack.size;
        if (stack.ref[stack.size] == kLeaveSoup) {
            enter_top(index, ray);
            continue;
        }
        if (kSorted && stack.entry[stack.size] > ray.search.limit) continue;
        ray.ref = stack.ref[stack.size];
        return true;
    }
    return false;
}

/// One step of a ray. False when it was the last, and the query knows the answer.
template <class Block, class Query>
TRG_INLINE_FN bool take_turn(const Query& query, StreamRay<Block>& ray) {
    const Turn turn = visit_next(query, ray);
    if (turn == Turn::met || (turn == Turn::pop && !pop_next<!Query::kAny>(query.index, ray))) {
        query.finish(ray, turn == Turn::met);
        return false;
    }
    fetch_next(query.index, ray);
    return true;
}

/// Traces the rays of the batch with these numbers.
template <class Block, class Query>
TRG_FN void trace_stream(const Query& query, const int* numbers, int count) {
    StreamRay<Block> rays[kInFlight];
    StreamRay<Block>* live[kInFlight];
    int next = 0, living = 0;
    const auto refill = [&](StreamRay<Block>& ray) {
        while (next < count) {
            const int k = numbers[next++];
            if (start_ray(query, k, ray)) return true;
            query.alone(k);
        }
        return false;
    };
    for (StreamRay<Block>& ray : rays)
        if (refill(ray)) live[living++] = &ray;
    while (living > 0)
        for (int k = 0; k < living;)
            if (take_turn(query, *live[k]) || refill(*live[k]))
                ++k;
            else
                live[k] = live[--living];
}

}  // namespace trg::TRG_ISA

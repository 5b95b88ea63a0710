/// Tracing of batches of rays; compiled once per instruction set.
#include "accel/kernels.h"
#include "accel/trace_packet_world.h"
#include "accel/trace_stream.h"
#include "accel/trace_world.h"

namespace trg::TRG_ISA {

TRG_FN float time_of(const float* times, int k) {
    return times ? times[k] : kMiddleTime;
}

/// The nearest hits of a batch.
template <class Block>
struct ClosestQuery {
    static constexpr bool kAny = false;
    const WorldIndex& index;
    const Ray* rays;
    const float* times;  // null: all in the middle of the shutter
    Hit* hits;

    TRG_INLINE_METHOD void alone(int k) const {
        hits[k] = closest_hit<Block>(index, rays[k], {time_of(times, k)});
    }
    bool together(int k) const {
        return closest_hits(index, rays + k, times ? times + k : nullptr, hits + k);
    }
    bool test(const Placement& placement, StreamRay<Block>& ray) const {
        search_placement<Block>(placement, ray.world, ray.search);
        return false;
    }
    bool test(const Block& block, StreamRay<Block>& ray) const {
        test_closest(block, *ray.traced, ray.search);
        return false;
    }
    void finish(const StreamRay<Block>& ray, bool) const {
        hits[ray.number] = resolve_hit<Block>(ray.search, ray.world, ray.scale);
    }
};

/// Whether anything hides the rays of a batch.
template <class Block>
struct AnyQuery {
    static constexpr bool kAny = true;
    const WorldIndex& index;
    const Ray* rays;
    const float* times;
    uint8_t* hidden;

    TRG_INLINE_METHOD void alone(int k) const {
        hidden[k] = is_hidden<Block>(index, rays[k], {time_of(times, k)});
    }
    bool together(int k) const {
        return are_hidden(index, rays + k, times ? times + k : nullptr, hidden + k);
    }
    bool test(const Placement& placement, StreamRay<Block>& ray) const {
        return placement_hides<Block>(placement, ray.world, ray.search.t);
    }
    bool test(const Block& block, StreamRay<Block>& ray) const {
        return test_any(block, *ray.traced, ray.search.t);
    }
    void finish(const StreamRay<Block>& ray, bool met) const { hidden[ray.number] = met; }
};

/// Packets where rays go together; the others in turns where the world is large, else one by one.
template <class Block, class Query>
TRG_FN void trace_batch(const Query& query, int count) {
    const bool packets = takes_packets(query.index);
    const bool streams = takes_streams(query.index);
    int waiting[kMostWaiting];
    int waiters = 0;
    for (int k = 0; k < count;) {
        const int end = count - k < kPacketRays ? count : k + kPacketRays;
        if (packets && end - k == kPacketRays && query.together(k)) {
            k = end;
            continue;
        }
        for (; k < end; ++k)
            if (streams)
                waiting[waiters++] = k;
            else
                query.alone(k);
        if (waiters > kMostWaiting - kPacketRays) {
            trace_stream<Block>(query, waiting, waiters);
            waiters = 0;
        }
    }
    trace_stream<Block>(query, waiting, waiters);
}

TRG_FN RayTag tag_of(const RayTags& tags, int k) {
    return {time_of(tags.times, k), tags.masks ? tags.masks[k] : kEveryRay};
}

/// Rays that not everything is visible to go one by one.
template <class Block>
TRG_FN void trace_closest(const WorldIndex& index, const RayBatch& batch, Hit* hits) {
    const float* times = index.moving ? batch.tags.times : nullptr;
    if (!index.masked)
        return trace_batch<Block>(ClosestQuery<Block>{index, batch.rays, times, hits}, batch.count);
    for (int k = 0; k < batch.count; ++k)
        hits[k] = closest_hit<Block>(index, batch.rays[k], tag_of(batch.tags, k));
}

template <class Block>
TRG_FN void trace_any(const WorldIndex& index, const RayBatch& batch, uint8_t* hidden) {
    const float* times = index.moving ? batch.tags.times : nullptr;
    if (!index.masked)
        return trace_batch<Block>(AnyQuery<Block>{index, batch.rays, times, hidden}, batch.count);
    for (int k = 0; k < batch.count; ++k)
        hidden[k] = is_hidden<Block>(index, batch.rays[k], tag_of(batch.tags, k));
}

TRG_FN void find_closest(const WorldIndex& index, const RayBatch& batch, Hit* hits) {
    if (index.triangle_test == TriangleTest::classic)
        trace_closest<PlaneBlock>(index, batch, hits);
    else
        trace_closest<CornerBlock>(index, batch, hits);
}

TRG_FN void find_any(const WorldIndex& index, const RayBatch& batch, uint8_t* hidden) {
    if (index.triangle_test == TriangleTest::classic)
        trace_any<PlaneBlock>(index, batch, hidden);
    else
        trace_any<CornerBlock>(index, batch, hidden);
}

TRG_FN Hit find_beyond(const WorldIndex& index, const Ray& ray, RayTag tag, const Hit& met) {
    return index.triangle_test == TriangleTest::classic
               ? hit_beyond<PlaneBlock>(index, ray, tag, met)
               : hit_beyond<CornerBlock>(index, ray, tag, met);
}

Kernels trace_kernels() {
    return {find_closest, find_any, find_beyond};
}

}  // namespace trg::TRG_ISA

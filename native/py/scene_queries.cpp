#include "py/scene_queries.h"

#include "base/parallel.h"
#include "py/buffer.h"
#include "py/scene_object.h"

namespace trg::py {

namespace {

/// Rays of one thread's turn; small enough to live on the stack.
constexpr int kChunk = 256;
constexpr int64_t kGrain = 16 * kChunk;

/// The arrays of rays as they came from Python.
struct RayArrays {
    Buffer origins, directions, t_min, t_max;
    int64_t count() const { return origins.extent(0); }
};

RayArrays take_rays(PyObject* const objects[4]) {
    RayArrays rays;
    rays.origins = Buffer::of<float>(objects[0], "origins", {kAnyExtent, 3});
    const int64_t count = rays.origins.extent(0);
    rays.directions = Buffer::of<float>(objects[1], "directions", {count, 3});
    rays.t_min = Buffer::of<float>(objects[2], "tmin", {count});
    rays.t_max = Buffer::of<float>(objects[3], "tmax", {count});
    return rays;
}

void gather_rays(const RayArrays& arrays, int64_t begin, int count, Ray* rays) {
    const float* o = arrays.origins.data<float>() + 3 * begin;
    const float* d = arrays.directions.data<float>() + 3 * begin;
    const float* t_min = arrays.t_min.data<float>() + begin;
    const float* t_max = arrays.t_max.data<float>() + begin;
    for (int k = 0; k < count; ++k, o += 3, d += 3)
        rays[k] = {{o[0], o[1], o[2]}, t_min[k], {d[0], d[1], d[2]}, t_max[k]};
}

/// The arrays that a closest-hit query fills.
struct HitArrays {
    Buffer t, u, v, triangle, instance;
};

HitArrays take_hits(PyObject* const objects[5], int64_t count) {
    HitArrays hits;
    hits.t = Buffer::of<float>(objects[0], "t", {count}, Access::write);
    hits.u = Buffer::of<float>(objects[1], "u", {count}, Access::write);
    hits.v = Buffer::of<float>(objects[2], "v", {count}, Access::write);
    hits.triangle = Buffer::of<int32_t>(objects[3], "triangle", {count}, Access::write);
    hits.instance = Buffer::of<int32_t>(objects[4], "instance", {count}, Access::write);
    return hits;
}

/// Throws ArgumentError when what is written shares memory with anything else of the query.
void refuse_overlap(std::initializer_list<const Buffer*> outputs, const RayArrays& rays) {
    for (const Buffer* const* out = outputs.begin(); out != outputs.end(); ++out) {
        bool shared = false;
        for (const Buffer* in : {&rays.origins, &rays.directions, &rays.t_min, &rays.t_max})
            shared = shared || (*out)->overlaps(*in);
        for (const Buffer* const* other = outputs.begin(); other != out; ++other)
            shared = shared || (*out)->overlaps(**other);
        if (shared) throw ArgumentError("output arrays: expected memory that nothing else uses");
    }
}

void scatter_hits(const Hit* hits, int64_t begin, int count, HitArrays& arrays) {
    for (int k = 0; k < count; ++k) {
        arrays.t.mutable_data<float>()[begin + k] = hits[k].t;
        arrays.u.mutable_data<float>()[begin + k] = hits[k].u;
        arrays.v.mutable_data<float>()[begin + k] = hits[k].v;
        arrays.triangle.mutable_data<int32_t>()[begin + k] = hits[k].triangle;
        arrays.instance.mutable_data<int32_t>()[begin + k] = hits[k].instance;
    }
}

/// Calls `trace(begin, count)` for chunks of at most kChunk rays, over all threads, without the
/// GIL.
template <class Trace>
void for_each_chunk(int64_t ray_count, int threads, Trace trace) {
    const WithoutGil unlocked;
    parallel_for(ray_count, kGrain, threads, [&](int64_t begin, int64_t end) {
        for (int64_t at = begin; at < end; at += kChunk)
            trace(at, static_cast<int>(end - at < kChunk ? end - at : kChunk));
    });
}

PyObject* intersect_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        PyObject *in[4], *out[5];
        int threads = 0;
        const char* const names[] = {"origins", "directions", "tmin",     "tmax",    "t",    "u",
                                     "v",       "triangle",   "instance", "threads", nullptr};
        parse_arguments(args, kwargs, "OOOOOOOOO|i", names, &in[0], &in[1], &in[2], &in[3], &out[0],
                        &out[1], &out[2], &out[3], &out[4], &threads);
        check_threads(threads);
        const SceneUse use(self);
        const RayArrays arrays = take_rays(in);
        HitArrays results = take_hits(out, arrays.count());
        refuse_overlap({&results.t, &results.u, &results.v, &results.triangle, &results.instance},
                       arrays);
        for_each_chunk(arrays.count(), threads, [&](int64_t begin, int count) {
            Ray rays[kChunk];
            Hit hits[kChunk];
            gather_rays(arrays, begin, count, rays);
            intersect_closest(use.scene().world, rays, hits, count);
            scatter_hits(hits, begin, count, results);
        });
        return none();
    });
}

PyObject* occluded_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        PyObject *in[4], *out;
        int threads = 0;
        const char* const names[] = {"origins", "directions", "tmin", "tmax",
                                     "out",     "threads",    nullptr};
        parse_arguments(args, kwargs, "OOOOO|i", names, &in[0], &in[1], &in[2], &in[3], &out,
                        &threads);
        check_threads(threads);
        const SceneUse use(self);
        const RayArrays arrays = take_rays(in);
        Buffer hidden = Buffer::of<uint8_t>(out, "out", {arrays.count()}, Access::write);
        refuse_overlap({&hidden}, arrays);
        for_each_chunk(arrays.count(), threads, [&](int64_t begin, int count) {
            Ray rays[kChunk];
            gather_rays(arrays, begin, count, rays);
            intersect_any(use.scene().world, rays, hidden.mutable_data<uint8_t>() + begin, count);
        });
        return none();
    });
}

}  // namespace

PyMethodDef kSceneQueryMethods[] = {
    {"intersect", as_method(intersect_method), METH_VARARGS | METH_KEYWORDS,
     "intersect(origins, directions, tmin, tmax, t, u, v, triangle, instance, threads=0)\n\n"
     "Fills t (inf: miss), u, v, triangle and instance (-1: miss) with the nearest hits."},
    {"occluded", as_method(occluded_method), METH_VARARGS | METH_KEYWORDS,
     "occluded(origins, directions, tmin, tmax, out, threads=0)\n\n"
     "Sets out to 1 where a ray meets anything within its range."},
    {nullptr, nullptr, 0, nullptr}};

}  // namespace trg::py

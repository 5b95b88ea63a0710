/* Loops over Embree's C API (version 4) for benchmarks: what one call from Python does for all rays.
 * Compiled by benchmarks/embree_c.py; declares what it uses, so that no header is needed. */
#define _POSIX_C_SOURCE 199309L
#include <dlfcn.h>
#include <pthread.h>
#include <stdint.h>
#include <stddef.h>
#include <string.h>

enum { kPacket = 16, kMostThreads = 64 };
typedef struct {
    float org[3], tnear, dir[3], time, tfar;
    uint32_t mask, id, flags;
} Ray1;
typedef struct {
    float normal[3], u, v;
    uint32_t prim, geom, inst, inst_prim;
} Hit1;
typedef struct {
    _Alignas(16) Ray1 ray;
    Hit1 hit;
} RayHit1;
typedef struct {
    float org[3][kPacket], tnear[kPacket], dir[3][kPacket], time[kPacket], tfar[kPacket];
    uint32_t mask[kPacket], id[kPacket], flags[kPacket];
} Ray16;
typedef struct {
    float normal[3][kPacket], u[kPacket], v[kPacket];
    uint32_t prim[kPacket], geom[kPacket], inst[kPacket], inst_prim[kPacket];
} Hit16;
typedef struct {
    _Alignas(64) Ray16 ray;
    Hit16 hit;
} RayHit16;
typedef struct {
    int flags;
    uint32_t features;
    void *context, *filter, *function;
    void* reserved[4];
} Arguments;

typedef struct {
    void* (*new_device)(const char*);
    void (*release_device)(void*);
    void (*monitor)(void*, int (*)(void*, ptrdiff_t, int), void*);
    void* (*new_scene)(void*);
    void (*release_scene)(void*);
    void (*set_flags)(void*, int);
    void (*set_quality)(void*, int);
    void (*commit_scene)(void*);
    void* (*new_geometry)(void*, int);
    void* (*new_buffer)(void*, int, unsigned, int, size_t, size_t);
    void (*commit_geometry)(void*);
    unsigned (*attach)(void*, void*);
    void (*release_geometry)(void*);
    void (*intersect1)(void*, RayHit1*, Arguments*);
    void (*occluded1)(void*, Ray1*, Arguments*);
    void (*intersect16)(const int*, void*, RayHit16*, Arguments*);
    void (*occluded16)(const int*, void*, Ray16*, Arguments*);
} Api;

static Api api;

/* Loads the library at `path`; returns 0, or 1 when it or one of its functions is missing. */
int load_embree(const char* path) {
    static const char* const names[] = {
        "rtcNewDevice", "rtcReleaseDevice", "rtcSetDeviceMemoryMonitorFunction", "rtcNewScene",
        "rtcReleaseScene", "rtcSetSceneFlags", "rtcSetSceneBuildQuality", "rtcCommitScene",
        "rtcNewGeometry", "rtcSetNewGeometryBuffer", "rtcCommitGeometry", "rtcAttachGeometry",
        "rtcReleaseGeometry", "rtcIntersect1", "rtcOccluded1", "rtcIntersect16", "rtcOccluded16"};
    void* library = dlopen(path, RTLD_NOW);
    if (!library) return 1;
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        void* symbol = dlsym(library, names[k]);
        if (!symbol) return 1;
        memcpy((char*)&api + k * sizeof symbol, &symbol, sizeof symbol);
    }
    return 0;
}

static int count_bytes(void* total, ptrdiff_t bytes, int post) {
    (void)post;
    __atomic_fetch_add((int64_t*)total, bytes, __ATOMIC_RELAXED);
    return 1;
}

/* A device with `config`; *bytes counts what it holds. */
void* new_device(const char* config, int64_t* bytes) {
    void* device = api.new_device(config);
    api.monitor(device, count_bytes, bytes);
    return device;
}

void release_device(void* device) { api.release_device(device); }
void release_scene(void* scene) { api.release_scene(scene); }

typedef struct {
    const float* vertices;
    const int32_t* triangles;
    int64_t vertex_count, triangle_count;
    int quality, robust;
} MeshBuild;

/* A scene whose mesh is in place but whose tree is not built yet. */
void* new_scene(void* device, const MeshBuild* mesh) {
    enum { kTriangle = 0, kIndex = 0, kVertex = 1, kUint3 = 0x5003, kFloat3 = 0x9003, kRobust = 4 };
    void* scene = api.new_scene(device);
    api.set_flags(scene, mesh->robust ? kRobust : 0);
    api.set_quality(scene, mesh->quality);
    void* geometry = api.new_geometry(device, kTriangle);
    void* v = api.new_buffer(geometry, kVertex, 0, kFloat3, 12, (size_t)mesh->vertex_count);
    memcpy(v, mesh->vertices, 12 * (size_t)mesh->vertex_count);
    void* t = api.new_buffer(geometry, kIndex, 0, kUint3, 12, (size_t)mesh->triangle_count);
    memcpy(t, mesh->triangles, 12 * (size_t)mesh->triangle_count);
    api.commit_geometry(geometry);
    api.attach(scene, geometry);
    api.release_geometry(geometry);
    return scene;
}

void build_scene(void* scene) { api.commit_scene(scene); }

typedef struct {
    void* scene;
    const float *origins, *directions, *t_min, *t_max;
    float *t, *u, *v;
    int32_t* triangle;
    uint8_t* hidden;      /* any-hit queries fill this alone, closest-hit ones the four above */
    int64_t count;
    int packets, coherent, threads;
} Query;

static void put_ray1(const Query* q, int64_t k, Ray1* ray) {
    memcpy(ray->org, q->origins + 3 * k, 12);
    memcpy(ray->dir, q->directions + 3 * k, 12);
    ray->tnear = q->t_min[k];
    ray->tfar = q->t_max[k];
    ray->time = 0;
    ray->mask = ~0u;
    ray->id = ray->flags = 0;
}

static void trace_singles(const Query* q, int64_t begin, int64_t end, Arguments* arguments) {
    RayHit1 r;
    memset(&r, 0, sizeof r);
    for (int64_t k = begin; k < end; ++k) {
        put_ray1(q, k, &r.ray);
        if (q->hidden) {
            api.occluded1(q->scene, &r.ray, arguments);
            q->hidden[k] = r.ray.tfar < 0;
            continue;
        }
        r.hit.geom = r.hit.prim = r.hit.inst = ~0u;
        api.intersect1(q->scene, &r, arguments);
        const int hit = r.hit.geom != ~0u;
        q->t[k] = hit ? r.ray.tfar : __builtin_inff();
        q->u[k] = r.hit.u;
        q->v[k] = r.hit.v;
        q->triangle[k] = hit ? (int32_t)r.hit.prim : -1;
    }
}

static void put_ray16(const Query* q, int64_t begin, int lanes, RayHit16* r, int* valid) {
    for (int i = 0; i < kPacket; ++i) {
        const int64_t k = begin + (i < lanes ? i : 0);
        for (int axis = 0; axis < 3; ++axis) {
            r->ray.org[axis][i] = q->origins[3 * k + axis];
            r->ray.dir[axis][i] = q->directions[3 * k + axis];
        }
        r->ray.tnear[i] = q->t_min[k];
        r->ray.tfar[i] = q->t_max[k];
        r->ray.time[i] = 0;
        r->ray.mask[i] = ~0u;
        r->ray.id[i] = r->ray.flags[i] = 0;
        r->hit.geom[i] = r->hit.prim[i] = r->hit.inst[i] = ~0u;
        valid[i] = i < lanes ? -1 : 0;
    }
}

static void trace_packets(const Query* q, int64_t begin, int64_t end, Arguments* arguments) {
    RayHit16 r;
    _Alignas(64) int valid[kPacket];
    memset(&r, 0, sizeof r);
    for (int64_t at = begin; at < end; at += kPacket) {
        const int lanes = end - at < kPacket ? (int)(end - at) : kPacket;
        put_ray16(q, at, lanes, &r, valid);
        if (q->hidden) api.occluded16(valid, q->scene, &r.ray, arguments);
        else api.intersect16(valid, q->scene, &r, arguments);
        for (int i = 0; i < lanes; ++i) {
            if (q->hidden) {
                q->hidden[at + i] = r.ray.tfar[i] < 0;
                continue;
            }
            const int hit = r.hit.geom[i] != ~0u;
            q->t[at + i] = hit ? r.ray.tfar[i] : __builtin_inff();
            q->u[at + i] = r.hit.u[i];
            q->v[at + i] = r.hit.v[i];
            q->triangle[at + i] = hit ? (int32_t)r.hit.prim[i] : -1;
        }
    }
}

typedef struct {
    const Query* query;
    int64_t begin, end;
} Share;

static void* trace_share(void* data) {
    const Share* share = data;
    Arguments arguments;
    memset(&arguments, 0, sizeof arguments);
    arguments.features = ~0u;
    arguments.flags = share->query->coherent ? 1 << 16 : 0;
    if (share->query->packets) trace_packets(share->query, share->begin, share->end, &arguments);
    else trace_singles(share->query, share->begin, share->end, &arguments);
    return NULL;
}

/* Traces all rays of `query`, each thread an equal share. */
void trace(const Query* query) {
    Share shares[kMostThreads];
    pthread_t threads[kMostThreads];
    const int count = query->threads < kMostThreads ? query->threads : kMostThreads;
    for (int k = 0; k < count; ++k) {
        const Share share = {query, query->count * k / count / kPacket * kPacket,
                             k + 1 == count ? query->count
                                            : query->count * (k + 1) / count / kPacket * kPacket};
        shares[k] = share;
        if (k) pthread_create(&threads[k], NULL, trace_share, &shares[k]);
    }
    trace_share(&shares[0]);
    for (int k = 1; k < count; ++k) pthread_join(threads[k], NULL);
}

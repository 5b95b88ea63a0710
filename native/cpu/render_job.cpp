#include "cpu/render_job.h"

#include <algorithm>

#include "base/parallel.h"
#include "kernel/surface.h"

namespace trg {

namespace {

/// One sample of each replicate; with the tile's pixels, the paths of one wavefront.
constexpr int32_t kSamplesPerPass = kReplicates;

/// First sample of `pass`: 0, 1, 2, 4, then every eighth. The first passes are small, so that a
/// picture is there soon.
int64_t first_sample_of(int64_t pass) {
    if (pass > 3) return kSamplesPerPass * (pass - 3);
    return pass < 3 ? pass : 4;
}

int64_t count_passes(int64_t samples) {
    int64_t pass = samples > kSamplesPerPass ? 2 + samples / kSamplesPerPass : 0;
    while (first_sample_of(pass) < samples) ++pass;
    return pass;
}

/// Queues of 2048 paths fit the second-level cache; small pictures are cut finer, so that every
/// thread has work.
int32_t choose_tile_size(const PixelRect& rect, int threads) {
    const int64_t pixels =
        static_cast<int64_t>(rect.x_max - rect.x_min) * (rect.y_max - rect.y_min);
    int32_t size = 16;
    while (size > 4 && pixels < static_cast<int64_t>(size) * size * 4 * threads) size /= 2;
    return size;
}

/// How batches of the classic integrator are cut depends on the tile, and the order of its sums on
/// that: its tiles are those of four threads, however many there are.
int tiling_threads(const Scene& scene, const RenderRequest& request) {
    return scene.tables.is_classic ? 4 : resolve_threads(request.threads);
}

uint32_t most_per_replicate(int64_t samples) {
    return static_cast<uint32_t>(std::max<int64_t>(samples / kReplicates, 1));
}

}  // namespace

RenderJob::RenderJob(const Scene& scene, const RenderRequest& request)
    : request_(request),
      frozen_(scene),
      film_({request.rect, request.passes,
             request.is_allotted() ? std::max<int64_t>(request.samples, kReplicates)
                                   : request.samples,
             choose_tile_size(request.rect, tiling_threads(scene, request)),
             request.is_allotted()}),
      kernels_(choose_kernel_set(frozen_.features() |
                                     (request.passes.more.needs_kernels() ? kPasses : 0u) |
                                     (request.ruled ? kLimits : 0u),
                                 scene.world.isa, scene.tables.is_classic)),
      view_{frozen_.view(),      request.width,    request.height, request.seed,
            request.max_bounces, frozen_.passes(), request.rules},
      work_count_(count_passes(request.samples) * film_.tile_count()),
      start_(Clock::now()),
      end_(start_),
      allotment_(film_, {request.rmse, request.adaptive, most_per_replicate(request.samples)}) {
    view_.passes.layout = film_.pass_film().layout();
    const CameraView& camera = view_.scene.camera;
    view_.scene.pixel_spread =
        std::fabs(camera.right - camera.left) / static_cast<float>(request.width);
    const int threads =
        static_cast<int>(std::min<int64_t>(resolve_threads(request.threads), film_.tile_count()));
    const EmitterView& emitters = view_.scene.emitters;
    // The classic integrator asks one light at a time.
    const int32_t lights = scene.tables.is_classic
                               ? 1
                               : emitters.always_count + (emitters.pool_count > 0 ? 1 : 0) +
                                     (view_.scene.environment.sampled ? 1 : 0) +
                                     (request.passes.more.has(kAmbientOcclusion) ? 1 : 0);
    for (int k = 0; k < threads; ++k)
        storages_.emplace_back(film_.tile_pixels() * kSamplesPerPass, lights, request.passes.more);
    if (has(kernels_.features, kLimits))
        for (QueueStorage& storage : storages_) storage.add_limits();
    if (scene.tables.is_classic)
        for (QueueStorage& storage : storages_)
            storage.add_classic(std::min(request.max_bounces, kDeepestClassic));
    if (view_.scene.nested)
        for (QueueStorage& storage : storages_) storage.add_boundaries();
    running_ = threads;
    try {
        for (int k = 0; k < threads; ++k)
            threads_.emplace_back([this, k] { run_thread(storages_[k]); });
    } catch (...) {
        cancel();
        for (std::thread& thread : threads_) thread.join();
        throw;
    }
}

RenderJob::~RenderJob() {
    cancel();
    for (std::thread& thread : threads_) thread.join();
}

RenderJob::Work RenderJob::work_at(int64_t index) const {
    const int64_t pass = index / film_.tile_count();
    const int64_t first = first_sample_of(pass);
    const int64_t last = std::min(first_sample_of(pass + 1), request_.samples);
    return {static_cast<int>(index % film_.tile_count()), static_cast<uint32_t>(first),
            static_cast<int32_t>(last - first)};
}

void RenderJob::run_thread(QueueStorage& storage) {
    if (request_.is_allotted())
        run_allotted(storage);
    else
        run_evenly(storage);
    finish_thread();
}

void RenderJob::run_evenly(QueueStorage& storage) {
    while (!should_stop()) {
        const int64_t index = next_work_.fetch_add(1, std::memory_order_relaxed);
        if (index >= work_count_) break;
        const Work work = work_at(index);
        if (!wait_for_turn(work) || !render_work(work, storage)) break;
    }
}

/// True when the job is to end now, with what the film has.
bool RenderJob::should_stop() {
    if (cancelled_.load(std::memory_order_relaxed)) {
        note_stop(StopReason::cancel);
        return true;
    }
    if (!(request_.seconds > 0.0)) return false;
    // The first pass is always made: a picture with holes is none.
    const std::chrono::duration<double> spent = Clock::now() - start_;
    const int64_t pixels = static_cast<int64_t>(film_.width()) * film_.height();
    if (spent.count() < request_.seconds || pixel_samples_.load() < pixels) return false;
    note_stop(StopReason::time);
    return true;
}

/// The first reason counts.
void RenderJob::note_stop(StopReason reason) {
    StopReason none = StopReason::none;
    stopped_by_.compare_exchange_strong(none, reason);
}

void RenderJob::run_allotted(QueueStorage& storage) {
    TileTask task;
    while (take_task(&task)) {
        const bool whole = render_task(task, storage);
        if (whole) allotment_.record(task);
        const std::lock_guard<std::mutex> hold(plan_lock_);
        --busy_;
        exhausted_ = exhausted_ || !whole;
        planned_.notify_all();
    }
}

/// The next task; whoever finds none left and nobody at work makes the next round. False: the end.
bool RenderJob::take_task(TileTask* task) {
    std::unique_lock<std::mutex> hold(plan_lock_);
    while (!exhausted_ && !should_stop()) {
        if (next_task_ < tasks_.size()) {
            *task = tasks_[next_task_++];
            ++busy_;
            return true;
        }
        if (busy_ > 0) {
            planned_.wait_for(hold, std::chrono::milliseconds(20));
            continue;
        }
        tasks_ = allotment_.plan();
        next_task_ = 0;
        exhausted_ = tasks_.empty();
        if (exhausted_ && allotment_.error_met()) note_stop(StopReason::error);
        planned_.notify_all();
    }
    return false;
}

/// A half that will not count what comes is kept as it is.
void RenderJob::keep_snapshots(const TileTask& task) {
    Tile& tile = film_.tile(task.tile);
    const std::lock_guard<std::mutex> hold(tile.lock);
    for (int half = 0; half < 2; ++half) {
        if (task.counts[half]) continue;
        tile.halves[half].snapshots.push_back(film_.snapshot(tile, half));
        tile.halves[half].live = false;
    }
}

bool RenderJob::render_task(const TileTask& task, QueueStorage& storage) {
    keep_snapshots(task);
    const uint32_t end = task.target * kReplicates;
    for (uint32_t first = film_.tile(task.tile).samples_done; first < end; first += kReplicates)
        if (should_stop() || !render_work({task.tile, first, kReplicates}, storage)) return false;
    return true;
}

/// Another thread may still be at this tile's pass before: sums are made in one order only.
bool RenderJob::wait_for_turn(const Work& work) const {
    const Tile& tile = film_.tile(work.tile);
    while (tile.samples_published.load(std::memory_order_acquire) != work.first_sample) {
        if (cancelled_.load(std::memory_order_relaxed)) return false;
        std::this_thread::yield();
    }
    return true;
}

/// What the rays through the centres of the chunk's pixels meet goes into the film.
void RenderJob::render_centre(const Chunk& chunk, QueueStorage& storage, std::mutex& lock) {
    PathQueues queues = storage.view();
    render_depth(view_, chunk.pixels, chunk.pixel_count, queues, storage.depth());
    const std::lock_guard<std::mutex> hold(lock);
    if (request_.passes.depth) film_.set_depth(chunk.pixels, chunk.pixel_count, storage.depth());
    if (!request_.passes.more.needs_centre()) return;
    const PassView& passes = view_.passes;
    for (int32_t i = 0; i < chunk.pixel_count; ++i) {
        const Hit& hit = queues.hits[i];
        if (hit.triangle < 0) continue;
        const Ray& ray = queues.rays[i];
        const int32_t material = material_of(view_.scene, {hit.instance, hit.triangle});
        film_.pass_film().set_centre(
            film_.index_of(chunk.pixels[i]),
            {ray.origin + ray.direction * hit.t,
             passes.instance_ids ? passes.instance_ids[3 * hit.instance] : 0.0f,
             passes.material_ids ? passes.material_ids[2 * material] : 0.0f});
    }
}

/// Renders a tile's pass as one wavefront; the film takes all of it or, when cancelled, nothing.
bool RenderJob::render_work(const Work& work, QueueStorage& storage) {
    RayCounts counts{};
    Tile& tile = film_.tile(work.tile);
    PathQueues queues = storage.view();
    const int32_t pixel_count = static_cast<int32_t>(tile.pixels.size());
    const Chunk chunk{tile.pixels.data(), pixel_count, work.first_sample, work.samples};
    const bool with_centre =
        (request_.passes.depth || request_.passes.more.needs_centre()) && work.first_sample == 0;
    if (with_centre) render_centre(chunk, storage, tile.lock);
    if (!kernels_.render_chunk(view_, chunk, queues, cancelled_, &counts)) {
        note_stop(StopReason::cancel);
        return false;
    }
    counts.clamped = queues.limits.clamped;
    {
        const std::lock_guard<std::mutex> hold(tile.lock);
        film_.add(chunk, queues, view_.passes);
        tile.samples_done = work.first_sample + static_cast<uint32_t>(work.samples);
        tile.samples_published.store(tile.samples_done, std::memory_order_release);
    }
    pixel_samples_.fetch_add(static_cast<int64_t>(pixel_count) * work.samples,
                             std::memory_order_relaxed);
    finish_work(counts);
    return true;
}

void RenderJob::finish_work(const RayCounts& counts) {
    camera_rays_.fetch_add(counts.camera, std::memory_order_relaxed);
    shadow_rays_.fetch_add(counts.shadow, std::memory_order_relaxed);
    bounce_rays_.fetch_add(counts.bounce, std::memory_order_relaxed);
    cut_rays_.fetch_add(counts.cut, std::memory_order_relaxed);
    clamped_.fetch_add(counts.clamped, std::memory_order_relaxed);
}

void RenderJob::finish_thread() {
    const std::lock_guard<std::mutex> hold(lock_);
    if (--running_ > 0) return;
    note_stop(StopReason::samples);
    end_ = Clock::now();
    ended_.notify_all();
}

void RenderJob::cancel() {
    cancelled_.store(true, std::memory_order_relaxed);
}

RenderProgress RenderJob::wait(double timeout_s) {
    std::unique_lock<std::mutex> hold(lock_);
    ended_.wait_for(hold, std::chrono::duration<double>(timeout_s), [&] { return running_ == 0; });
    return progress();
}

RenderProgress RenderJob::progress() const {
    const int64_t pixels = static_cast<int64_t>(film_.width()) * film_.height();
    const int64_t done = pixel_samples_.load(std::memory_order_relaxed);
    const Clock::time_point until = running_ == 0 ? end_ : Clock::now();
    RenderProgress state{};
    state.done = running_ == 0;
    state.stopped_by = state.done ? stopped_by_.load() : StopReason::none;
    state.samples = done / pixels;
    state.target = request_.is_allotted()
                       ? int64_t{kReplicates} * most_per_replicate(request_.samples)
                       : request_.samples;
    state.seconds = std::chrono::duration<double>(until - start_).count();
    state.rays = {
        camera_rays_.load(std::memory_order_relaxed), shadow_rays_.load(std::memory_order_relaxed),
        bounce_rays_.load(std::memory_order_relaxed), cut_rays_.load(std::memory_order_relaxed),
        clamped_.load(std::memory_order_relaxed)};
    state.rejected_samples = film_.rejected();
    return state;
}

}  // namespace trg

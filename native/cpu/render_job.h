/// A render under way: a team of threads that fills a film tile by tile, pass by pass.
#pragma once

#include <chrono>
#include <condition_variable>
#include <thread>

#include "cpu/allotment.h"
#include "cpu/film.h"
#include "cpu/queue_storage.h"
#include "kernel/kernel_sets.h"
#include "scene/frozen_scene.h"

namespace trg {

struct RenderRequest {
    int32_t width, height;
    PixelRect rect;  // the part to render
    int64_t samples;
    uint32_t seed;
    int32_t max_bounces;
    int threads;  // 0: all cores
    FilmPasses passes;
    double seconds;  // wall-clock time after which the job stops; 0: no limit
    double rmse;     // error of the picture at which it stops; 0: no such stop
    bool adaptive;   // more samples where there is more noise
    PathRules rules;
    bool ruled;  // whether any of the rules can matter

    /// Whether halves of the replicates decide how many samples count.
    bool is_allotted() const { return rmse > 0.0 || adaptive; }
};

enum class StopReason : int { none, samples, time, error, cancel };

struct RenderProgress {
    bool done;
    StopReason stopped_by;  // none while it runs
    int64_t samples;        // a pixel, rounded down over the picture
    int64_t target;
    double seconds;
    RayCounts rays;
    int64_t rejected_samples;
};

class RenderJob {
  public:
    /// Starts at once. `scene` must be built, must outlive the job and must not change meanwhile.
    RenderJob(const Scene& scene, const RenderRequest& request);
    /// Cancels and waits for the threads.
    ~RenderJob();
    RenderJob(const RenderJob&) = delete;
    RenderJob& operator=(const RenderJob&) = delete;

    /// The state after at most `timeout_s`, sooner when the job ends.
    RenderProgress wait(double timeout_s);
    void cancel();
    const Film& film() const { return film_; }
    const char* kernel_set() const { return kernels_.name; }

  private:
    using Clock = std::chrono::steady_clock;
    struct Work {
        int tile;
        uint32_t first_sample;
        int32_t samples;
    };

    Work work_at(int64_t index) const;
    void run_thread(QueueStorage& storage);
    void run_evenly(QueueStorage& storage);
    void run_allotted(QueueStorage& storage);
    bool take_task(TileTask* task);
    bool render_task(const TileTask& task, QueueStorage& storage);
    void keep_snapshots(const TileTask& task);
    void render_centre(const Chunk& chunk, QueueStorage& storage, std::mutex& lock);
    bool render_work(const Work& work, QueueStorage& storage);
    bool wait_for_turn(const Work& work) const;
    bool should_stop();
    void note_stop(StopReason reason);
    void finish_thread();
    void finish_work(const RayCounts& counts);
    RenderProgress progress() const;

    RenderRequest request_;
    FrozenScene frozen_;
    Film film_;
    const KernelSet& kernels_;
    RenderView view_;
    int64_t work_count_;
    std::atomic<int64_t> next_work_{0};
    std::atomic<int64_t> pixel_samples_{0};
    std::atomic<int64_t> camera_rays_{0}, shadow_rays_{0}, bounce_rays_{0}, cut_rays_{0},
        clamped_{0};
    std::atomic<bool> cancelled_{false};
    std::atomic<StopReason> stopped_by_{StopReason::none};
    Clock::time_point start_;
    Clock::time_point end_;
    int running_ = 0;
    mutable std::mutex lock_;  // guards running_ and end_
    std::condition_variable ended_;

    Allotment allotment_;  // from here on: for allotted jobs, guarded by plan_lock_
    std::mutex plan_lock_;
    std::condition_variable planned_;
    std::vector<TileTask> tasks_;
    size_t next_task_ = 0;
    int busy_ = 0;
    bool exhausted_ = false;

    std::vector<QueueStorage> storages_;
    std::vector<std::thread> threads_;
};

}  // namespace trg

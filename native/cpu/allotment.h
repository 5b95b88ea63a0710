/// Who gets how many samples when a render may stop by its error: two halves of the replicates,
/// each of which is told by the other how far to go.
///
/// Half A (replicates 0 to 3) of a tile goes on from n to 2 n samples a replicate when the spread
/// of half B's replicates at n says that it pays, and the other way round. So how many samples of A
/// count is a function of B's random numbers alone, A's mean is independent of it and keeps its
/// expectation, and the picture, the plain mean of both halves, is unbiased; the spread of A's
/// replicates still estimates A's variance without bias. docs/decisions/stopping.md has the proof.
#pragma once

#include <vector>

#include "cpu/film.h"

namespace trg {

/// When a render may stop before it has all its samples.
struct StopRule {
    double rmse = 0.0;      // of the picture, linear; 0: never
    bool adaptive = false;  // tiles with more noise get more samples
    uint32_t samples = 0;   // most that a replicate gets
};

/// Takes one tile on to `target` samples a replicate; `counts` says which halves count them.
struct TileTask {
    int tile;
    uint32_t target;
    bool counts[2];
};

class Allotment {
  public:
    Allotment(const Film& film, const StopRule& rule);

    /// What to render next; empty when there is nothing more. All tasks of the last call must be
    /// done and recorded.
    std::vector<TileTask> plan();
    /// Notes the spread of a tile that has reached a task's target.
    void record(const TileTask& task);
    /// True when both halves have been told that the error is met.
    bool error_met() const { return frozen_[0] && frozen_[1]; }

  private:
    /// Spread of each half's replicate means at `samples`: mean sample variance of pixels and
    /// channels.
    struct Spread {
        uint32_t samples;
        double variance[2];
    };
    struct TileState {
        uint32_t wanted[2] = {0, 0};  // samples a replicate that count
        uint32_t reached = 0;
        std::vector<Spread> spreads;
    };
    struct Candidate {
        double gain;
        int tile;
    };

    std::vector<TileTask> plan_all(uint32_t samples);
    std::vector<TileTask> make_tasks();
    void choose(int half);
    void choose_evenly(int half);
    void want_double(int half, const std::vector<Candidate>& order, double mse);
    bool is_met(int half, double mse) const;
    double variance_seen(int tile, int half) const;
    std::vector<double> smooth_noise(int half) const;
    double picture_mse(int half) const;
    double mean_wanted(int half) const;
    double share(int tile) const;
    void settle(int tile, int half);

    const Film& film_;
    StopRule rule_;
    std::vector<TileState> tiles_;
    bool frozen_[2] = {false, false};
};

}  // namespace trg

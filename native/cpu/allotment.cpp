#include "cpu/allotment.h"

#include <algorithm>
#include <cmath>

namespace trg {

namespace {

/// Every tile has this many samples a replicate before anything is decided.
constexpr uint32_t kFirstDecision = 2;
/// Share of samples that one round of decisions may add, and the least that makes a round.
constexpr double kLargestRound = 0.35, kSmallestRound = 0.04;
/// No tile falls behind the mean by more than this: what it has not seen yet may still be there.
constexpr double kSmallestShare = 0.125;
/// A picture without any spread is believed from this many samples a replicate on.
constexpr uint32_t kBelieveConstant = 64;

uint32_t grow_evenly(uint32_t samples) {
    return samples + std::max(1u, samples / 4);
}

/// Mean over pixels and channels of the sample variance of the means of half `half`.
double half_variance(const Film& film, const Tile& tile, int half) {
    double total = 0.0;
    for (size_t slot = 0; slot < tile.pixels.size(); ++slot) {
        const double* first = film.live_sums(tile.pixels[slot], half * kHalfReplicates);
        for (int c = 0; c < 3; ++c) {
            double mean = 0.0, spread = 0.0;
            for (int r = 0; r < kHalfReplicates; ++r) mean += first[r * film.channels() + c];
            mean /= kHalfReplicates;
            for (int r = 0; r < kHalfReplicates; ++r) {
                const double off = first[r * film.channels() + c] - mean;
                spread += off * off;
            }
            total += spread / (kHalfReplicates - 1);
        }
    }
    const double n = tile.samples_done / kReplicates;
    return total / (n * n * 3.0 * static_cast<double>(tile.pixels.size()));
}

}  // namespace

Allotment::Allotment(const Film& film, const StopRule& rule)
    : film_(film), rule_(rule), tiles_(film.tile_count()) {
    rule_.samples = std::max(rule_.samples, 1u);
}

std::vector<TileTask> Allotment::plan() {
    const uint32_t first = std::min(kFirstDecision, rule_.samples);
    const uint32_t reached = tiles_[0].wanted[0];
    if (reached < first) return plan_all(reached == 0 ? 1 : first);
    while (!error_met()) {
        for (int half = 0; half < 2; ++half) choose(half);
        std::vector<TileTask> tasks = make_tasks();
        if (!tasks.empty()) return tasks;
        bool capped = true;
        for (const TileState& tile : tiles_)
            for (int half = 0; half < 2; ++half)
                capped = capped && (frozen_[half] || tile.wanted[half] >= rule_.samples);
        if (capped) break;
    }
    return {};
}

std::vector<TileTask> Allotment::plan_all(uint32_t samples) {
    for (TileState& tile : tiles_) tile.wanted[0] = tile.wanted[1] = samples;
    return make_tasks();
}

/// Brings the film to what is wanted: by what was rendered already, or by tasks.
std::vector<TileTask> Allotment::make_tasks() {
    std::vector<TileTask> tasks;
    for (int index = 0; index < film_.tile_count(); ++index) {
        TileState& state = tiles_[index];
        const uint32_t target = std::max(state.wanted[0], state.wanted[1]);
        for (int half = 0; half < 2; ++half)
            if (state.wanted[half] <= state.reached) settle(index, half);
        if (target > state.reached)
            tasks.push_back(
                {index, target, {state.wanted[0] == target, state.wanted[1] == target}});
    }
    return tasks;
}

/// Lets a half count what is wanted of it, all of which has been rendered.
void Allotment::settle(int index, int half) {
    Tile& tile = film_.tile(index);
    const std::lock_guard<std::mutex> hold(tile.lock);
    TileHalf& kept = tile.halves[half];
    const uint32_t wanted = tiles_[index].wanted[half];
    if (wanted == tiles_[index].reached) {
        kept.live = true;
        kept.snapshots.clear();
        return;
    }
    auto is_old = [&](const HalfSnapshot& one) { return one.samples < wanted; };
    kept.snapshots.erase(std::remove_if(kept.snapshots.begin(), kept.snapshots.end(), is_old),
                         kept.snapshots.end());
}

void Allotment::record(const TileTask& task) {
    const Tile& tile = film_.tile(task.tile);
    tiles_[task.tile].reached = task.target;
    tiles_[task.tile].spreads.push_back(
        {task.target, {half_variance(film_, tile, 0), half_variance(film_, tile, 1)}});
}

/// The variance of a replicate of the half that decides for `half`, where `half` stands.
double Allotment::variance_seen(int index, int half) const {
    const TileState& state = tiles_[index];
    for (const Spread& one : state.spreads)
        if (one.samples == state.wanted[half]) return one.variance[1 - half];
    return 0.0;
}

double Allotment::share(int index) const {
    return static_cast<double>(film_.tile(index).pixels.size()) /
           (static_cast<double>(film_.width()) * film_.height());
}

/// What the picture's mean squared error would be if both halves stood where `half` stands.
double Allotment::picture_mse(int half) const {
    double sum = 0.0;
    for (int index = 0; index < film_.tile_count(); ++index)
        sum += share(index) * variance_seen(index, half);
    return sum / kReplicates;
}

double Allotment::mean_wanted(int half) const {
    double sum = 0.0;
    for (int index = 0; index < film_.tile_count(); ++index)
        sum += share(index) * tiles_[index].wanted[half];
    return sum;
}

/// Variance of one sample of each tile, half its own and half the mean of its neighbourhood of
/// three by three: a rare event next door is likely here as well.
std::vector<double> Allotment::smooth_noise(int half) const {
    const int32_t columns = film_.tile_columns(), rows = film_.tile_count() / columns;
    std::vector<double> own(tiles_.size()), smooth(tiles_.size());
    for (int index = 0; index < film_.tile_count(); ++index)
        own[index] = variance_seen(index, half) * tiles_[index].wanted[half];
    for (int32_t y = 0; y < rows; ++y)
        for (int32_t x = 0; x < columns; ++x) {
            double sum = 0.0;
            int count = 0;
            for (int32_t v = std::max(y - 1, 0); v <= std::min(y + 1, rows - 1); ++v)
                for (int32_t u = std::max(x - 1, 0); u <= std::min(x + 1, columns - 1); ++u) {
                    sum += own[v * columns + u];
                    ++count;
                }
            smooth[y * columns + x] = 0.5 * own[y * columns + x] + 0.5 * sum / count;
        }
    return smooth;
}

bool Allotment::is_met(int half, double mse) const {
    if (!(rule_.rmse > 0.0) || mse > rule_.rmse * rule_.rmse) return false;
    return mse > 0.0 || mean_wanted(half) >= kBelieveConstant;
}

/// One round of decisions for `half`, by the other half's spread alone.
void Allotment::choose(int half) {
    if (frozen_[half]) return;
    const double mse = picture_mse(half);
    if (is_met(half, mse)) {
        frozen_[half] = true;
        return;
    }
    if (!rule_.adaptive || mse == 0.0) return choose_evenly(half);
    const std::vector<double> noise = smooth_noise(half);
    const double behind = kSmallestShare * mean_wanted(half);
    std::vector<Candidate> order;
    for (int index = 0; index < film_.tile_count(); ++index) {
        const double n = tiles_[index].wanted[half];
        if (n >= rule_.samples) continue;
        order.push_back({n < behind ? INFINITY : noise[index] / (n * n), index});
    }
    std::sort(order.begin(), order.end(), [](const Candidate& a, const Candidate& b) {
        return a.gain != b.gain ? a.gain > b.gain : a.tile < b.tile;
    });
    want_double(half, order, mse);
}

/// Doubles the tiles that gain most, until the round is full or the error foreseen is met.
void Allotment::want_double(int half, const std::vector<Candidate>& order, double mse) {
    const double all = mean_wanted(half), goal = rule_.rmse * rule_.rmse;
    double added = 0.0;
    for (const Candidate& one : order) {
        if (added >= kLargestRound * all) return;
        if (added >= kSmallestRound * all && mse <= goal && one.gain < INFINITY) return;
        TileState& state = tiles_[one.tile];
        const uint32_t before = state.wanted[half];
        mse -= share(one.tile) * variance_seen(one.tile, half) / (2.0 * kReplicates);
        state.wanted[half] = std::min(2 * before, rule_.samples);
        added += share(one.tile) * (state.wanted[half] - before);
    }
}

void Allotment::choose_evenly(int half) {
    for (TileState& tile : tiles_) {
        const uint32_t next =
            rule_.adaptive ? 2 * tile.wanted[half] : grow_evenly(tile.wanted[half]);
        tile.wanted[half] = std::min(next, rule_.samples);
    }
}

}  // namespace trg

/// Sums of samples of a picture, kept apart by replicate, tile by tile.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "cpu/pass_film.h"
#include "kernel/path_queues.h"

namespace trg {

/// A rectangle of pixels of the whole picture; maxima are exclusive.
struct PixelRect {
    int32_t x_min, y_min, x_max, y_max;
};

/// A sample that was no number: which of which pixel of the whole picture.
struct RejectedSample {
    int32_t x, y;
    int64_t sample;
};

/// So many rejected samples are remembered: the first by number, row and column.
constexpr size_t kRejectedPlaces = 16;

struct FilmPasses {
    bool depth = false;
    bool normal = false;
    bool alpha = false;
    PassRequest more;
};

/// Replicates of one half, in a film whose halves decide for each other (cpu/allotment.h).
constexpr int kHalfReplicates = kReplicates / 2;

/// Sums of one half of a tile when each of its replicates had `samples`.
struct HalfSnapshot {
    uint32_t samples;
    std::vector<double> sums;  // pixel, replicate of the half, channel
};

/// What of a half counts: everything that was rendered, or the first of its snapshots.
struct TileHalf {
    bool live = true;
    std::vector<HalfSnapshot> snapshots;
};

/// Pixels of one tile. `samples_done` only grows; `lock` guards it, the halves and the tile's part
/// of the sums.
struct Tile {
    std::vector<Pixel> pixels;
    uint32_t samples_done = 0;
    std::atomic<uint32_t> samples_published{0};  // samples_done, to be read without the lock
    TileHalf halves[2];
    std::mutex lock;
};

/// Samples of a tile that belong to `replicate`.
inline int64_t replicate_count(uint32_t samples_done, int replicate) {
    return samples_done / kReplicates +
           (static_cast<uint32_t>(replicate) < samples_done % kReplicates ? 1 : 0);
}

/// What counts of one pixel: sums and samples of each replicate.
struct PixelSums {
    const double* sums[kReplicates];
    double counts[kReplicates];
};

/// How a film is laid out.
struct FilmLayout {
    PixelRect rect;
    FilmPasses passes;
    int64_t samples;    // bounds the replicates that need room
    int32_t tile_size;  // pixels along a side
    bool halved;        // two halves of replicates may count unequally many samples
};

class Film {
  public:
    explicit Film(const FilmLayout& layout);

    int32_t width() const { return layout_.rect.x_max - layout_.rect.x_min; }
    int32_t height() const { return layout_.rect.y_max - layout_.rect.y_min; }
    int32_t tile_columns() const;
    int tile_count() const { return tile_count_; }
    /// Most pixels that a tile has.
    int32_t tile_pixels() const { return layout_.tile_size * layout_.tile_size; }
    Tile& tile(int index) const { return tiles_[index]; }
    int replicates() const { return replicates_; }
    bool halved() const { return layout_.halved; }
    int64_t rejected() const { return rejected_.load(std::memory_order_relaxed); }
    /// The first of them, at most kRejectedPlaces, by sample, row and column.
    std::vector<RejectedSample> rejected_places() const;
    const FilmPasses& passes() const { return layout_.passes; }
    /// Samples that every tile has.
    uint32_t least_samples() const;
    /// Replicates that have a sample in every tile.
    int complete_replicates() const {
        return static_cast<int>(std::min<uint32_t>(least_samples(), replicates_));
    }

    /// Adds finished paths of `tile`, which the caller has locked; what is not finite is counted
    /// and dropped.
    void add(const Chunk& chunk, const PathQueues& queues, const PassView& view);
    PassFilm& pass_film() { return pass_film_; }
    void set_depth(const Pixel* pixels, int32_t count, const float* depth);

    /// What counts at pixel `slot` of `tile`, whose lock the caller holds: the first
    /// min(samples_done, 8) replicates. Three channels at each pointer.
    PixelSums counted(const Tile& tile, int32_t slot) const;
    /// What was rendered of a replicate, whether it counts or not; those after it follow.
    const double* live_sums(Pixel pixel, int replicate) const {
        return &sums_[(index_of(pixel) * replicates_ + replicate) * channels_];
    }
    int channels() const { return channels_; }
    /// Copies what a half has now; the caller holds the tile's lock.
    HalfSnapshot snapshot(const Tile& tile, int half) const;

    int64_t index_of(Pixel pixel) const {
        return static_cast<int64_t>(pixel.y - layout_.rect.y_min) * width() +
               (pixel.x - layout_.rect.x_min);
    }

    /// Pictures of what is there now; 0 where a tile has no sample yet. Row 0 is the bottom row.
    void read_combined(float* out) const;
    void read_normal(float* out) const;
    void read_depth(float* out) const;
    /// (h, w, channels) of a pass that was asked for.
    void read_pass(PassKind kind, float* out) const;
    const PassFilm& pass_film() const { return pass_film_; }
    /// (8, h, w, 3) sums and (8,) samples that every tile has. The sums of tiles that are further
    /// ahead are scaled down to these; sums / samples are still the means of all their samples.
    void read_replicates(double* sums, int64_t* counts) const;

  private:
    void make_tiles();
    void reject(Pixel pixel, int64_t sample);
    void add_result(int64_t at, int replicate, const PathResult& result);

    FilmLayout layout_;
    int replicates_;
    int channels_;  // three of light, then the camera rays that hit when alpha is asked for
    int tile_count_ = 0;
    std::unique_ptr<Tile[]> tiles_;
    std::vector<double> sums_, normals_;
    std::vector<float> depth_;
    PassFilm pass_film_;
    std::atomic<int64_t> rejected_{0};
    std::vector<RejectedSample> rejected_places_;
    mutable std::mutex rejected_lock_;  // guards rejected_places_
};

}  // namespace trg

/// Sums of samples of a picture, kept apart by replicate, tile by tile.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "kernel/path_queues.h"

namespace trg {

/// A rectangle of pixels of the whole picture; maxima are exclusive.
struct PixelRect {
    int32_t x_min, y_min, x_max, y_max;
};

struct FilmPasses {
    bool depth = false;
    bool normal = false;
    bool alpha = false;
};

/// Pixels of one tile. `samples_done` only grows; `lock` guards it and the tile's part of the sums.
struct Tile {
    std::vector<Pixel> pixels;
    uint32_t samples_done = 0;
    std::atomic<uint32_t> samples_published{0};  // samples_done, to be read without the lock
    std::mutex lock;
};

/// Samples of a tile that belong to `replicate`.
inline int64_t replicate_count(uint32_t samples_done, int replicate) {
    return samples_done / kReplicates +
           (static_cast<uint32_t>(replicate) < samples_done % kReplicates ? 1 : 0);
}

class Film {
  public:
    /// `samples` bounds the replicates that need room.
    Film(const PixelRect& rect, const FilmPasses& passes, int64_t samples, int32_t tile_size);

    int32_t width() const { return rect_.x_max - rect_.x_min; }
    int32_t height() const { return rect_.y_max - rect_.y_min; }
    int tile_count() const { return tile_count_; }
    /// Most pixels that a tile has.
    int32_t tile_pixels() const { return tile_size_ * tile_size_; }
    Tile& tile(int index) const { return tiles_[index]; }
    int replicates() const { return replicates_; }
    int64_t rejected() const { return rejected_.load(std::memory_order_relaxed); }
    const FilmPasses& passes() const { return passes_; }

    /// Adds finished paths of `tile`, which the caller has locked; what is not finite is counted
    /// and dropped.
    void add(const Chunk& chunk, const PathResult* results);
    void set_depth(const Pixel* pixels, int32_t count, const float* depth);

    /// The sums of `replicate` at `pixel`: three numbers.
    const double* sums(Pixel pixel, int replicate) const {
        return &sums_[(index_of(pixel) * replicates_ + replicate) * 3];
    }
    int64_t index_of(Pixel pixel) const {
        return static_cast<int64_t>(pixel.y - rect_.y_min) * width() + (pixel.x - rect_.x_min);
    }

    /// Pictures of what is there now; 0 where a tile has no sample yet. Row 0 is the bottom row.
    void read_combined(float* out) const;
    void read_normal(float* out) const;
    void read_depth(float* out) const;
    /// (8, h, w, 3) sums and (8,) samples that every tile has. The sums of tiles that are further
    /// ahead are scaled down to these; sums / samples are still the means of all their samples.
    void read_replicates(double* sums, int64_t* counts) const;

  private:
    void make_tiles();

    PixelRect rect_;
    FilmPasses passes_;
    int replicates_;
    int32_t tile_size_;
    int tile_count_ = 0;
    std::unique_ptr<Tile[]> tiles_;
    std::vector<double> sums_, normals_;
    std::vector<int32_t> hits_;
    std::vector<float> depth_;
    std::atomic<int64_t> rejected_{0};
};

}  // namespace trg

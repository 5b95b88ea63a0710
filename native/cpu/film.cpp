#include "cpu/film.h"

#include <algorithm>

namespace trg {

namespace {

/// Every other bit of `code`, packed: one coordinate of a Morton code.
int32_t every_other_bit(uint32_t code) {
    int32_t value = 0;
    for (int bit = 0; bit < 16; ++bit) value |= static_cast<int32_t>(code >> (2 * bit) & 1u) << bit;
    return value;
}

}  // namespace

Film::Film(const PixelRect& rect, const FilmPasses& passes, int64_t samples, int32_t tile_size)
    : rect_(rect),
      passes_(passes),
      replicates_(static_cast<int>(std::min<int64_t>(samples, kReplicates))),
      tile_size_(tile_size) {
    const size_t pixels = static_cast<size_t>(width()) * height();
    sums_.resize(pixels * replicates_ * 3);
    if (passes.normal) normals_.resize(pixels * 3);
    if (passes.alpha) hits_.resize(pixels);
    if (passes.depth) depth_.assign(pixels, 1e10f);
    make_tiles();
}

void Film::make_tiles() {
    const int32_t columns = (width() + tile_size_ - 1) / tile_size_;
    const int32_t rows = (height() + tile_size_ - 1) / tile_size_;
    tile_count_ = columns * rows;
    tiles_ = std::make_unique<Tile[]>(tile_count_);
    for (int index = 0; index < tile_count_; ++index) {
        const int32_t x = rect_.x_min + index % columns * tile_size_;
        const int32_t y = rect_.y_min + index / columns * tile_size_;
        // Morton order keeps neighbours together, which rays traced as packets like.
        for (uint32_t code = 0; code < static_cast<uint32_t>(tile_size_ * tile_size_); ++code) {
            const Pixel pixel{x + every_other_bit(code), y + every_other_bit(code >> 1)};
            if (pixel.x < rect_.x_max && pixel.y < rect_.y_max)
                tiles_[index].pixels.push_back(pixel);
        }
    }
}

void Film::add(const Chunk& chunk, const PathResult* results) {
    const int32_t count = chunk.pixel_count * chunk.samples;
    for (int32_t i = 0; i < count; ++i) {
        const PathResult& result = results[i];
        if (!is_finite(result.radiance)) {
            rejected_.fetch_add(1, std::memory_order_relaxed);
            continue;
        }
        const int64_t at = index_of(chunk.pixels[i / chunk.samples]);
        const int replicate =
            static_cast<int>((chunk.first_sample + i % chunk.samples) % kReplicates);
        double* sum = &sums_[(at * replicates_ + replicate) * 3];
        sum[0] += result.radiance.x;
        sum[1] += result.radiance.y;
        sum[2] += result.radiance.z;
        if (passes_.alpha) hits_[at] += result.hit;
        if (!passes_.normal) continue;
        normals_[3 * at] += result.normal.x;
        normals_[3 * at + 1] += result.normal.y;
        normals_[3 * at + 2] += result.normal.z;
    }
}

void Film::set_depth(const Pixel* pixels, int32_t count, const float* depth) {
    for (int32_t i = 0; i < count; ++i) depth_[index_of(pixels[i])] = depth[i];
}

void Film::read_combined(float* out) const {
    for (int index = 0; index < tile_count_; ++index) {
        const std::lock_guard<std::mutex> hold(tiles_[index].lock);
        const uint32_t done = tiles_[index].samples_done;
        const double scale = done ? 1.0 / done : 0.0;
        for (const Pixel& pixel : tiles_[index].pixels) {
            const int64_t at = index_of(pixel);
            double total[3] = {0.0, 0.0, 0.0};
            for (int r = 0; r < replicates_; ++r)
                for (int c = 0; c < 3; ++c) total[c] += sums(pixel, r)[c];
            for (int c = 0; c < 3; ++c) out[4 * at + c] = static_cast<float>(total[c] * scale);
            out[4 * at + 3] = passes_.alpha ? static_cast<float>(hits_[at] * scale) : 1.0f;
        }
    }
}

void Film::read_normal(float* out) const {
    for (int index = 0; index < tile_count_; ++index) {
        const std::lock_guard<std::mutex> hold(tiles_[index].lock);
        const uint32_t done = tiles_[index].samples_done;
        for (const Pixel& pixel : tiles_[index].pixels)
            for (int c = 0; c < 3; ++c) {
                const int64_t at = 3 * index_of(pixel) + c;
                out[at] = done ? static_cast<float>(normals_[at] / done) : 0.0f;
            }
    }
}

void Film::read_depth(float* out) const {
    for (int index = 0; index < tile_count_; ++index) {
        const std::lock_guard<std::mutex> hold(tiles_[index].lock);
        for (const Pixel& pixel : tiles_[index].pixels)
            out[index_of(pixel)] = depth_[index_of(pixel)];
    }
}

void Film::read_replicates(double* out, int64_t* counts) const {
    uint32_t least = ~0u;
    for (int index = 0; index < tile_count_; ++index)
        least = std::min(least, tiles_[index].samples_published.load(std::memory_order_acquire));
    for (int r = 0; r < kReplicates; ++r) counts[r] = replicate_count(least, r);
    const int64_t plane = static_cast<int64_t>(width()) * height() * 3;
    std::fill(out, out + plane * kReplicates, 0.0);
    for (int index = 0; index < tile_count_; ++index) {
        const std::lock_guard<std::mutex> hold(tiles_[index].lock);
        for (int r = 0; r < replicates_; ++r) {
            const int64_t here = replicate_count(tiles_[index].samples_done, r);
            if (counts[r] == 0) continue;
            const double scale = static_cast<double>(counts[r]) / static_cast<double>(here);
            for (const Pixel& pixel : tiles_[index].pixels)
                for (int c = 0; c < 3; ++c)
                    out[r * plane + 3 * index_of(pixel) + c] = sums(pixel, r)[c] * scale;
        }
    }
}

}  // namespace trg

#include "cpu/film.h"

#include <algorithm>
#include <tuple>

namespace trg {

namespace {

/// Every other bit of `code`, packed: one coordinate of a Morton code.
int32_t every_other_bit(uint32_t code) {
    int32_t value = 0;
    for (int bit = 0; bit < 16; ++bit) value |= static_cast<int32_t>(code >> (2 * bit) & 1u) << bit;
    return value;
}

struct MeanOf {
    int replicates, channels;
    bool each_alike;  // mean of the replicates' means; otherwise of all samples
};

void mean_of(const PixelSums& at, const MeanOf& of, double* mean) {
    double n = 0.0;
    for (int r = 0; r < of.replicates; ++r) n += at.counts[r];
    for (int c = 0; c < of.channels; ++c) {
        double sum = 0.0;
        for (int r = 0; r < of.replicates; ++r)
            sum += of.each_alike ? at.sums[r][c] / at.counts[r] : at.sums[r][c];
        mean[c] = sum / (of.each_alike ? of.replicates : n);
    }
}

}  // namespace

Film::Film(const FilmLayout& layout)
    : layout_(layout),
      replicates_(static_cast<int>(std::min<int64_t>(layout.samples, kReplicates))),
      channels_(layout.passes.alpha ? 4 : 3),
      pass_film_(layout.passes.more, static_cast<int64_t>(width()) * height()) {
    const size_t pixels = static_cast<size_t>(width()) * height();
    sums_.resize(pixels * replicates_ * channels_);
    if (layout.passes.normal) normals_.resize(pixels * 3);
    if (layout.passes.depth) depth_.assign(pixels, 1e10f);
    make_tiles();
}

int32_t Film::tile_columns() const {
    return (width() + layout_.tile_size - 1) / layout_.tile_size;
}

void Film::make_tiles() {
    const int32_t columns = tile_columns(), side = layout_.tile_size;
    const int32_t rows = (height() + side - 1) / side;
    tile_count_ = columns * rows;
    tiles_ = std::make_unique<Tile[]>(tile_count_);
    for (int index = 0; index < tile_count_; ++index) {
        const int32_t x = layout_.rect.x_min + index % columns * side;
        const int32_t y = layout_.rect.y_min + index / columns * side;
        // Morton order keeps neighbours together, which rays traced as packets like.
        for (uint32_t code = 0; code < static_cast<uint32_t>(side * side); ++code) {
            const Pixel pixel{x + every_other_bit(code), y + every_other_bit(code >> 1)};
            if (pixel.x < layout_.rect.x_max && pixel.y < layout_.rect.y_max)
                tiles_[index].pixels.push_back(pixel);
        }
    }
}

void Film::add(const Chunk& chunk, const PathQueues& queues, const PassView& view) {
    int32_t i = 0;
    for (int32_t pixel = 0; pixel < chunk.pixel_count; ++pixel) {
        const int64_t at = index_of(chunk.pixels[pixel]);
        for (int32_t k = 0; k < chunk.samples; ++k, ++i) {
            const PathResult& result = queues.results[i];
            if (!is_finite(result.radiance)) {
                reject(chunk.pixels[pixel], static_cast<int64_t>(chunk.first_sample) + k);
                continue;
            }
            const uint32_t replicate =
                (chunk.first_sample + static_cast<uint32_t>(k)) % kReplicates;
            add_result(at, static_cast<int>(replicate), result);
            if (queues.passes.states) pass_film_.add(at, view, queues.passes, i);
        }
    }
}

void Film::reject(Pixel pixel, int64_t sample) {
    rejected_.fetch_add(1, std::memory_order_relaxed);
    const auto order = [](const RejectedSample& one) {
        return std::make_tuple(one.sample, one.y, one.x);
    };
    const auto before = [&](const RejectedSample& a, const RejectedSample& b) {
        return order(a) < order(b);
    };
    const RejectedSample found{pixel.x, pixel.y, sample};
    // Which are kept may not depend on the threads: in order, the last one falls out.
    const std::lock_guard<std::mutex> hold(rejected_lock_);
    auto& kept = rejected_places_;
    kept.insert(std::upper_bound(kept.begin(), kept.end(), found, before), found);
    if (kept.size() > kRejectedPlaces) kept.pop_back();
}

std::vector<RejectedSample> Film::rejected_places() const {
    const std::lock_guard<std::mutex> hold(rejected_lock_);
    return rejected_places_;
}

void Film::add_result(int64_t at, int replicate, const PathResult& result) {
    double* sum = &sums_[(at * replicates_ + replicate) * channels_];
    sum[0] += result.radiance.x;
    sum[1] += result.radiance.y;
    sum[2] += result.radiance.z;
    if (layout_.passes.alpha) sum[3] += result.hit;
    if (!layout_.passes.normal) return;
    normals_[3 * at] += result.normal.x;
    normals_[3 * at + 1] += result.normal.y;
    normals_[3 * at + 2] += result.normal.z;
}

void Film::set_depth(const Pixel* pixels, int32_t count, const float* depth) {
    for (int32_t i = 0; i < count; ++i) depth_[index_of(pixels[i])] = depth[i];
}

PixelSums Film::counted(const Tile& tile, int32_t slot) const {
    PixelSums found;
    for (int r = 0; r < replicates_; ++r) {
        const TileHalf& half = tile.halves[r / kHalfReplicates];
        found.sums[r] = live_sums(tile.pixels[slot], r);
        found.counts[r] = static_cast<double>(replicate_count(tile.samples_done, r));
        if (half.live) continue;
        const HalfSnapshot& kept = half.snapshots.front();
        found.sums[r] = &kept.sums[(slot * kHalfReplicates + r % kHalfReplicates) *
                                   static_cast<size_t>(channels_)];
        found.counts[r] = kept.samples;
    }
    return found;
}

HalfSnapshot Film::snapshot(const Tile& tile, int half) const {
    HalfSnapshot kept{tile.samples_done / kReplicates, {}};
    const size_t width = static_cast<size_t>(kHalfReplicates) * channels_;
    kept.sums.reserve(tile.pixels.size() * width);
    for (const Pixel& pixel : tile.pixels) {
        const double* first = live_sums(pixel, half * kHalfReplicates);
        kept.sums.insert(kept.sums.end(), first, first + width);
    }
    return kept;
}

uint32_t Film::least_samples() const {
    uint32_t least = ~0u;
    for (int index = 0; index < tile_count_; ++index)
        least = std::min(least, tiles_[index].samples_published.load(std::memory_order_acquire));
    return least;
}

void Film::read_combined(float* out) const {
    for (int index = 0; index < tile_count_; ++index) {
        const Tile& tile = tiles_[index];
        const std::lock_guard<std::mutex> hold(tiles_[index].lock);
        const int used = static_cast<int>(std::min<uint32_t>(tile.samples_done, replicates_));
        for (size_t slot = 0; slot < tile.pixels.size(); ++slot) {
            const int64_t at = index_of(tile.pixels[slot]);
            double mean[4] = {0.0, 0.0, 0.0, 0.0};
            if (used > 0)
                mean_of(counted(tile, static_cast<int32_t>(slot)), {used, channels_, halved()},
                        mean);
            for (int c = 0; c < 3; ++c) out[4 * at + c] = static_cast<float>(mean[c]);
            out[4 * at + 3] = layout_.passes.alpha ? static_cast<float>(mean[3]) : 1.0f;
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

void Film::read_pass(PassKind kind, float* out) const {
    const int32_t channels = pass_film_.channels(kind);
    for (int index = 0; index < tile_count_; ++index) {
        const Tile& tile = tiles_[index];
        const std::lock_guard<std::mutex> hold(tiles_[index].lock);
        for (size_t slot = 0; slot < tile.pixels.size(); ++slot) {
            double samples = tile.samples_done;
            if (kind == kSampleCount && tile.samples_done > 0) {
                const PixelSums at = counted(tile, static_cast<int32_t>(slot));
                samples = 0.0;
                for (int r = 0; r < replicates_; ++r) samples += at.counts[r];
            }
            const int64_t pixel = index_of(tile.pixels[slot]);
            pass_film_.read(kind, pixel, samples, out + pixel * channels);
        }
    }
}

void Film::read_replicates(double* out, int64_t* counts) const {
    const uint32_t least = least_samples();
    for (int r = 0; r < kReplicates; ++r) counts[r] = replicate_count(least, r);
    const int64_t plane = static_cast<int64_t>(width()) * height() * 3;
    std::fill(out, out + plane * kReplicates, 0.0);
    for (int index = 0; index < tile_count_; ++index) {
        const Tile& tile = tiles_[index];
        const std::lock_guard<std::mutex> hold(tiles_[index].lock);
        for (size_t slot = 0; slot < tile.pixels.size(); ++slot) {
            const PixelSums at = counted(tile, static_cast<int32_t>(slot));
            for (int r = 0; r < replicates_; ++r) {
                if (counts[r] == 0) continue;
                const double scale = static_cast<double>(counts[r]) / at.counts[r];
                for (int c = 0; c < 3; ++c)
                    out[r * plane + 3 * index_of(tile.pixels[slot]) + c] = at.sums[r][c] * scale;
            }
        }
    }
}

}  // namespace trg

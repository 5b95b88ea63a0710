#include "cpu/picture_error.h"

#include <algorithm>

namespace trg {

namespace {

/// Sums over pixels and channels on the way to a PictureError.
struct Totals {
    double variance = 0.0, relative = 0.0;
    double delete_one[kReplicates] = {};
};

/// Adds one value, whose replicate `sums` lie 3 apart.
void add_value(const double* sums, const double* counts, int replicates, Totals* totals) {
    double n = 0.0, sum = 0.0;
    for (int r = 0; r < replicates; ++r) {
        n += counts[r];
        sum += sums[3 * r];
    }
    const double mean = sum / n;
    double spread = 0.0, off[kReplicates];
    for (int r = 0; r < replicates; ++r) {
        off[r] = sums[3 * r] / counts[r] - mean;
        spread += counts[r] * off[r] * off[r];
    }
    const double variance = spread / ((replicates - 1) * n);
    totals->variance += variance;
    totals->relative += variance / (mean * mean + 0.01);
    if (replicates < 3) return;
    for (int r = 0; r < replicates; ++r) {
        const double left = n - counts[r], moved = counts[r] * off[r];
        const double without = spread - moved * off[r] - moved * moved / left;
        totals->delete_one[r] += std::max(without, 0.0) / ((replicates - 2) * left);
    }
}

}  // namespace

PictureError measure_error(const Film& film) {
    uint32_t least = ~0u;
    for (int index = 0; index < film.tile_count(); ++index)
        least = std::min(least, film.tile(index).samples_published.load(std::memory_order_acquire));
    PictureError error;
    error.replicates = static_cast<int>(std::min<uint32_t>(least, film.replicates()));
    if (error.replicates < 2) return error;
    Totals totals;
    for (int index = 0; index < film.tile_count(); ++index) {
        Tile& tile = film.tile(index);
        const std::lock_guard<std::mutex> hold(tile.lock);
        double counts[kReplicates];
        for (int r = 0; r < error.replicates; ++r)
            counts[r] = static_cast<double>(replicate_count(tile.samples_done, r));
        for (const Pixel& pixel : tile.pixels)
            for (int c = 0; c < 3; ++c)
                add_value(film.sums(pixel, 0) + c, counts, error.replicates, &totals);
    }
    const double values = 3.0 * film.width() * film.height();
    error.mse = totals.variance / values;
    error.relmse = totals.relative / values;
    if (error.replicates >= 3)
        for (int r = 0; r < error.replicates; ++r)
            error.delete_one_mse.push_back(totals.delete_one[r] / values);
    return error;
}

}  // namespace trg

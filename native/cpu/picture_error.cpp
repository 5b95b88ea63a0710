#include "cpu/picture_error.h"

#include <algorithm>

namespace trg {

namespace {

/// Sums over pixels and channels on the way to a PictureError.
struct Totals {
    double variance = 0.0, relative = 0.0;
    double delete_one[kReplicates] = {};
    double halves = 0.0, products = 0.0;
};

/// Covariance of the channels of the mean of replicates [first, last): xx, xy, xz, yy, yz, zz.
struct Covariance {
    double entry[6];
};

Covariance covariance_between(const PixelSums& at, int first, int last) {
    double n = 0.0, mean[3] = {0.0, 0.0, 0.0};
    for (int r = first; r < last; ++r) {
        n += at.counts[r];
        for (int c = 0; c < 3; ++c) mean[c] += at.sums[r][c];
    }
    Covariance found{};
    for (int r = first; r < last; ++r) {
        double off[3];
        for (int c = 0; c < 3; ++c) off[c] = at.sums[r][c] / at.counts[r] - mean[c] / n;
        const double share = at.counts[r] / ((last - first - 1) * n);
        int k = 0;
        for (int c = 0; c < 3; ++c)
            for (int d = c; d < 3; ++d) found.entry[k++] += share * off[c] * off[d];
    }
    return found;
}

/// Adds the variance of a pixel as two halves of the replicates tell it, and the product of what
/// they tell of its channels.
void add_halves(const PixelSums& at, int replicates, Totals* totals) {
    constexpr double kTimes[6] = {1.0, 2.0, 2.0, 1.0, 2.0, 1.0};
    const Covariance a = covariance_between(at, 0, replicates / 2);
    const Covariance b = covariance_between(at, replicates / 2, replicates);
    for (int k = 0; k < 6; ++k) totals->products += kTimes[k] * a.entry[k] * b.entry[k];
    for (int k : {0, 3, 5}) totals->halves += 0.5 * (a.entry[k] + b.entry[k]);
}

/// Adds one channel of a pixel whose replicates count `n` samples together.
void add_value(const PixelSums& at, int channel, int replicates, Totals* totals) {
    double n = 0.0, sum = 0.0;
    for (int r = 0; r < replicates; ++r) {
        n += at.counts[r];
        sum += at.sums[r][channel];
    }
    const double mean = sum / n;
    double spread = 0.0, off[kReplicates];
    for (int r = 0; r < replicates; ++r) {
        off[r] = at.sums[r][channel] / at.counts[r] - mean;
        spread += at.counts[r] * off[r] * off[r];
    }
    const double variance = spread / ((replicates - 1) * n);
    totals->variance += variance;
    totals->relative += variance / (mean * mean + 0.01);
    if (replicates < 3) return;
    for (int r = 0; r < replicates; ++r) {
        const double left = n - at.counts[r], moved = at.counts[r] * off[r];
        const double without = spread - moved * off[r] - moved * moved / left;
        totals->delete_one[r] += std::max(without, 0.0) / ((replicates - 2) * left);
    }
}

/// The same for two halves whose replicates count unequally many samples: the picture is the mean
/// of all replicate means, its variance that of the halves' means over 4.
void add_halved_value(const PixelSums& at, int channel, Totals* totals) {
    constexpr int k = kHalfReplicates;
    double means[kReplicates], mean = 0.0, spread[2];
    for (int r = 0; r < kReplicates; ++r) {
        means[r] = at.sums[r][channel] / at.counts[r];
        mean += means[r] / kReplicates;
    }
    double off[kReplicates];
    for (int half = 0; half < 2; ++half) {
        double centre = 0.0;
        for (int r = half * k; r < (half + 1) * k; ++r) centre += means[r] / k;
        spread[half] = 0.0;
        for (int r = half * k; r < (half + 1) * k; ++r) {
            off[r] = means[r] - centre;
            spread[half] += off[r] * off[r];
        }
    }
    constexpr double scale = 1.0 / (2.0 * kReplicates);
    const double variance = (spread[0] + spread[1]) / (k - 1) * scale;
    totals->variance += variance;
    totals->relative += variance / (mean * mean + 0.01);
    for (int r = 0; r < kReplicates; ++r) {
        const double left = std::max(spread[r / k] - off[r] * off[r] * k / (k - 1), 0.0) / (k - 2);
        totals->delete_one[r] += (left + spread[1 - r / k] / (k - 1)) * scale;
    }
}

}  // namespace

PictureError measure_error(const Film& film) {
    PictureError error;
    error.replicates = film.complete_replicates();
    error.halves = film.halved();
    if (error.replicates < (film.halved() ? kReplicates : 2)) {
        error.replicates = std::min(error.replicates, 1);
        return error;
    }
    Totals totals;
    for (int index = 0; index < film.tile_count(); ++index) {
        Tile& tile = film.tile(index);
        const std::lock_guard<std::mutex> hold(tile.lock);
        for (size_t slot = 0; slot < tile.pixels.size(); ++slot) {
            const PixelSums at = film.counted(tile, static_cast<int32_t>(slot));
            if (error.replicates >= 4) add_halves(at, error.replicates, &totals);
            for (int c = 0; c < 3; ++c)
                if (film.halved())
                    add_halved_value(at, c, &totals);
                else
                    add_value(at, c, error.replicates, &totals);
        }
    }
    const double values = 3.0 * film.width() * film.height();
    error.mse = totals.variance / values;
    error.relmse = totals.relative / values;
    if (totals.halves > 0.0)
        error.normal_spread = totals.products / (totals.halves * totals.halves);
    if (error.replicates >= 3)
        for (int r = 0; r < error.replicates; ++r)
            error.delete_one_mse.push_back(totals.delete_one[r] / values);
    return error;
}

}  // namespace trg

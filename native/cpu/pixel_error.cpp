#include "cpu/pixel_error.h"

#include <algorithm>
#include <cmath>

#include "base/vec3.h"

namespace trg {

namespace {

constexpr int32_t kReach = 2;  // of the neighbourhood, in pixels
constexpr double kLonelyShare = 0.9;

/// Two-sided 95 % points of Student's t by degrees of freedom.
constexpr double kStudent95[kReplicates] = {0.0,    12.7062, 4.3027, 3.1824,
                                            2.7764, 2.5706,  2.4469, 2.3646};

struct PixelSpread {
    double variance;  // of the mean of luminance
    double light;     // that mean
    uint8_t flags;
};

/// Luminance of replicate `r`'s mean.
double replicate_luminance(const PixelSums& at, int r) {
    const double* sum = at.sums[r];
    return (0.2126 * sum[0] + 0.7152 * sum[1] + 0.0722 * sum[2]) / at.counts[r];
}

/// Unbiased variance of the mean; replicates of a half count alike, all others by their samples.
double variance_of_mean(const PixelSums& at, const double* means, int replicates, bool halved) {
    if (halved) {
        double total = 0.0;
        for (int half = 0; half < 2; ++half) {
            const double* first = means + half * kHalfReplicates;
            double mean = 0.0, spread = 0.0;
            for (int r = 0; r < kHalfReplicates; ++r) mean += first[r] / kHalfReplicates;
            for (int r = 0; r < kHalfReplicates; ++r) spread += (first[r] - mean) * (first[r] - mean);
            total += spread / (kHalfReplicates - 1);
        }
        return total / (2.0 * kReplicates);
    }
    double n = 0.0, sum = 0.0, spread = 0.0;
    for (int r = 0; r < replicates; ++r) {
        n += at.counts[r];
        sum += at.counts[r] * means[r];
    }
    for (int r = 0; r < replicates; ++r) {
        const double off = means[r] - sum / n;
        spread += at.counts[r] * off * off;
    }
    return spread / ((replicates - 1) * n);
}

PixelSpread spread_of(const PixelSums& at, int replicates, bool halved) {
    double means[kReplicates], total = 0.0, largest = 0.0;
    for (int r = 0; r < replicates; ++r) {
        means[r] = replicate_luminance(at, r);
        const double light = std::fabs(means[r]);
        total += light;
        largest = std::max(largest, light);
    }
    PixelSpread spread{variance_of_mean(at, means, replicates, halved), total / replicates, 0};
    if (total == 0.0)
        spread.flags = kUnseen;
    else if (largest >= kLonelyShare * total)
        spread.flags = kLonely;
    return spread;
}

std::vector<PixelSpread> spread_of_film(const Film& film, int replicates) {
    std::vector<PixelSpread> spreads(static_cast<size_t>(film.width()) * film.height());
    for (int index = 0; index < film.tile_count(); ++index) {
        Tile& tile = film.tile(index);
        const std::lock_guard<std::mutex> hold(tile.lock);
        for (size_t slot = 0; slot < tile.pixels.size(); ++slot)
            spreads[film.index_of(tile.pixels[slot])] =
                spread_of(film.counted(tile, static_cast<int32_t>(slot)), replicates, film.halved());
    }
    return spreads;
}

/// Mean of variance and of light over the neighbourhood of pixel (x, y), cut at the borders.
PixelSpread pooled_at(const std::vector<PixelSpread>& spreads, const Film& film, int32_t x, int32_t y) {
    PixelSpread pooled{0.0, 0.0, 0};
    int count = 0;
    for (int32_t v = std::max(y - kReach, 0); v <= std::min(y + kReach, film.height() - 1); ++v)
        for (int32_t u = std::max(x - kReach, 0); u <= std::min(x + kReach, film.width() - 1); ++u) {
            const PixelSpread& one = spreads[static_cast<size_t>(v) * film.width() + u];
            pooled.variance += one.variance;
            pooled.light += one.light;
            ++count;
        }
    pooled.variance /= count;
    return pooled;
}

}  // namespace

Evidence measure_pixel_error(const Film& film, float* half_width, uint8_t* flags) {
    const size_t pixels = static_cast<size_t>(film.width()) * film.height();
    std::fill(half_width, half_width + pixels, 0.0f);
    std::fill(flags, flags + pixels, uint8_t{0});
    Evidence evidence;
    const int replicates = film.complete_replicates();
    if (replicates < (film.halved() ? kReplicates : 2)) return evidence;
    const double student = kStudent95[replicates - (film.halved() ? 2 : 1)];
    const std::vector<PixelSpread> spreads = spread_of_film(film, replicates);
    double lit = 0.0, unseen = 0.0, lonely = 0.0, error = 0.0, lonely_error = 0.0;
    for (int32_t y = 0; y < film.height(); ++y)
        for (int32_t x = 0; x < film.width(); ++x) {
            const size_t at = static_cast<size_t>(y) * film.width() + x;
            const PixelSpread& own = spreads[at];
            const PixelSpread pooled = pooled_at(spreads, film, x, y);
            half_width[at] =
                static_cast<float>(student * std::sqrt(std::max(own.variance, pooled.variance)));
            flags[at] = own.flags;
            if (!(pooled.light > 0.0)) continue;
            lit += 1.0;
            unseen += own.flags == kUnseen;
            lonely += own.flags == kLonely;
            error += own.variance;
            if (own.flags == kLonely) lonely_error += own.variance;
        }
    evidence.lit = lit / static_cast<double>(pixels);
    evidence.unseen = lit > 0.0 ? unseen / lit : 0.0;
    evidence.lonely = lit > 0.0 ? lonely / lit : 0.0;
    evidence.lonely_error = error > 0.0 ? lonely_error / error : 0.0;
    return evidence;
}

}  // namespace trg

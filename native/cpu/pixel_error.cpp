#include "cpu/pixel_error.h"

#include <algorithm>
#include <cmath>

#include "base/vec3.h"

namespace trg {

namespace {

constexpr int32_t kReach = 2, kWideReach = 6;  // of the neighbourhoods, in pixels
/// Of the squared deviations of eight replicates one alone makes 7/8 at most, 0.45 when they are
/// normal.
constexpr double kLonelyShare = 0.8;

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

/// Unbiased variance of the mean of all samples of replicates [first, last), whose means are given.
double variance_between(const PixelSums& at, const double* means, int first, int last) {
    double n = 0.0, sum = 0.0, spread = 0.0;
    for (int r = first; r < last; ++r) {
        n += at.counts[r];
        sum += at.counts[r] * means[r];
    }
    for (int r = first; r < last; ++r) {
        const double off = means[r] - sum / n;
        spread += at.counts[r] * off * off;
    }
    return spread / ((last - first - 1) * n);
}

/// Of the picture: the mean of all samples, or that of two halves.
double variance_of_mean(const PixelSums& at, const double* means, int replicates, bool halved) {
    if (!halved) return variance_between(at, means, 0, replicates);
    return 0.25 * (variance_between(at, means, 0, kHalfReplicates) +
                   variance_between(at, means, kHalfReplicates, kReplicates));
}

PixelSpread spread_of(const PixelSums& at, int replicates, bool halved) {
    double means[kReplicates], total = 0.0, sum = 0.0;
    for (int r = 0; r < replicates; ++r) {
        means[r] = replicate_luminance(at, r);
        total += std::fabs(means[r]);
        sum += means[r];
    }
    double squares = 0.0, largest = 0.0;
    for (int r = 0; r < replicates; ++r) {
        const double off = means[r] - sum / replicates;
        squares += off * off;
        largest = std::max(largest, off * off);
    }
    PixelSpread spread{variance_of_mean(at, means, replicates, halved), total / replicates, 0};
    if (total == 0.0)
        spread.flags = kUnseen;
    else if (replicates > 2 && largest >= kLonelyShare * squares && squares > 0.0)
        spread.flags = kLonely;
    return spread;
}

std::vector<PixelSpread> spread_of_film(const Film& film, int replicates) {
    std::vector<PixelSpread> spreads(static_cast<size_t>(film.width()) * film.height());
    for (int index = 0; index < film.tile_count(); ++index) {
        Tile& tile = film.tile(index);
        const std::lock_guard<std::mutex> hold(tile.lock);
        for (size_t slot = 0; slot < tile.pixels.size(); ++slot)
            spreads[film.index_of(tile.pixels[slot])] = spread_of(
                film.counted(tile, static_cast<int32_t>(slot)), replicates, film.halved());
    }
    return spreads;
}

/// Sums of variance and of light over all pixels to the left of and below one: any rectangle is
/// four of them (Crow 1984).
class SummedSpread {
  public:
    SummedSpread(const std::vector<PixelSpread>& spreads, int32_t width, int32_t height)
        : width_(width), height_(height), sums_(static_cast<size_t>(width + 1) * (height + 1)) {
        for (int32_t y = 0; y < height; ++y) {
            Sum row{0.0, 0.0};
            for (int32_t x = 0; x < width; ++x) {
                const PixelSpread& one = spreads[static_cast<size_t>(y) * width + x];
                row.variance += one.variance;
                row.light += one.light;
                const Sum& below = at(x + 1, y);
                sums_[index(x + 1, y + 1)] = {below.variance + row.variance,
                                              below.light + row.light};
            }
        }
    }

    struct Sum {
        double variance, light;
    };
    /// Means over the pixels within `reach` of (x, y), cut at the borders.
    Sum mean(int32_t x, int32_t y, int32_t reach) const {
        const int32_t left = std::max(x - reach, 0), right = std::min(x + reach + 1, width_);
        const int32_t low = std::max(y - reach, 0), high = std::min(y + reach + 1, height_);
        const Sum &a = at(left, low), &b = at(right, low), &c = at(left, high),
                  &d = at(right, high);
        const double scale = 1.0 / (static_cast<double>(right - left) * (high - low));
        return {std::max(d.variance - b.variance - c.variance + a.variance, 0.0) * scale,
                (d.light - b.light - c.light + a.light) * scale};
    }

  private:
    size_t index(int32_t x, int32_t y) const { return static_cast<size_t>(y) * (width_ + 1) + x; }
    const Sum& at(int32_t x, int32_t y) const { return sums_[index(x, y)]; }

    int32_t width_, height_;
    std::vector<Sum> sums_;
};

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
    const SummedSpread pooled(spreads, film.width(), film.height());
    const double mean_light = pooled.mean(0, 0, std::max(film.width(), film.height())).light;
    double lit = 0.0, unseen = 0.0, lonely = 0.0, error = 0.0, squares = 0.0, lonely_error = 0.0;
    for (int32_t y = 0; y < film.height(); ++y)
        for (int32_t x = 0; x < film.width(); ++x) {
            const size_t at = static_cast<size_t>(y) * film.width() + x;
            const PixelSpread& own = spreads[at];
            const SummedSpread::Sum near = pooled.mean(x, y, kReach);
            const double around = std::max(near.variance, pooled.mean(x, y, kWideReach).variance);
            half_width[at] =
                static_cast<float>(student * std::sqrt(std::max(own.variance, around)));
            flags[at] = own.flags;
            if (!(near.light > 1e-12 * mean_light)) continue;
            lit += 1.0;
            unseen += own.flags == kUnseen;
            lonely += own.flags == kLonely;
            error += own.variance;
            squares += own.variance * own.variance;
            if (own.flags == kLonely) lonely_error += own.variance;
        }
    evidence.lit = lit / static_cast<double>(pixels);
    evidence.unseen = lit > 0.0 ? unseen / lit : 0.0;
    evidence.lonely = lit > 0.0 ? lonely / lit : 0.0;
    evidence.lonely_error = error > 0.0 ? lonely_error / error : 0.0;
    evidence.error_pixels = squares > 0.0 ? error * error / squares : 0.0;
    return evidence;
}

}  // namespace trg

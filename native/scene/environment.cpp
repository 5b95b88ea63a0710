#include "scene/environment.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trg {

namespace {

/// Share of the light that must lie above the mean for light samples to be worth their rays.
constexpr double kUnevenness = 1e-3;

double brightness(const Environment& e, int32_t x, int32_t y) {
    const float* p = &e.pixels[3 * (static_cast<size_t>(y) * e.width + x)];
    return std::max(0.0, static_cast<double>(luminance({p[0], p[1], p[2]})));
}

/// Means over the cells of row `y` of the brightness interpolated between texels.
void fill_row(const Environment& e, int32_t y, std::vector<double>* row) {
    const int32_t below = std::max(y - 1, 0), above = std::min(y + 1, e.height - 1);
    std::vector<double> column(e.width);
    for (int32_t x = 0; x < e.width; ++x)
        column[x] =
            (brightness(e, x, below) + 6.0 * brightness(e, x, y) + brightness(e, x, above)) / 8.0;
    for (int32_t x = 0; x < e.width; ++x) {
        const double left = column[x > 0 ? x - 1 : e.width - 1];
        const double right = column[x + 1 < e.width ? x + 1 : 0];
        (*row)[x] = (left + 6.0 * column[x] + right) / 8.0;
    }
}

double row_solid_angle(const Environment& e, int32_t y) {
    return 2.0 * kPi * 2.0 * std::sin(kPi * (y + 0.5) / e.height) * std::sin(0.5 * kPi / e.height);
}

}  // namespace

void cumulate_shares(const double* weights, size_t count, uint32_t* limits) {
    const double total = std::accumulate(weights, weights + count, 0.0);
    double sum = 0.0;
    for (size_t k = 0; k < count; ++k) {
        sum += weights[k];
        const double share = total > 0.0 ? sum / total : static_cast<double>(k + 1) / count;
        limits[k] = static_cast<uint32_t>(std::min(share * 4294967296.0, 4294967295.0));
    }
}

void prepare_environment(Environment* e) {
    std::vector<double> row(e->width), sums(e->height);
    double total = 0.0;
    for (int32_t y = 0; y < e->height; ++y) {
        fill_row(*e, y, &row);
        total += std::accumulate(row.begin(), row.end(), 0.0) / e->width * row_solid_angle(*e, y);
    }
    const double mean = total / (4.0 * kPi);
    e->row_limits.resize(e->height);
    e->limits.resize(static_cast<size_t>(e->width) * e->height);
    double above = 0.0;
    for (int32_t y = 0; y < e->height; ++y) {
        fill_row(*e, y, &row);
        for (double& weight : row) weight = std::max(0.0, weight - mean);
        sums[y] = std::accumulate(row.begin(), row.end(), 0.0) / e->width * row_solid_angle(*e, y);
        above += sums[y];
        cumulate_shares(row.data(), row.size(), &e->limits[static_cast<size_t>(y) * e->width]);
    }
    cumulate_shares(sums.data(), sums.size(), e->row_limits.data());
    e->sampled = above > kUnevenness * total;
}

EnvironmentView view_environment(const Environment& e) {
    return {e.pixels.empty() ? nullptr : e.pixels.data(),
            e.width,
            e.height,
            e.axis_x,
            e.axis_y,
            e.axis_z,
            e.row_limits.data(),
            e.limits.data(),
            e.sampled,
            e.seen_by_camera,
            false};
}

}  // namespace trg

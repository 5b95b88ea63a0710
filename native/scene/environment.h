/// The picture of the world around, kept with the tables by which directions are drawn from it.
#pragma once

#include <cstdint>
#include <vector>

#include "shade/environment.h"

namespace trg {

/// Storage behind an EnvironmentView; `pixels` is empty when there is none.
struct Environment {
    std::vector<float> pixels;  // height x width x 3, linear
    int32_t width = 0, height = 0;
    Vec3 axis_x{1.0f, 0.0f, 0.0f}, axis_y{0.0f, 1.0f, 0.0f}, axis_z{0.0f, 0.0f, 1.0f};
    bool seen_by_camera = true;
    bool sampled = false;
    std::vector<uint32_t> row_limits, limits;
};

/// Cumulative shares of 2^32 of the `count` numbers at `weights`, the last one all of it; even
/// shares when they add up to nothing.
void cumulate_shares(const double* weights, size_t count, uint32_t* limits);

/// Fills in the tables from the pixels, which must be finite. A texel's weight is what its cell
/// sends beyond the mean of all (Karlik et al. 2019, "MIS compensation"): bounce rays find the
/// rest.
void prepare_environment(Environment* environment);

/// `environment`, which must outlive the view.
EnvironmentView view_environment(const Environment& environment);

}  // namespace trg

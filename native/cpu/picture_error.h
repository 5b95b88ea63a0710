/// The error of a picture, told from the spread of its replicates.
#pragma once

#include <vector>

#include "cpu/film.h"

namespace trg {

/// `mse` is the mean over pixels and channels of the unbiased variance of the picture; `relmse` the
/// same over picture^2 + 0.01; `delete_one_mse` the mse without each replicate (jackknife).
/// `normal_spread` is half the relative variance that the squared error of one picture would have
/// were its noise normal: the sum over pixels and pairs of channels of the squared covariance over
/// the square of all variance, squares by the product of two halves of the replicates, which rare
/// bright paths do not swell. With `halves`, replicates 0 to 3 and 4 to 7 are groups of their own
/// and all count alike. Below 2 replicates only `replicates` holds; below 3 `delete_one_mse` is
/// empty; below 4 `normal_spread` is 0.
struct PictureError {
    int replicates = 0;
    bool halves = false;
    double mse = 0.0, relmse = 0.0, normal_spread = 0.0;
    std::vector<double> delete_one_mse;
};

/// Replicate means have variance sigma^2 / n_r: they are weighted by their counts. Replicates count
/// that have samples in every tile.
PictureError measure_error(const Film& film);

}  // namespace trg

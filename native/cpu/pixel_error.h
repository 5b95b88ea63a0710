/// The error of each pixel, and how far it can be told at all.
#pragma once

#include "cpu/film.h"

namespace trg {

/// How much of a picture was found by few replicates. Pixels without light in their neighbourhood
/// of five by five count nowhere.
struct Evidence {
    double lit = 0.0;           // share of pixels that have light in their neighbourhood
    double unseen = 0.0;        // of those: no replicate has seen light
    double lonely = 0.0;        // of those: one replicate makes four fifths of the spread or more
    double lonely_error = 0.0;  // share of the mean squared error that lonely pixels make
    double error_pixels = 0.0;  // how many pixels make it: square of its sum over sum of squares
};

/// What a pixel's `flags` may say.
enum PixelFlag : uint8_t { kUnseen = 1, kLonely = 2 };

/// Fills `half_width` (h, w), the 95 % half width of the luminance of each pixel: Student's t times
/// the root of the variance of its mean, the largest of the pixel's own and the means over the five
/// by five and the thirteen by thirteen pixels around it; and `flags` (h, w). Both 0 below two
/// replicates. Row 0 is the bottom row.
Evidence measure_pixel_error(const Film& film, float* half_width, uint8_t* flags);

}  // namespace trg

/// Light from all around as an equirectangular picture: its radiance, how directions are drawn from
/// it and how likely each was.
#pragma once

#include "shade/frame.h"
#include "shade/lights.h"

namespace trg {

/// Radiance by direction. Cells of the drawing are the texels; `row_limits` and, row by row,
/// `limits` are cumulative shares of 2^32, the last of each open.
struct EnvironmentView {
    const float* pixels;  // 3 a texel, row 0 looks straight down; null: there is none
    int32_t width, height;
    Vec3 axis_x, axis_y, axis_z;  // rows of the rotation from the world to the picture
    const uint32_t* row_limits;
    const uint32_t* limits;
    bool sampled;         // false: so even that bounce rays alone find it
    bool seen_by_camera;  // false: camera rays that leave the scene see nothing
    bool has_suns;        // some lights are seen by camera rays with it
};

/// The index whose share of 2^32 `bits` falls in.
TRG_FN int32_t find_share(const uint32_t* limits, int32_t count, uint32_t bits) {
    int32_t low = 0, high = count - 1;
    while (low < high) {
        const int32_t middle = (low + high) / 2;
        if (bits < limits[middle])
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

/// Share `index` of `count` as find_share draws it: where it begins and its size, of 2^32.
struct Share {
    uint32_t begin;
    float size;
};

TRG_FN Share share_of(const uint32_t* limits, int32_t count, int32_t index) {
    const uint32_t begin = index > 0 ? limits[index - 1] : 0u;
    const uint32_t size = (index + 1 < count ? limits[index] : 0u) - begin;
    return {begin, size == 0 && index + 1 == count ? 4294967296.0f : static_cast<float>(size)};
}

/// A direction in the picture: (u, v) from 0 to 1 and the cosine of the latitude.
struct SkyPlace {
    float u, v, cosine;
};

TRG_FN SkyPlace sky_place(const EnvironmentView& e, Vec3 wi) {
    const float x = dot(e.axis_x, wi), y = dot(e.axis_y, wi), z = dot(e.axis_z, wi);
    const float cosine = std::sqrt(x * x + y * y);
    return {0.5f - std::atan2(y, x) * (0.5f * kInvPi), 0.5f + std::atan2(z, cosine) * kInvPi,
            cosine};
}

TRG_FN Vec3 sky_texel(const EnvironmentView& e, int32_t x, int32_t y) {
    const float* texel = e.pixels + 3 * (static_cast<int64_t>(y) * e.width + x);
    return {texel[0], texel[1], texel[2]};
}

/// Radiance at a place: bilinear between the centres of texels, round the picture and up to its
/// first and last row.
TRG_FN Vec3 eval_sky(const EnvironmentView& e, SkyPlace at) {
    const float x = at.u * static_cast<float>(e.width) - 0.5f;
    const float y = smaller(larger(at.v * static_cast<float>(e.height) - 0.5f, 0.0f),
                            static_cast<float>(e.height - 1));
    const float x_floor = std::floor(x), y_floor = std::floor(y);
    const float fx = x - x_floor, fy = y - y_floor;
    int32_t x0 = static_cast<int32_t>(x_floor);
    if (x0 < 0) x0 = e.width - 1;
    if (x0 >= e.width) x0 = 0;
    const int32_t x1 = x0 + 1 == e.width ? 0 : x0 + 1;
    const int32_t y0 = static_cast<int32_t>(y_floor), y1 = y0 + 1 < e.height ? y0 + 1 : y0;
    const Vec3 low = sky_texel(e, x0, y0) * (1.0f - fx) + sky_texel(e, x1, y0) * fx;
    const Vec3 high = sky_texel(e, x0, y1) * (1.0f - fx) + sky_texel(e, x1, y1) * fx;
    return low * (1.0f - fy) + high * fy;
}

TRG_FN int32_t cell_of(float place, int32_t count) {
    const int32_t cell = static_cast<int32_t>(place * static_cast<float>(count));
    return cell < 0 ? 0 : (cell < count ? cell : count - 1);
}

/// Density by solid angle of a place in cell (x, y): even in u and v within the cell.
TRG_FN float sky_density(const EnvironmentView& e, int32_t x, int32_t y, float cosine) {
    constexpr float kUnit = 1.0f / (4294967296.0f * 2.0f * kPi * kPi);
    const Share row = share_of(e.row_limits, e.height, y);
    const Share cell = share_of(e.limits + static_cast<int64_t>(y) * e.width, e.width, x);
    const float cells = static_cast<float>(e.width) * static_cast<float>(e.height);
    return (row.size * kUnit) * (cell.size * (1.0f / 4294967296.0f)) * cells / cosine;
}

TRG_FN float pdf_sky(const EnvironmentView& e, SkyPlace at) {
    if (!(at.cosine > 0.0f)) return 0.0f;
    return sky_density(e, cell_of(at.u, e.width), cell_of(at.v, e.height), at.cosine);
}

/// Draws a direction by two raw numbers; false where nothing shines.
TRG_FN bool sample_sky(const EnvironmentView& e, const uint32_t bits[2], LightSample* sample) {
    const int32_t y = find_share(e.row_limits, e.height, bits[1]);
    const uint32_t* limits = e.limits + static_cast<int64_t>(y) * e.width;
    const int32_t x = find_share(limits, e.width, bits[0]);
    // What is left of each number places the direction in its cell.
    const Share row = share_of(e.row_limits, e.height, y), cell = share_of(limits, e.width, x);
    const float u = (static_cast<float>(bits[0] - cell.begin) + 0.5f) / cell.size;
    const float v = (static_cast<float>(bits[1] - row.begin) + 0.5f) / row.size;
    const float across = (static_cast<float>(x) + smaller(u, 1.0f)) / static_cast<float>(e.width);
    const float up = (static_cast<float>(y) + smaller(v, 1.0f)) / static_cast<float>(e.height);
    const float longitude = (0.5f - across) * (2.0f * kPi), latitude = (up - 0.5f) * kPi;
    const float cosine = std::cos(latitude);
    if (!(cosine > 0.0f)) return false;
    const Vec3 local{cosine * std::cos(longitude), cosine * std::sin(longitude),
                     std::sin(latitude)};
    sample->wi = e.axis_x * local.x + e.axis_y * local.y + e.axis_z * local.z;
    sample->distance = kFar;
    sample->pdf = sky_density(e, x, y, cosine);
    if (!(sample->pdf > 0.0f)) return false;
    sample->light = eval_sky(e, {across, up, cosine}) / sample->pdf;
    return true;
}

}  // namespace trg

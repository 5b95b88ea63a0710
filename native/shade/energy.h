/// Directional albedo of GGX facets, tabulated: what single scattering gives back of light that
/// comes in evenly. scene/energy_tables.h fills the tables; facets are scaled by them so that
/// nothing is lost between facets (Turquin 2019, "Practical multiple scattering compensation for
/// microfacet models").
#pragma once

#include "shade/frame.h"

namespace trg {

/// A row belongs to one roughness: values at cosines (k / (kEnergyNodes - 1))^4, then their mean
/// weighted by the cosine. Rows of a table lie at even steps of roughness from 0 to 1.
constexpr int32_t kEnergyNodes = 64;
constexpr int32_t kEnergyStride = kEnergyNodes + 1;
constexpr int32_t kEnergyRows = 33;

/// A point between two neighbours of a table.
struct EnergyPlace {
    int32_t index;
    float share;  // of the second neighbour
};

TRG_FN EnergyPlace place_energy(float x, int32_t count) {
    const float at = clamp01(x) * static_cast<float>(count - 1);
    const int32_t index = at < static_cast<float>(count - 2) ? static_cast<int32_t>(at) : count - 2;
    return {index, at - static_cast<float>(index)};
}

TRG_FN float mix_energy(const float* values, EnergyPlace at) {
    return values[at.index] + at.share * (values[at.index + 1] - values[at.index]);
}

/// Albedo and mean albedo of a table at one roughness and cosine.
struct Energy {
    float at, mean;
};

TRG_FN Energy look_up_energy(const float* table, int32_t rows, float roughness, float cosine) {
    const EnergyPlace mu = place_energy(std::sqrt(std::sqrt(clamp01(cosine))), kEnergyNodes);
    if (rows == 1) return {mix_energy(table, mu), table[kEnergyNodes]};
    const EnergyPlace r = place_energy(roughness, rows);
    const float* low = table + r.index * kEnergyStride;
    const float* high = low + kEnergyStride;
    const float a = mix_energy(low, mu), b = mix_energy(high, mu);
    return {a + r.share * (b - a),
            low[kEnergyNodes] + r.share * (high[kEnergyNodes] - low[kEnergyNodes])};
}

/// By how much facets of mean reflectance `mean` are scaled so that light that meets several of
/// them is not lost; coloured because each meeting colours it (Kulla and Conty 2017, section 3).
TRG_FN Vec3 energy_factor(Energy e, Vec3 mean) {
    if (!(e.at > 0.0f)) return {1.0f, 1.0f, 1.0f};
    const float lost = (1.0f - e.at) / e.at, missed = 1.0f - e.mean;
    // Colours beyond 1 would let the series of bounces grow without end.
    const Vec3 f{smaller(mean.x, 1.0f), smaller(mean.y, 1.0f), smaller(mean.z, 1.0f)};
    return {1.0f + lost * f.x * e.mean / (1.0f - f.x * missed),
            1.0f + lost * f.y * e.mean / (1.0f - f.y * missed),
            1.0f + lost * f.z * e.mean / (1.0f - f.z * missed)};
}

}  // namespace trg

#include "scene/energy_tables.h"

#include "shade/energy.h"
#include "shade/fresnel.h"
#include "shade/ggx.h"

namespace trg {

namespace {

constexpr int kAzimuths = 24, kHeights = 48;
/// Neighbours of Fibonacci's series: a lattice of the former many points.
constexpr int kLattice = 2584, kLatticeStep = 1597;

/// Facets whose albedo is wanted.
struct Facets {
    EnergyKind kind;
    float eta, alpha;
};

/// G2 / G1 of light that leaves along `wi`.
float unmasked(float slope_wo, Vec3 wi, float alpha) {
    return (1.0f + slope_wo) / (slope_wo + ggx_slope(wi, alpha));
}

/// What the facet `h` gives back of light seen from `wo`, per density of visible normals.
float facet_albedo(const Facets& f, Vec3 wo, float slope_wo, Vec3 h) {
    const float c = clamp01(dot(wo, h));
    float g = 0.0f, fresnel = 1.0f, sum = 0.0f;
    if (f.kind != EnergyKind::facets) fresnel = fresnel_dielectric(c, f.eta, &g);
    const Vec3 up = h * (2.0f * c) - wo;
    if (up.z > 0.0f) sum += fresnel * unmasked(slope_wo, up, f.alpha);
    if (f.kind != EnergyKind::glass || !(fresnel < 1.0f)) return sum;
    const Vec3 down = normalize(h * (c - g) - wo);
    if (down.z < 0.0f && is_thin_step(f.alpha, f.eta)) return sum + (1.0f - fresnel);
    if (down.z < 0.0f) sum += (1.0f - fresnel) * unmasked(slope_wo, down, f.alpha);
    return sum;
}

float albedo_at(const Facets& f, float mu) {
    if (f.alpha < kSmoothAlpha)
        return f.kind == EnergyKind::gloss ? fresnel_dielectric(mu, f.eta) : 1.0f;
    const float safe = larger(mu, 1e-6f);
    const Vec3 wo{std::sqrt(1.0f - safe * safe), 0.0f, safe};
    const float slope = ggx_slope(wo, f.alpha);
    double sum = 0.0, total = 0.0;
    // The integrand is even in the azimuth, u. Steps in w shorten where facets turn away, which is
    // where light is lost.
    const auto add = [&](float u, float w) {
        const Vec3 h = sample_visible_normal(wo, f.alpha, u, 1.0f - w * w * w);
        total += w * w;
        sum += w * w * facet_albedo(f, wo, slope, h);
    };
    if (f.kind == EnergyKind::glass && f.eta < 1.0f) {
        // Total reflection jumps along curves, of which a grid may see too little.
        for (int k = 0; k < kLattice; ++k)
            add((static_cast<float>(k * kLatticeStep % kLattice) + 0.5f) / (2 * kLattice),
                (static_cast<float>(k) + 0.5f) / kLattice);
    } else {
        for (int i = 0; i < kAzimuths; ++i)
            for (int j = 0; j < kHeights; ++j)
                add((static_cast<float>(i) + 0.5f) / (2 * kAzimuths),
                    (static_cast<float>(j) + 0.5f) / kHeights);
    }
    return static_cast<float>(sum / total);
}

/// The mean weighted by the cosine of what is linear between the nodes in the fourth root of the
/// cosine: Simpson's rule in that root.
float mean_albedo(const float* values) {
    constexpr double kStep = 1.0 / (kEnergyNodes - 1);
    const auto weight = [](double t) { return 8.0 * t * t * t * t * t * t * t; };
    double sum = 0.0;
    for (int k = 0; k + 1 < kEnergyNodes; ++k) {
        const double a = values[k], b = values[k + 1], t = k * kStep;
        sum +=
            kStep / 6.0 *
            (weight(t) * a + 4.0 * weight(t + 0.5 * kStep) * 0.5 * (a + b) + weight(t + kStep) * b);
    }
    return static_cast<float>(sum);
}

void append_row(const Facets& f, std::vector<float>* values) {
    const size_t first = values->size();
    for (int k = 0; k < kEnergyNodes; ++k) {
        const float t = static_cast<float>(k) / (kEnergyNodes - 1);
        values->push_back(albedo_at(f, t * t * t * t));
    }
    values->push_back(mean_albedo(values->data() + first));
}

}  // namespace

int32_t EnergyTables::add(EnergyKind kind, float eta, float roughness) {
    if (kind == EnergyKind::facets) eta = 1.0f;
    const auto [at, is_new] =
        first_.try_emplace({kind, eta, roughness}, static_cast<int32_t>(values.size()));
    if (!is_new) return at->second;
    if (roughness >= 0.0f) {
        append_row({kind, eta, roughness * roughness}, &values);
    } else {
        for (int row = 0; row < kEnergyRows; ++row) {
            const float r = static_cast<float>(row) / (kEnergyRows - 1);
            append_row({kind, eta, r * r}, &values);
        }
    }
    return at->second;
}

}  // namespace trg

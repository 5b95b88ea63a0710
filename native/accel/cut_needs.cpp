#include "accel/cut_split.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/parallel.h"

namespace trg {

namespace {

constexpr int64_t kGrain = 1 << 13;
constexpr double kBudget = 0.25;                    // cuts per reference
constexpr double kLeastGain = 0.25;                 // of the area of all boxes
constexpr double kHopelessGain = 0.8 * kLeastGain;  // of a sample: the rest is not looked at
constexpr size_t kLeastSampled = 1 << 14;
constexpr int64_t kSampleStride = 16;
constexpr double kMostOfOne = 0.01;  // of it that one triangle counts for
constexpr int kMostCuts = 1 << 10;   // of one triangle
constexpr int kGridBits = 20;
constexpr int kBisections = 24;

double along(const Vec3& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// Planes at binary fractions of a cube round the scene: the coarser the plane that a box
/// straddles, the higher in the tree it is in the way.
struct Lattice {
    double low[3];
    double edge;
};

Lattice lattice_over(const Bounds& bounds) {
    Lattice lattice{{bounds.lo.x, bounds.lo.y, bounds.lo.z}, 0};
    for (int axis = 0; axis < 3; ++axis)
        lattice.edge = std::max(lattice.edge, along(bounds.hi, axis) - lattice.low[axis]);
    return lattice;
}

int highest_bit(uint32_t x) {
    int bit = -1;
    for (; x; x >>= 1) ++bit;
    return bit;
}

/// Level of the coarsest plane that cuts a box; -1: none does.
int coarsest_level(const Lattice& lattice, const PrimRef& ref) {
    const double scale = (1 << kGridBits) / lattice.edge;
    int level = -1;
    for (int axis = 0; axis < 3; ++axis) {
        const double lo = along(ref.lo, axis), hi = along(ref.hi, axis);
        const auto first = static_cast<uint32_t>(std::max(0.0, (lo - lattice.low[axis]) * scale));
        const auto last = static_cast<uint32_t>(std::max(0.0, (hi - lattice.low[axis]) * scale));
        level = std::max(level, highest_bit(first ^ last));
    }
    return level;
}

/// How much box a triangle has beyond what endless cutting would leave: its projections' areas.
double excess_area(const TriangleCorners& triangle, const PrimRef& ref) {
    const Vec3d p0 = to_double(triangle.p[0]);
    const Vec3d n = cross(to_double(triangle.p[1]) - p0, to_double(triangle.p[2]) - p0);
    const double least = 0.5 * (std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z));
    return std::max(0.0, half_area(box_of(ref)) - least);
}

struct Candidate {
    float priority, excess;
};

/// Priorities of references and what their boxes measure together.
struct Candidates {
    std::vector<Candidate> of;
    double area = 0;
};

/// Weighs every `stride`-th reference.
Candidates weigh_refs(const PrimRefs& refs, int64_t stride, const Lattice& lattice,
                      const SplitSettings& settings) {
    Candidates result;
    const auto count = static_cast<int64_t>(refs.size()) / stride;
    result.of.resize(count);
    std::vector<double> areas((count + kGrain - 1) / kGrain);
    parallel_for(count, kGrain, settings.threads, [&](int64_t begin, int64_t end) {
        double area = 0;
        for (int64_t k = begin; k < end; ++k) {
            const PrimRef& ref = refs[k * stride];
            const double excess = excess_area((*settings.corners)(ref.item), ref);
            const int level = coarsest_level(lattice, ref);
            const double weight = level < 0 ? 0 : std::ldexp(excess, level - kGridBits);
            result.of[k] = {static_cast<float>(std::cbrt(weight)), static_cast<float>(excess)};
            area += half_area(box_of(ref));
        }
        areas[begin / kGrain] = area;
    });
    for (const double area : areas) result.area += area;
    return result;
}

int cuts_of(const Candidate& candidate, double scale) {
    return static_cast<int>(std::min<double>(kMostCuts, candidate.priority * scale));
}

int64_t count_cuts(const Candidates& candidates, double scale, int threads) {
    std::atomic<int64_t> total{0};
    const auto count = static_cast<int64_t>(candidates.of.size());
    parallel_for(count, kGrain, threads, [&](int64_t begin, int64_t end) {
        int64_t cuts = 0;
        for (int64_t k = begin; k < end; ++k) cuts += cuts_of(candidates.of[k], scale);
        total += cuts;
    });
    return total;
}

/// The factor from priorities to cuts that spends the budget.
double scale_of_cuts(const Candidates& candidates, int threads) {
    const auto budget = static_cast<int64_t>(kBudget * static_cast<double>(candidates.of.size()));
    float highest = 0;
    for (const Candidate& candidate : candidates.of)
        highest = std::max(highest, candidate.priority);
    if (!(highest > 0) || !std::isfinite(highest)) return 0;
    double low = 0, high = kMostCuts / static_cast<double>(highest);
    if (count_cuts(candidates, high, threads) <= budget) return high;
    for (int k = 0; k < kBisections; ++k) {
        const double middle = 0.5 * (low + high);
        (count_cuts(candidates, middle, threads) <= budget ? low : high) = middle;
    }
    return low;
}

/// The share of all box area that the cuts save, by estimate: n cuts leave 1 / (n + 1) of the
/// excess. A few huge triangles, the ground of a scene, do not make it worth while.
double estimated_gain(const Candidates& candidates, double scale) {
    double saved = 0;
    for (const Candidate& candidate : candidates.of) {
        const int cuts = cuts_of(candidate, scale);
        saved += std::min(candidate.excess * (cuts / (cuts + 1.0)), kMostOfOne * candidates.area);
    }
    return candidates.area > 0 ? saved / candidates.area : 0;
}

}  // namespace

int64_t measure_needs(PrimRefs& refs, const Bounds& bounds, const SplitSettings& settings) {
    const Lattice lattice = lattice_over(bounds);
    if (!(lattice.edge > 0)) return 0;
    if (refs.size() >= kLeastSampled) {
        const Candidates sample = weigh_refs(refs, kSampleStride, lattice, settings);
        const double scale = scale_of_cuts(sample, settings.threads);
        if (estimated_gain(sample, scale) < kHopelessGain) return 0;
    }
    const Candidates candidates = weigh_refs(refs, 1, lattice, settings);
    const double scale = scale_of_cuts(candidates, settings.threads);
    if (estimated_gain(candidates, scale) < kLeastGain) return 0;
    for (size_t k = 0; k < refs.size(); ++k)
        refs[k].need = static_cast<float>(candidates.of[k].priority * scale);
    return static_cast<int64_t>(kBudget * static_cast<double>(refs.size()));
}

}  // namespace trg

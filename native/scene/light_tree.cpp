#include "scene/light_tree.h"

#include <algorithm>
#include <cmath>

namespace trg {

namespace {

constexpr int kBins = 12;
constexpr int kDeepestBinned = 24;  // below it branches are halved, which bounds the depth

float component(Vec3 v, int axis) {
    return axis == 0 ? v.x : (axis == 1 ? v.y : v.z);
}

Vec3 lowest(Vec3 a, Vec3 b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3 highest(Vec3 a, Vec3 b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

Vec3 centre_of(const EmitterBounds& e) {
    return (e.low + e.high) * 0.5f;
}

/// Widens the cone of `a` to hold that of `b`.
void merge_cones(EmitterBounds* a, const EmitterBounds& b) {
    Vec3 other = b.axis;
    if (a->two_sided && b.two_sided && dot(a->axis, other) < 0.0f) other = -other;
    const bool a_wider = a->spread >= b.spread;
    const Vec3 wide_axis = a_wider ? a->axis : other, thin_axis = a_wider ? other : a->axis;
    const float wide = std::max(a->spread, b.spread), thin = std::min(a->spread, b.spread);
    const float between = std::acos(std::clamp(dot(wide_axis, thin_axis), -1.0f, 1.0f));
    a->axis = wide_axis;
    a->spread = wide;
    if (std::min(between + thin, kPi) <= wide) return;
    const float spread = 0.5f * (wide + between + thin);
    const Vec3 aside = thin_axis - wide_axis * dot(wide_axis, thin_axis);
    if (spread >= kPi || !(length(aside) > 1e-6f)) {
        a->spread = kPi;
        return;
    }
    const float turn = spread - wide;
    a->axis = normalize(wide_axis * std::cos(turn) + normalize(aside) * std::sin(turn));
    a->spread = std::min(spread + 1e-5f, kPi);
}

void merge(EmitterBounds* a, const EmitterBounds& b) {
    merge_cones(a, b);
    a->low = lowest(a->low, b.low);
    a->high = highest(a->high, b.high);
    a->reach = std::max(a->reach, b.reach);
    a->two_sided = a->two_sided || b.two_sided;
    a->power += b.power;
}

/// Conty Estevez and Kulla's measure of the directions that a cone lights.
double orientation_measure(float spread, float reach) {
    const double o = spread, w = std::min(static_cast<double>(spread) + reach, 1.0 * kPi);
    return 2.0 * kPi * (1.0 - std::cos(o)) + 0.5 * kPi *
                                                 (2.0 * w * std::sin(o) - std::cos(o - 2.0 * w) -
                                                  2.0 * o * std::sin(o) + std::cos(o));
}

double cost_of(const EmitterBounds& e) {
    const Vec3 size = e.high - e.low;
    return e.power * dot(size, size) * orientation_measure(e.spread, e.reach);
}

struct Bin {
    EmitterBounds sum;
    bool used = false;
    void add(const EmitterBounds& e) {
        if (used)
            merge(&sum, e);
        else
            sum = e;
        used = true;
    }
    double cost() const { return used ? cost_of(sum) : 0.0; }
};

struct Split {
    int axis = -1;
    float place = 0.0f;
    double cost = 1e300;
};

using Range = std::pair<size_t, size_t>;

class TreeBuilder {
  public:
    explicit TreeBuilder(std::vector<EmitterBounds>& emitters) : emitters_(emitters) {
        nodes_.reserve(2 * emitters.size());
    }
    std::vector<LightNode> take() { return std::move(nodes_); }

    void build(Range range, int32_t parent, int depth) {
        EmitterBounds all = emitters_[range.first];
        for (size_t k = range.first + 1; k < range.second; ++k) merge(&all, emitters_[k]);
        const int32_t index = static_cast<int32_t>(nodes_.size());
        nodes_.push_back({all.low, all.high, all.axis, static_cast<float>(all.power),
                          std::cos(all.spread), std::sin(all.spread), std::cos(all.reach) - 1e-4f,
                          all.two_sided, parent, -1, all.emitter});
        if (range.second - range.first == 1) return;
        const size_t middle = divide(range, depth);
        build({range.first, middle}, index, depth + 1);
        nodes_[index].second = static_cast<int32_t>(nodes_.size());
        build({middle, range.second}, index, depth + 1);
    }

  private:
    size_t divide(Range range, int depth) {
        const auto first = emitters_.begin() + range.first, last = emitters_.begin() + range.second;
        Vec3 low = centre_of(*first), high = low;
        for (auto e = first; e != last; ++e) {
            low = lowest(low, centre_of(*e));
            high = highest(high, centre_of(*e));
        }
        Split best;
        if (depth < kDeepestBinned)
            for (int axis = 0; axis < 3; ++axis)
                try_axis(range, axis, {component(low, axis), component(high, axis)}, &best);
        if (best.axis >= 0) {
            const auto middle = std::partition(first, last, [&](const EmitterBounds& e) {
                return component(centre_of(e), best.axis) < best.place;
            });
            if (middle != first && middle != last) return middle - emitters_.begin();
        }
        const Vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        const size_t half = (range.first + range.second) / 2;
        std::nth_element(first, emitters_.begin() + half, last,
                         [&](const EmitterBounds& a, const EmitterBounds& b) {
                             return component(centre_of(a), axis) < component(centre_of(b), axis);
                         });
        return half;
    }

    void try_axis(Range range, int axis, std::pair<float, float> extent, Split* best) const {
        const float width = extent.second - extent.first;
        if (!(width > 0.0f) || !std::isfinite(width)) return;
        Bin bins[kBins], right[kBins];
        for (size_t k = range.first; k < range.second; ++k) {
            const float place = (component(centre_of(emitters_[k]), axis) - extent.first) / width;
            bins[std::min(static_cast<int>(place * kBins), kBins - 1)].add(emitters_[k]);
        }
        for (int k = kBins - 1; k > 0; --k) {
            if (k + 1 < kBins) right[k] = right[k + 1];
            if (bins[k].used) right[k].add(bins[k].sum);
        }
        Bin left;
        for (int k = 1; k < kBins; ++k) {
            if (bins[k - 1].used) left.add(bins[k - 1].sum);
            const double cost = left.cost() + right[k].cost();
            if (left.used && right[k].used && cost < best->cost)
                *best = {axis, extent.first + width * static_cast<float>(k) / kBins, cost};
        }
    }

    std::vector<EmitterBounds>& emitters_;
    std::vector<LightNode> nodes_;
};

}  // namespace

std::vector<LightNode> build_light_tree(std::vector<EmitterBounds>& emitters) {
    TreeBuilder builder(emitters);
    builder.build({0, emitters.size()}, -1, 0);
    return builder.take();
}

}  // namespace trg

/// Quantiles of pixel filters, by which samples are placed with the filter's density.
#include <cmath>

#include "scene/shading_tables.h"

namespace trg {

namespace {

constexpr double kTurn = 6.283185307179586;

/// Height at `x` from -1 to 1 across all of the filter.
double filter_height(const std::string& name, double x) {
    if (name == "box") return 1.0;
    if (name == "gaussian") return std::exp(-18.0 * x * x);  // three thirds of the width across
    const double phase = 0.5 * kTurn * (x + 1.0);
    return 0.35875 - 0.48829 * std::cos(phase) + 0.14128 * std::cos(2.0 * phase) -
           0.01168 * std::cos(3.0 * phase);
}

/// Half of what the filter covers, in pixels.
double filter_reach(const std::string& name, double width) {
    if (name == "box") return 0.5 * width;
    return name == "gaussian" ? 1.5 * width : width;
}

}  // namespace

void set_filter(ShadingTables& tables, const std::string& name, double width) {
    if (name != "box" && name != "gaussian" && name != "blackman_harris")
        throw TableError("filter: expected box, gaussian or blackman_harris, got " + name);
    if (!(width > 0.0 && width <= 100.0)) throw TableError("width: expected 0 to 100 pixels");
    tables.filter.clear();
    if (name == "box" && width == 1.0) return;
    constexpr int kFine = 16 * kFilterSteps;
    std::vector<double> rising{0.0};
    for (int k = 0; k < kFine; ++k)
        rising.push_back(rising.back() + filter_height(name, (2.0 * k + 1.0) / kFine - 1.0));
    int at = 0;
    for (int k = 0; k <= kFilterSteps; ++k) {
        const double wanted = rising.back() * k / kFilterSteps;
        while (at + 1 < kFine && rising[at + 1] < wanted) ++at;
        const double part = (wanted - rising[at]) / (rising[at + 1] - rising[at]);
        const double x = 2.0 * (at + std::fmin(std::fmax(part, 0.0), 1.0)) / kFine - 1.0;
        tables.filter.push_back(static_cast<float>(x * filter_reach(name, width)));
    }
}

}  // namespace trg

#include "accel/choose_accel.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/parallel.h"

namespace trg {

namespace {

/// Nanoseconds on one thread, measured by benchmarks/accel_choice.py.
struct CostModel {
    AccelKind accel;
    double build;     // a triangle
    double sorting;   // a triangle, for each doubling of the triangles
    bool parallel;    // whether more threads build faster
    double ray;       // a ray, whatever the scene
    double doubling;  // a ray, for each doubling of the triangles
    double block;     // a ray, for each eight triangles
    double side;      // a ray, for each cube root of the triangles
};

constexpr CostModel kModels[] = {
    {AccelKind::none, 25, 0, true, 30, 0, 10.5, 0},
    {AccelKind::bvh, 0, 40, true, 20, 30, 0, 0},
    {AccelKind::grid, 400, 20, false, 120, 0, 0, 35},
    {AccelKind::grid2, 500, 80, false, 130, 0, 0, 35},
    {AccelKind::tree, 0, 25, false, 40, 150, 0, 0},
};
/// Meshes of the top level that a ray enters on its way, and what building it costs an instance.
constexpr double kEntered = 2, kBuildInstance = 700;

double doublings(double triangles) {
    return std::log2(1 + triangles / 8);
}

double ray_cost(const CostModel& model, double triangles) {
    const double n = std::max(triangles, 1.0);
    return model.ray + model.doubling * doublings(n) + model.block * std::ceil(n / 8) +
           model.side * std::cbrt(n);
}

double seconds(const CostModel& model, const Workload& work) {
    const double threads = work.threads, rays = work.rays > 0 ? work.rays : kUnknownRays;
    double build = (model.build + model.sorting * doublings(work.triangles)) * work.triangles /
                   (model.parallel ? threads : 1.0);
    double ray;
    if (work.placed > 1) {
        const CostModel& top = kModels[1];
        build += kBuildInstance * work.placed / threads;
        ray = ray_cost(top, 8 * work.placed) +
              kEntered * ray_cost(model, work.triangles / work.placed);
    } else {
        ray = ray_cost(model, work.triangles);
    }
    return 1e-9 * (build + rays * ray / threads);
}

std::string format(const char* pattern, double a, double b) {
    char text[160];
    std::snprintf(text, sizeof text, pattern, a, b);
    return text;
}

}  // namespace

const char* accel_name(AccelKind kind) {
    switch (kind) {
        case AccelKind::bvh:
            return "bvh";
        case AccelKind::grid:
            return "grid";
        case AccelKind::grid2:
            return "grid2";
        case AccelKind::tree:
            return "tree";
        case AccelKind::none:
            return "none";
        default:
            return "auto";
    }
}

Workload workload_of(const World& world, double rays, int threads) {
    std::vector<int32_t> uses(world.meshes.size(), 0);
    for (const Instance& instance : world.instances) ++uses[instance.mesh];
    Workload work{0, 0, rays, resolve_threads(threads)};
    for (size_t mesh = 0; mesh < uses.size(); ++mesh)
        if (uses[mesh] > 0)
            work.triangles += static_cast<double>(world.meshes[mesh].triangles.size());
    bool merged = false;
    for (const Instance& instance : world.instances) {
        if (world.merge && instance.identity && uses[instance.mesh] == 1)
            merged = true;
        else
            work.placed += 1;
    }
    work.placed += merged ? 1 : 0;
    return work;
}

Choice choose_accel(const Workload& work) {
    const CostModel* best = &kModels[0];
    const CostModel* second = nullptr;
    for (const CostModel& model : kModels) {
        if (&model == best) continue;
        if (seconds(model, work) < seconds(*best, work)) {
            second = best;
            best = &model;
        } else if (!second || seconds(model, work) < seconds(*second, work)) {
            second = &model;
        }
    }
    std::string reason = format("%.0f triangles and %.3g rays", work.triangles,
                                work.rays > 0 ? work.rays : kUnknownRays);
    if (work.rays <= 0) reason += " (reckoned with)";
    reason += format(": build and trace are estimated at %.2g s against %.2g s with ",
                     seconds(*best, work), seconds(*second, work));
    return {best->accel, reason + accel_name(second->accel)};
}

}  // namespace trg

/// The way of a ray through a regular grid (Amanatides and Woo 1987), with the distance to each
/// plane computed anew from its index, in double, so that nothing drifts.
#pragma once

#include "accel/traced_ray.h"

namespace trg::TRG_ISA {

struct GridWalk {
    double entry, exit;   // where the ray enters and leaves the grid's box
    int cell[3];
    int step[3];
    double next[3];       // distance to the next plane along each axis
};

TRG_FN double component(const Vec3d& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

TRG_FN double plane_distance(const Grid& grid, const TracedRay& ray, int axis, int plane) {
    const double at = grid.low[axis] + plane * grid.cell[axis];
    return (at - component(ray.origin_d, axis)) / component(ray.direction_d, axis);
}

TRG_FN double next_distance(const Grid& grid, const TracedRay& ray, const GridWalk& walk, int axis) {
    if (ray.direction[axis] == 0) return HUGE_VAL;
    return plane_distance(grid, ray, axis, walk.cell[axis] + (walk.step[axis] > 0 ? 1 : 0));
}

/// Puts `walk` at the first cell; false when the ray passes the grid by.
TRG_FN bool enter_grid(const Grid& grid, const TracedRay& ray, float limit, GridWalk* walk) {
    walk->entry = ray.t_min;
    walk->exit = limit;
    for (int axis = 0; axis < 3; ++axis) {
        double near = plane_distance(grid, ray, axis, ray.sign[axis] ? grid.size[axis] : 0);
        double far = plane_distance(grid, ray, axis, ray.sign[axis] ? 0 : grid.size[axis]);
        if (near > walk->entry) walk->entry = near;
        if (far < walk->exit) walk->exit = far;
    }
    if (!(walk->entry <= walk->exit)) return false;
    for (int axis = 0; axis < 3; ++axis) {
        const double at = component(ray.origin_d, axis) +
                          walk->entry * component(ray.direction_d, axis) - grid.low[axis];
        const double cell = std::floor(at / grid.cell[axis]);
        const double most = grid.size[axis] - 1;
        walk->cell[axis] = static_cast<int>(cell < 0 ? 0 : cell > most ? most : cell);
        walk->step[axis] = ray.sign[axis] ? -1 : 1;
        walk->next[axis] = next_distance(grid, ray, *walk, axis);
    }
    return true;
}

/// Calls `visit(block)` for the blocks of the cells along the ray until a hit lies before the next
/// cell (`*limit`, which `visit` lowers). Ends early, with true, when `visit` returns true.
template <class Visit>
TRG_FN bool walk_grid(const Grid& grid, const TracedRay& ray, const float* limit, Visit visit) {
    GridWalk walk;
    if (!enter_grid(grid, ray, *limit, &walk)) return false;
    for (;;) {
        const int64_t cell =
            (int64_t{walk.cell[2]} * grid.size[1] + walk.cell[1]) * grid.size[0] + walk.cell[0];
        for (uint32_t k = grid.cell_begin[cell]; k < grid.cell_begin[cell + 1]; ++k)
            if (visit(k)) return true;
        int axis = walk.next[0] < walk.next[1] ? 0 : 1;
        if (walk.next[2] < walk.next[axis]) axis = 2;
        if (*limit <= walk.next[axis]) return false;
        walk.cell[axis] += walk.step[axis];
        if (walk.cell[axis] < 0 || walk.cell[axis] >= grid.size[axis]) return false;
        walk.next[axis] = next_distance(grid, ray, walk, axis);
    }
}

}  // namespace trg::TRG_ISA

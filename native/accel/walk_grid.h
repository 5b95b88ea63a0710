/// The way of a ray through a regular grid (Amanatides and Woo 1987), with the distance to each
/// plane computed anew from its index, in double, so that nothing drifts.
#pragma once

#include "accel/traced_ray.h"

namespace trg::TRG_ISA {

/// Along one axis, plane k is met at start + k step.
struct PlaneDistances {
    double start, step;
};

struct GridWalk {
    double entry, exit;  // where the ray enters and leaves the grid's box
    PlaneDistances planes[3];
    int cell[3];
    int forward[3];  // 1, or -1 where the direction is negative
    double next[3];  // distance to the next plane along each axis
};

TRG_FN double component(const Vec3d& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

TRG_FN double next_distance(const GridWalk& walk, int axis) {
    const int plane = walk.cell[axis] + (walk.forward[axis] > 0 ? 1 : 0);
    return walk.planes[axis].start + plane * walk.planes[axis].step;
}

/// Puts `walk` at the first cell; false when the ray passes the grid by.
TRG_FN bool enter_grid(const Grid& grid, const TracedRay& ray, float limit, GridWalk* walk) {
    walk->entry = ray.t_min;
    walk->exit = limit;
    for (int axis = 0; axis < 3; ++axis) {
        const double inverse = 1.0 / component(ray.direction_d, axis);
        const double start = (grid.low[axis] - component(ray.origin_d, axis)) * inverse;
        const double step = grid.cell[axis] * inverse;
        walk->planes[axis] = {start, step};
        const double end = start + grid.size[axis] * step;
        const double near = ray.sign[axis] ? end : start, far = ray.sign[axis] ? start : end;
        // Written so that the NaN of a ray along a side of the box changes nothing.
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
        walk->forward[axis] = ray.sign[axis] ? -1 : 1;
        if (ray.direction[axis] == 0) walk->planes[axis] = {HUGE_VAL, 0};
        walk->next[axis] = next_distance(*walk, axis);
    }
    return true;
}

/// Calls `visit(cell)` for the cells along the ray until a hit lies before the next one (`*limit`,
/// which `visit` lowers). Ends early, with true, when `visit` returns true.
template <class Visit>
TRG_FN bool walk_cells(const Grid& grid, const TracedRay& ray, const float* limit, Visit visit) {
    GridWalk walk;
    if (!enter_grid(grid, ray, *limit, &walk)) return false;
    for (;;) {
        if (visit((int64_t{walk.cell[2]} * grid.size[1] + walk.cell[1]) * grid.size[0] +
                  walk.cell[0]))
            return true;
        int axis = walk.next[0] < walk.next[1] ? 0 : 1;
        if (walk.next[2] < walk.next[axis]) axis = 2;
        if (*limit <= walk.next[axis]) return false;
        walk.cell[axis] += walk.forward[axis];
        if (walk.cell[axis] < 0 || walk.cell[axis] >= grid.size[axis]) return false;
        walk.next[axis] = next_distance(walk, axis);
    }
}

/// Calls `visit(range)` for the blocks of the cells of `grid` along the ray, those of finer grids
/// included.
template <int kLevels, class Visit>
TRG_FN bool walk_level(const GridIndex& index, const Grid& grid, const TracedRay& ray,
                       const float* limit, Visit& visit) {
    return walk_cells(grid, ray, limit, [&](int64_t cell) {
        const BlockRange blocks = index.cells[grid.first_cell + cell];
        if constexpr (kLevels > 1)
            if (blocks.end == kDivided)
                return walk_level<kLevels - 1>(index, index.grids[blocks.begin], ray, limit, visit);
        return visit(blocks);
    });
}

/// Calls `visit(block)` for the blocks that the ray comes by.
template <class Visit>
TRG_FN bool walk_grid(const GridIndex& index, const TracedRay& ray, const float* limit,
                      Visit visit) {
    uint32_t last = ~0u;
    const auto visit_blocks = [&](const BlockRange& blocks) {
        if (blocks.begin == last) return false;  // those of the cell before
        for (uint32_t k = blocks.begin; k < blocks.end; ++k)
            if (visit(k)) return true;
        if (blocks.begin < blocks.end) last = blocks.begin;
        return false;
    };
    return walk_level<kMostGridLevels>(index, index.grids[0], ray, limit, visit_blocks);
}

}  // namespace trg::TRG_ISA

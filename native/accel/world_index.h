/// What `build_world` makes of a World: soups, and where they stand.
#pragma once

#include "accel/kernels.h"
#include "accel/soup.h"

namespace trg {

/// A soup placed in the world.
struct Placement {
    const Soup* soup;
    int32_t instance;  // -1: a merged soup, whose items tell
    bool identity;
    InverseMap into;                  // from the world to the soup's space, where it stands still
    const Transform* keys = nullptr;  // of one that moves, from its space to the world
    int32_t key_count = 0;
    uint8_t mask = kEveryRay;
};

struct WorldIndex {
    TriangleTest triangle_test = TriangleTest::watertight;
    AccelKind accel = AccelKind::none;
    std::vector<std::shared_ptr<Soup>> soups;
    std::vector<Soup*> soup_of_mesh;  // null: not placed, or merged
    Soup* merged = nullptr;
    std::vector<Placement> placements;  // in the order of the leaves of `top`
    Tree top;                           // over placements; unused when there is only one
    std::vector<Placement> unbounded;   // planes: no box holds them
    float reach = 0;                    // largest extent of the box of all placements
    bool moving = false;                // whether time changes anything
    bool masked = false;                // whether some instance is not met by all rays
    int64_t bytes = 0;                  // of all that rays may touch
    Kernels kernels{};
};

/// Places every soup of `index` where the instances of `world` say, and builds the top level.
void place_soups(const World& world, WorldIndex& index, int threads);

}  // namespace trg

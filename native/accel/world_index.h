/// What `build_world` makes of a World.
#pragma once

#include "accel/world.h"

namespace trg {

struct WorldIndex {
    int64_t bytes = 0;
};

}  // namespace trg

/// Axis-aligned boxes.
#pragma once

#include <limits>

#include "base/vec3.h"

namespace trg {

struct Bounds {
    Vec3 lo, hi;
};

TRG_FN float min_of(float a, float b) {
    return a < b ? a : b;
}
TRG_FN float max_of(float a, float b) {
    return a > b ? a : b;
}

/// The box of nothing: growing it by a point gives that point.
TRG_FN Bounds empty_bounds() {
    constexpr float kInf = std::numeric_limits<float>::infinity();
    return {{kInf, kInf, kInf}, {-kInf, -kInf, -kInf}};
}

TRG_FN Bounds united(const Bounds& a, const Bounds& b) {
    return {{min_of(a.lo.x, b.lo.x), min_of(a.lo.y, b.lo.y), min_of(a.lo.z, b.lo.z)},
            {max_of(a.hi.x, b.hi.x), max_of(a.hi.y, b.hi.y), max_of(a.hi.z, b.hi.z)}};
}

TRG_FN Bounds united(const Bounds& a, Vec3 p) {
    return united(a, Bounds{p, p});
}

TRG_FN bool is_empty(const Bounds& a) {
    return !(a.lo.x <= a.hi.x);
}

/// Half the surface of the box, in double so that no finite box overflows; 0 for the empty one.
TRG_FN double half_area(const Bounds& a) {
    if (is_empty(a)) return 0.0;
    const double x = static_cast<double>(a.hi.x) - a.lo.x;
    const double y = static_cast<double>(a.hi.y) - a.lo.y;
    const double z = static_cast<double>(a.hi.z) - a.lo.z;
    return x * y + y * z + z * x;
}

}  // namespace trg

/// Choosing the kind of index by what building it and tracing are expected to take.
#pragma once

#include <string>

#include "accel/world.h"

namespace trg {

/// What an estimate rests on.
struct Workload {
    double triangles;  // that indices are built over, those of a mesh once
    double placed;     // instances that have a place in the top level
    double rays;       // to be traced; 0 is unknown
    int threads;
};

struct Choice {
    AccelKind accel;
    std::string reason;
};

/// Rays that are reckoned with when nobody says how many there will be.
constexpr double kUnknownRays = 1e6;

Workload workload_of(const World& world, double rays, int threads);

/// The kind whose build and rays are expected to take the least time together.
Choice choose_accel(const Workload& work);

const char* accel_name(AccelKind kind);

}  // namespace trg

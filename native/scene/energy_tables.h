/// The tables of shade/energy.h, made for the materials of a scene when they are set.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace trg {

/// What a table holds the albedo of.
enum class EnergyKind { facets, gloss, glass };

/// Tables of a scene, each made once for the same kind, index and roughness. The GGX facets are
/// integrated by the midpoint rule over their visible normals, good to 2e-4.
class EnergyTables {
  public:
    /// Where the table of `kind` begins for facets of `eta` (far over near side; facets ignore it).
    /// Of one row at `roughness`, or of kEnergyRows when that is negative.
    int32_t add(EnergyKind kind, float eta, float roughness);

    std::vector<float> values;

  private:
    std::map<std::tuple<EnergyKind, float, float>, int32_t> first_;
};

}  // namespace trg

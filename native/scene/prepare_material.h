/// What a material needs besides its columns, found once.
#pragma once

#include "scene/energy_tables.h"
#include "shade/material.h"

namespace trg {

/// Fills in everything of `m` that follows from its columns; adds its tables to `energy`.
void prepare_material(Material* m, EnergyTables* energy);

}  // namespace trg

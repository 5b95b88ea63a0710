/// What a material needs besides its columns, found once.
#pragma once

#include <vector>

#include "scene/energy_tables.h"
#include "shade/material.h"

namespace trg {

/// Fills in everything of `m` that follows from its columns; adds its tables to `energy`.
void prepare_material(Material* m, EnergyTables* energy);

/// Numbers the materials whose insides have priorities from 1 on; returns the count with medium 0,
/// which is all others.
int32_t number_media(std::vector<Material>* materials);

/// SceneView::boundary_energy; adds its tables to `energy`.
std::vector<int32_t> prepare_boundaries(const std::vector<Material>& materials,
                                        EnergyTables* energy);

}  // namespace trg

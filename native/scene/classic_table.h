/// Materials of the classic integrator and ambient light, taken from a packed table.
#pragma once

#include "scene/shading_tables.h"

namespace trg {

/// Columns of the table, in order (trg_blender/engine/classic_arrays.py has the same).
extern const std::vector<const char*> kClassicFields;

/// One row a material; with them the scene is rendered by the classic integrator. Throws
/// TableError.
void set_classic(ShadingTables& tables, const Table& table, Vec3 ambient);

}  // namespace trg

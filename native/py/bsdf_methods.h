/// Functions of trg_native that evaluate and sample one material: for tests and material charts.
#pragma once

#include "py/py_ref.h"

namespace trg::py {

/// bsdf_eval(material, wo, wi, outside, value, pdf): value times |cos wi| (n, 3) and density (n,)
/// of all lobes but deltas, for a row of the material table without textures. Directions (n, 3) are
/// unit and local: z is the normal, wo.z > 0. ArgumentError for other shapes, TableError for other
/// numbers.
PyObject* bsdf_eval(PyObject*, PyObject* args, PyObject* kwargs);

/// bsdf_sample(material, wo, uniforms, outside, wi, weight, pdf): draws by uniforms (n, 3) in [0,
/// 1): lobe, then two for the direction. An absorbed sample has weight 0 and pdf -1; a delta pdf 0.
PyObject* bsdf_sample(PyObject*, PyObject* args, PyObject* kwargs);

}  // namespace trg::py

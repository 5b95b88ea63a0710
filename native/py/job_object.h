/// The Python type trg_native.Job.
#pragma once

#include "py/py_ref.h"

namespace trg::py {

/// Adds the type to `module`. Throws PythonError.
void add_job_type(PyObject* module);

}  // namespace trg::py

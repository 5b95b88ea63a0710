/// The Python type trg_native.Job: a render under way.
#pragma once

#include "cpu/render_job.h"
#include "py/py_ref.h"

namespace trg::py {

/// Starts a render of the Scene `scene` and returns its Job, which keeps the scene alive.
PyRef start_job(PyObject* scene, const RenderRequest& request);

/// Adds the type and the names of the tables' columns to `module`. Throws PythonError.
void add_job_type(PyObject* module);

}  // namespace trg::py

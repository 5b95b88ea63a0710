/// The extension module trg_native: types, version, and what this machine and build can do.
#include "base/isa.h"
#include "base/parallel.h"
#include "kernel/kernel_sets.h"
#include "py/bsdf_methods.h"
#include "py/job_object.h"
#include "py/py_ref.h"
#include "py/scene_object.h"

namespace trg::py {

namespace {

#if defined(__clang__)
constexpr const char* kCompiler = "clang " __VERSION__;
#elif defined(__GNUC__)
constexpr const char* kCompiler = "gcc " __VERSION__;
#elif defined(_MSC_VER)
constexpr const char* kCompiler = "msvc";
#else
constexpr const char* kCompiler = "unknown";
#endif

#if defined(TRG_HAS_X86_VARIANTS)
constexpr const char* kCompiledSets = "baseline avx2 avx512";
#else
constexpr const char* kCompiledSets = "baseline";
#endif

PyObject* info(PyObject*, PyObject*) {
    return guarded_object([] {
        return checked(Py_BuildValue("{s:s, s:s, s:s, s:s, s:i}", "compiler", kCompiler,
                                     "instruction_set", isa_name(detect_isa()), "compiled_sets",
                                     kCompiledSets, "kernel_sets", kernel_set_names(), "cores",
                                     resolve_threads(0)));
    });
}

PyMethodDef kModuleMethods[] = {
    {"info", info, METH_NOARGS,
     "info() -> dict: compiler, instruction_set in use, compiled_sets, kernel_sets, cores"},
    {"bsdf_eval", as_method(bsdf_eval), METH_VARARGS | METH_KEYWORDS,
     "bsdf_eval(material, wo, wi, outside, value, pdf): see docs/architecture.md, 3.3"},
    {"bsdf_sample", as_method(bsdf_sample), METH_VARARGS | METH_KEYWORDS,
     "bsdf_sample(material, wo, uniforms, outside, wi, weight, pdf): see docs/architecture.md, "
     "3.3"},
    {nullptr, nullptr, 0, nullptr}};

int execute_module(PyObject* module) {
    return guarded(-1, [&] {
        if (PyModule_AddStringConstant(module, "__version__", TRG_VERSION) != 0)
            throw PythonError{};
        add_scene_type(module);
        add_job_type(module);
        return 0;
    });
}

PyModuleDef_Slot kModuleSlots[] = {{Py_mod_exec, reinterpret_cast<void*>(execute_module)},
                                   {0, nullptr}};

PyModuleDef kModule = {PyModuleDef_HEAD_INIT,
                       "trg_native",
                       "The native core of TRG for Blender.",
                       0,
                       kModuleMethods,
                       kModuleSlots,
                       nullptr,
                       nullptr,
                       nullptr};

}  // namespace

}  // namespace trg::py

PyMODINIT_FUNC PyInit_trg_native() {
    return PyModuleDef_Init(&trg::py::kModule);
}

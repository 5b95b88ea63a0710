/// The Python C API held safely: owned references, released locks, translated exceptions.
#pragma once

#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include <new>
#include <stdexcept>
#include <string>
#include <utility>

namespace trg::py {

/// An owned reference, or null.
class PyRef {
  public:
    PyRef() = default;
    /// Takes over a new reference.
    explicit PyRef(PyObject* owned) : object_(owned) {}
    PyRef(PyRef&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
    PyRef& operator=(PyRef&& other) noexcept {
        std::swap(object_, other.object_);
        return *this;
    }
    PyRef(const PyRef&) = delete;
    PyRef& operator=(const PyRef&) = delete;
    ~PyRef() { Py_XDECREF(object_); }

    PyObject* get() const { return object_; }
    PyObject* release() { return std::exchange(object_, nullptr); }
    explicit operator bool() const { return object_ != nullptr; }

  private:
    PyObject* object_ = nullptr;
};

/// Thrown when a Python exception is set already.
struct PythonError {};

/// An argument of wrong shape, type or range: becomes ValueError.
class ArgumentError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A call at the wrong time, such as a query before the build: becomes RuntimeError.
class StateError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// `object` as an owned reference; throws PythonError when it is null.
inline PyRef checked(PyObject* object) {
    if (!object) throw PythonError{};
    return PyRef(object);
}

/// Lets other Python threads run while it lives. Nothing of the C API may be called meanwhile.
class WithoutGil {
  public:
    WithoutGil() : state_(PyEval_SaveThread()) {}
    ~WithoutGil() { PyEval_RestoreThread(state_); }
    WithoutGil(const WithoutGil&) = delete;
    WithoutGil& operator=(const WithoutGil&) = delete;

  private:
    PyThreadState* state_;
};

/// Sets the Python exception that stands for the C++ exception being handled.
void set_error_from_exception() noexcept;

/// The result of `body`, or `failure` with a Python exception set: the one border of exceptions.
template <class Body, class Result>
Result guarded(Result failure, Body body) noexcept {
    try {
        return body();
    } catch (...) {
        set_error_from_exception();
        return failure;
    }
}

/// The same for the bodies that return an owned PyRef.
template <class Body>
PyObject* guarded_object(Body body) noexcept {
    return guarded(static_cast<PyObject*>(nullptr), [&] { return body().release(); });
}

inline PyRef none() {
    return PyRef(Py_NewRef(Py_None));
}

/// Parses arguments by PyArg_ParseTupleAndKeywords; `names` ends with nullptr.
template <class... Targets>
void parse_arguments(PyObject* args, PyObject* kwargs, const char* format, const char* const* names,
                     Targets*... targets) {
    if (!PyArg_ParseTupleAndKeywords(args, kwargs, format, const_cast<char**>(names), targets...))
        throw PythonError{};
}

}  // namespace trg::py

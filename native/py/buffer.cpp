#include "py/buffer.h"

#include <cstring>

namespace trg::py {

namespace {

/// 'f', 'i' or 'u' of a struct format in native byte order, '?' for any other.
char kind_of_format(const char* format) {
    if (!format) return 'u';
    if (std::strchr("@=<", *format) && *format) ++format;
    if (std::strlen(format) != 1) return '?';
    if (std::strchr("fd", *format)) return 'f';
    if (std::strchr("bhilqn", *format)) return 'i';
    if (std::strchr("BHILQN?", *format)) return 'u';
    return '?';
}

std::string type_name(char kind, size_t size) {
    const char* stem = kind == 'f' ? "float" : kind == 'i' ? "int" : "uint";
    return stem + std::to_string(8 * size);
}

std::string shape_text(std::initializer_list<int64_t> shape) {
    std::string text = "(";
    for (int64_t extent : shape) {
        if (text.size() > 1) text += ", ";
        text += extent == kAnyExtent ? "n" : std::to_string(extent);
    }
    return text + (shape.size() == 1 ? ",)" : ")");
}

}  // namespace

Buffer::Buffer(PyObject* object, const char* name, std::initializer_list<int64_t> shape,
               ItemType type) {
    const int writable = type.access == Access::write ? PyBUF_WRITABLE : 0;
    if (PyObject_GetBuffer(object, &view_, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT | writable) != 0) {
        PyErr_Clear();
        view_.obj = nullptr;
        throw ArgumentError(std::string(name) + ": expected a C-contiguous " +
                            (writable ? "writable " : "") + "array of " +
                            type_name(type.kind, type.size) + " " + shape_text(shape));
    }
    try {
        check_type(name, type);
        check_shape(name, shape);
        check_alignment(name, type);
    } catch (...) {
        PyBuffer_Release(&view_);
        throw;
    }
}

Buffer::Buffer(Buffer&& other) noexcept : view_(std::exchange(other.view_, Py_buffer{})) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(view_, other.view_);
    return *this;
}

Buffer::~Buffer() {
    if (view_.obj) PyBuffer_Release(&view_);
}

void Buffer::check_type(const char* name, ItemType type) const {
    const char kind = kind_of_format(view_.format);
    if (kind == type.kind && static_cast<size_t>(view_.itemsize) == type.size) return;
    const std::string given =
        kind == '?' ? std::string(view_.format) : type_name(kind, view_.itemsize);
    throw ArgumentError(std::string(name) + ": expected " + type_name(type.kind, type.size) +
                        ", got " + given);
}

void Buffer::check_alignment(const char* name, ItemType type) const {
    if (view_.len == 0 || reinterpret_cast<uintptr_t>(view_.buf) % type.size == 0) return;
    throw ArgumentError(std::string(name) + ": expected items at multiples of their size");
}

void Buffer::expect_rows(const char* name, int64_t rows) const {
    if (extent(0) == rows) return;
    throw ArgumentError(std::string(name) + ": expected " + std::to_string(rows) + " rows, got " +
                        std::to_string(extent(0)));
}

bool Buffer::overlaps(const Buffer& other) const {
    const auto begin = reinterpret_cast<uintptr_t>(view_.buf);
    const auto other_begin = reinterpret_cast<uintptr_t>(other.view_.buf);
    return begin < other_begin + other.view_.len && other_begin < begin + view_.len;
}

void Buffer::check_shape(const char* name, std::initializer_list<int64_t> shape) const {
    bool fits = view_.ndim == static_cast<int>(shape.size());
    int dimension = 0;
    for (int64_t extent : shape) {
        if (!fits) break;
        fits = extent == kAnyExtent || extent == view_.shape[dimension];
        ++dimension;
    }
    if (fits) return;
    std::string given = "(";
    for (int k = 0; k < view_.ndim; ++k) given += (k ? ", " : "") + std::to_string(view_.shape[k]);
    throw ArgumentError(std::string(name) + ": expected shape " + shape_text(shape) + ", got " +
                        given + (view_.ndim == 1 ? ",)" : ")"));
}

bool has_item_type(PyObject* object, char kind, size_t size) {
    Py_buffer view;
    if (PyObject_GetBuffer(object, &view, PyBUF_FORMAT | PyBUF_ND | PyBUF_STRIDES) != 0) {
        PyErr_Clear();
        return false;
    }
    const bool same =
        kind_of_format(view.format) == kind && static_cast<size_t>(view.itemsize) == size;
    PyBuffer_Release(&view);
    return same;
}

}  // namespace trg::py

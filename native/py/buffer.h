/// Arrays that cross from Python by the buffer protocol, checked and not copied.
#pragma once

#include <cstdint>
#include <initializer_list>

#include "py/py_ref.h"

namespace trg::py {

enum class Access { read, write };

/// Any extent is allowed in this dimension.
constexpr int64_t kAnyExtent = -1;

/// A C-contiguous array of `Item` (float, double, int32_t, int64_t, uint8_t or uint16_t) held while
/// it lives. `None` gives an empty, absent buffer where `Absence::allowed` is said.
class Buffer {
  public:
    /// `name` is the argument's name in messages; `shape` has kAnyExtent where any extent will do.
    /// Throws ArgumentError for another type of item, shape, layout or alignment.
    template <class Item>
    static Buffer of(PyObject* object, const char* name, std::initializer_list<int64_t> shape,
                     Access access = Access::read) {
        return Buffer(object, name, shape, {item_kind(Item{}), sizeof(Item), access});
    }
    Buffer() = default;
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    ~Buffer();

    bool present() const { return view_.obj != nullptr; }
    int64_t extent(int dimension) const { return view_.shape[dimension]; }
    int64_t dimensions() const { return view_.ndim; }
    /// Throws ArgumentError unless the first extent is `rows`.
    void expect_rows(const char* name, int64_t rows) const;
    /// Whether a byte belongs to both.
    bool overlaps(const Buffer& other) const;
    int64_t count() const { return view_.len / view_.itemsize; }
    template <class Item>
    const Item* data() const {
        return static_cast<const Item*>(view_.buf);
    }
    template <class Item>
    Item* mutable_data() {
        return static_cast<Item*>(view_.buf);
    }

  private:
    struct ItemType {
        char kind;
        size_t size;
        Access access;
    };
    static char item_kind(float) { return 'f'; }
    static char item_kind(double) { return 'f'; }
    static char item_kind(int32_t) { return 'i'; }
    static char item_kind(int64_t) { return 'i'; }
    static char item_kind(uint8_t) { return 'u'; }
    static char item_kind(uint16_t) { return 'u'; }
    Buffer(PyObject* object, const char* name, std::initializer_list<int64_t> shape, ItemType type);
    void check_type(const char* name, ItemType type) const;
    void check_alignment(const char* name, ItemType type) const;
    void check_shape(const char* name, std::initializer_list<int64_t> shape) const;

    Py_buffer view_{};
};

/// True when `object` offers a buffer of `kind` ('f', 'i', 'u') items of `size` bytes: for
/// arguments that take more than one type.
bool has_item_type(PyObject* object, char kind, size_t size);

/// An optional array: absent when `object` is null or None.
template <class Item>
Buffer optional_buffer(PyObject* object, const char* name, std::initializer_list<int64_t> shape) {
    if (!object || object == Py_None) return Buffer();
    return Buffer::of<Item>(object, name, shape);
}

}  // namespace trg::py

/// Vectors for large arrays: items start at cache lines, large blocks lie in large pages.
#pragma once

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

#include "base/large_pages.h"

namespace trg {

/// Items that a vector adds by size alone stay as they are in memory where their type allows it, so
/// that the threads which fill an array are the first to touch it.
template <class T>
struct CacheLineAllocator {
    using value_type = T;

    CacheLineAllocator() = default;
    template <class U>
    CacheLineAllocator(const CacheLineAllocator<U>&) {}
    T* allocate(size_t count) {
        const size_t size = count * sizeof(T);
        void* data = ::operator new(size, alignment(count));
        use_large_pages(data, size);
        return static_cast<T*>(data);
    }
    void deallocate(T* data, size_t count) { ::operator delete(data, alignment(count)); }
    template <class U>
    void construct(U* place) {
        ::new (static_cast<void*>(place)) U;
    }
    template <class U, class... Arguments>
    void construct(U* place, Arguments&&... arguments) {
        ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
    }
    template <class U>
    bool operator==(const CacheLineAllocator<U>&) const {
        return true;
    }
    template <class U>
    bool operator!=(const CacheLineAllocator<U>&) const {
        return false;
    }

  private:
    static std::align_val_t alignment(size_t count) {
        const bool large = count * sizeof(T) >= kLeastLargeBlock;
        return std::align_val_t{large ? kLargePage : 64};
    }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

}  // namespace trg

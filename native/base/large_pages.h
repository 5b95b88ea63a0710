/// Asking the system for large pages, which cost fewer faults to fill and fewer misses to walk.
#pragma once

#include <cstddef>

namespace trg {

constexpr size_t kLargePage = size_t{1} << 21;
/// Smaller blocks are left alone, because up to a page of each may lie idle.
constexpr size_t kLeastLargeBlock = size_t{1} << 23;

/// Advises the system to back a block, aligned to kLargePage, by large pages. Does nothing for
/// small blocks or where there is no such advice; failure is of no account.
void use_large_pages(void* data, size_t size);

}  // namespace trg

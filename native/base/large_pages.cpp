#include "base/large_pages.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace trg {

void use_large_pages([[maybe_unused]] void* data, [[maybe_unused]] size_t size) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (size >= kLeastLargeBlock) madvise(data, size / kLargePage * kLargePage, MADV_HUGEPAGE);
#endif
}

}  // namespace trg

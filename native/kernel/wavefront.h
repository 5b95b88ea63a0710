/// The kernel sets of one instruction set, smallest first.
#pragma once

#include "kernel/kernel_sets.h"

namespace trg {

namespace baseline {
const KernelSet* kernel_sets(int* count);
}
#if defined(TRG_HAS_X86_VARIANTS)
namespace avx2 {
const KernelSet* kernel_sets(int* count);
}
namespace avx512 {
const KernelSet* kernel_sets(int* count);
}
#endif

}  // namespace trg

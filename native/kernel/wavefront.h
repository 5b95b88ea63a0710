/// The kernel sets of one instruction set, smallest first.
#pragma once

#include "kernel/kernel_sets.h"

namespace trg {

namespace baseline {
const KernelSet* kernel_sets(int* count);
const KernelSet* classic_kernel_sets(int* count);
}  // namespace baseline
#if defined(TRG_HAS_X86_VARIANTS)
namespace avx2 {
const KernelSet* kernel_sets(int* count);
const KernelSet* classic_kernel_sets(int* count);
}  // namespace avx2
namespace avx512 {
const KernelSet* kernel_sets(int* count);
const KernelSet* classic_kernel_sets(int* count);
}  // namespace avx512
#endif

}  // namespace trg

#include "base/isa.h"

#if defined(TRG_HAS_X86_VARIANTS) && defined(_MSC_VER)
#include <immintrin.h>
#include <intrin.h>
#endif

namespace trg {

#if defined(TRG_HAS_X86_VARIANTS) && defined(_MSC_VER)

Isa detect_isa() {
    int leaf1[4], leaf7[4];
    __cpuid(leaf1, 1);
    __cpuidex(leaf7, 7, 0);
    const bool xsave = (leaf1[2] >> 27) & 1;
    const unsigned long long state = xsave ? _xgetbv(0) : 0;
    const bool fma = (leaf1[2] >> 12) & 1, avx2 = (leaf7[1] >> 5) & 1;
    const bool bmi = ((leaf7[1] >> 3) & 1) && ((leaf7[1] >> 8) & 1);
    if (!((state & 6) == 6 && fma && avx2 && bmi)) return Isa::baseline;
    const unsigned needed = (1u << 16) | (1u << 17) | (1u << 30) | (1u << 31);
    const bool avx512 = (static_cast<unsigned>(leaf7[1]) & needed) == needed;
    return avx512 && (state & 0xe6) == 0xe6 ? Isa::avx512 : Isa::avx2;
}

#elif defined(TRG_HAS_X86_VARIANTS)

Isa detect_isa() {
    __builtin_cpu_init();
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                      __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
    if (!avx2) return Isa::baseline;
    const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
    return avx512 ? Isa::avx512 : Isa::avx2;
}

#else

Isa detect_isa() {
    return Isa::baseline;
}

#endif

const char* isa_name(Isa isa) {
    switch (isa) {
        case Isa::avx2:
            return "avx2";
        case Isa::avx512:
            return "avx512";
        default:
            return "baseline";
    }
}

}  // namespace trg

/// Eight floats at once: AVX2 registers where the unit is compiled for them, plain loops elsewhere.
#pragma once

#include <cstdint>

#include "accel/wide_node.h"
#include "base/config.h"

#if defined(__AVX2__)
#include <immintrin.h>
#endif
#if defined(_MSC_VER)
#include <intrin.h>
#endif

namespace trg::TRG_ISA {

TRG_FN int lowest_bit(uint32_t mask) {
#if defined(_MSC_VER)
    unsigned long index;
    _BitScanForward(&index, mask);
    return static_cast<int>(index);
#else
    return __builtin_ctz(mask);
#endif
}

TRG_FN int count_bits(uint32_t mask) {
#if defined(_MSC_VER)
    return static_cast<int>(__popcnt(mask));
#else
    return __builtin_popcount(mask);
#endif
}

TRG_INLINE_FN void prefetch(const void* address) {
#if defined(__AVX2__)
    _mm_prefetch(static_cast<const char*>(address), _MM_HINT_T0);
#elif defined(__GNUC__)
    __builtin_prefetch(address);
#else
    (void)address;
#endif
}

#if defined(__AVX2__)

struct Float8 {
    __m256 v;
};

TRG_FN Float8 load8(const float* p) {
    return {_mm256_load_ps(p)};
}
/// As load8, from any address.
TRG_FN Float8 load_row(const float* p) {
    return {_mm256_loadu_ps(p)};
}
TRG_FN Float8 splat8(float x) {
    return {_mm256_set1_ps(x)};
}
TRG_FN Float8 operator+(Float8 a, Float8 b) {
    return {_mm256_add_ps(a.v, b.v)};
}
TRG_FN Float8 operator-(Float8 a, Float8 b) {
    return {_mm256_sub_ps(a.v, b.v)};
}
TRG_FN Float8 operator*(Float8 a, Float8 b) {
    return {_mm256_mul_ps(a.v, b.v)};
}
TRG_FN Float8 operator/(Float8 a, Float8 b) {
    return {_mm256_div_ps(a.v, b.v)};
}
/// a b + c, rounded once or twice.
TRG_FN Float8 multiply_add(Float8 a, Float8 b, Float8 c) {
    return {_mm256_fmadd_ps(a.v, b.v, c.v)};
}
/// c - a b, rounded once or twice.
TRG_FN Float8 subtract_product(Float8 c, Float8 a, Float8 b) {
    return {_mm256_fnmadd_ps(a.v, b.v, c.v)};
}
/// The smaller and the larger; `b` where `a` is NaN.
TRG_FN Float8 min8(Float8 a, Float8 b) {
    return {_mm256_min_ps(a.v, b.v)};
}
TRG_FN Float8 max8(Float8 a, Float8 b) {
    return {_mm256_max_ps(a.v, b.v)};
}
TRG_FN Float8 abs8(Float8 a) {
    return {_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v)};
}
TRG_FN Float8 negate8(Float8 a) {
    return {_mm256_xor_ps(_mm256_set1_ps(-0.0f), a.v)};
}
TRG_FN void store8(float* p, Float8 a) {
    _mm256_storeu_ps(p, a.v);
}

#if defined(__AVX512VL__) && defined(__AVX512DQ__)
/// The larger of the magnitudes.
TRG_FN Float8 max_abs8(Float8 a, Float8 b) {
    return {_mm256_range_ps(a.v, b.v, 0xb)};
}
/// Bit k is set where a <= b; never for NaN.
TRG_FN uint32_t mask_less_equal(Float8 a, Float8 b) {
    return _mm256_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ);
}
TRG_FN uint32_t mask_less(Float8 a, Float8 b) {
    return _mm256_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ);
}
#else
TRG_FN Float8 max_abs8(Float8 a, Float8 b) {
    return max8(abs8(a), abs8(b));
}
TRG_FN uint32_t mask_less_equal(Float8 a, Float8 b) {
    return _mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ));
}
TRG_FN uint32_t mask_less(Float8 a, Float8 b) {
    return _mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ));
}
#endif

#else

struct Float8 {
    float v[kWidth];
};

#define TRG_EACH_LANE(result, expression)                        \
    Float8 result;                                               \
    for (int k = 0; k < kWidth; ++k) result.v[k] = (expression); \
    return result

TRG_FN Float8 load8(const float* p) {
    TRG_EACH_LANE(r, p[k]);
}
TRG_FN Float8 load_row(const float* p) {
    TRG_EACH_LANE(r, p[k]);
}
TRG_FN Float8 splat8(float x) {
    TRG_EACH_LANE(r, x);
}
TRG_FN Float8 operator+(const Float8& a, const Float8& b) {
    TRG_EACH_LANE(r, a.v[k] + b.v[k]);
}
TRG_FN Float8 operator-(const Float8& a, const Float8& b) {
    TRG_EACH_LANE(r, a.v[k] - b.v[k]);
}
TRG_FN Float8 operator*(const Float8& a, const Float8& b) {
    TRG_EACH_LANE(r, a.v[k] * b.v[k]);
}
TRG_FN Float8 operator/(const Float8& a, const Float8& b) {
    TRG_EACH_LANE(r, a.v[k] / b.v[k]);
}
TRG_FN Float8 multiply_add(const Float8& a, const Float8& b, const Float8& c) {
    return a * b + c;
}
TRG_FN Float8 subtract_product(const Float8& c, const Float8& a, const Float8& b) {
    return c - a * b;
}
TRG_FN Float8 min8(const Float8& a, const Float8& b) {
    TRG_EACH_LANE(r, a.v[k] < b.v[k] ? a.v[k] : b.v[k]);
}
TRG_FN Float8 max8(const Float8& a, const Float8& b) {
    TRG_EACH_LANE(r, a.v[k] > b.v[k] ? a.v[k] : b.v[k]);
}
TRG_FN Float8 abs8(const Float8& a) {
    TRG_EACH_LANE(r, a.v[k] < 0 ? -a.v[k] : a.v[k]);
}
TRG_FN Float8 negate8(const Float8& a) {
    TRG_EACH_LANE(r, -a.v[k]);
}
TRG_FN Float8 max_abs8(const Float8& a, const Float8& b) {
    return max8(abs8(a), abs8(b));
}
TRG_FN void store8(float* p, const Float8& a) {
    for (int k = 0; k < kWidth; ++k) p[k] = a.v[k];
}
TRG_FN uint32_t mask_less_equal(const Float8& a, const Float8& b) {
    uint32_t mask = 0;
    for (int k = 0; k < kWidth; ++k) mask |= static_cast<uint32_t>(a.v[k] <= b.v[k]) << k;
    return mask;
}
TRG_FN uint32_t mask_less(const Float8& a, const Float8& b) {
    uint32_t mask = 0;
    for (int k = 0; k < kWidth; ++k) mask |= static_cast<uint32_t>(a.v[k] < b.v[k]) << k;
    return mask;
}

#undef TRG_EACH_LANE

#endif

}  // namespace trg::TRG_ISA

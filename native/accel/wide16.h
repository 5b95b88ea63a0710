/// Sixteen floats at once: one AVX-512 register, or two rows of eight.
#pragma once

#include "accel/wide8.h"

namespace trg::TRG_ISA {

#if defined(__AVX512F__)

struct Float16 {
    __m512 v;
};

TRG_FN Float16 load16(const float* p) {
    return {_mm512_load_ps(p)};
}
TRG_FN Float16 splat16(float x) {
    return {_mm512_set1_ps(x)};
}
TRG_FN void store16(float* p, Float16 a) {
    _mm512_store_ps(p, a.v);
}
TRG_FN Float16 operator*(Float16 a, Float16 b) {
    return {_mm512_mul_ps(a.v, b.v)};
}
/// a b + c, rounded once or twice.
TRG_FN Float16 multiply_add(Float16 a, Float16 b, Float16 c) {
    return {_mm512_fmadd_ps(a.v, b.v, c.v)};
}
TRG_FN Float16 min16(Float16 a, Float16 b) {
    return {_mm512_min_ps(a.v, b.v)};
}
TRG_FN Float16 max16(Float16 a, Float16 b) {
    return {_mm512_max_ps(a.v, b.v)};
}
/// Bit k is set where a <= b; never for NaN.
TRG_FN uint32_t mask_less_equal(Float16 a, Float16 b) {
    return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ);
}

#else

struct Float16 {
    Float8 low, high;
};

TRG_FN Float16 load16(const float* p) {
    return {load8(p), load8(p + kWidth)};
}
TRG_FN Float16 splat16(float x) {
    return {splat8(x), splat8(x)};
}
TRG_FN void store16(float* p, const Float16& a) {
    store8(p, a.low);
    store8(p + kWidth, a.high);
}
TRG_FN Float16 operator*(const Float16& a, const Float16& b) {
    return {a.low * b.low, a.high * b.high};
}
TRG_FN Float16 multiply_add(const Float16& a, const Float16& b, const Float16& c) {
    return {multiply_add(a.low, b.low, c.low), multiply_add(a.high, b.high, c.high)};
}
TRG_FN Float16 min16(const Float16& a, const Float16& b) {
    return {min8(a.low, b.low), min8(a.high, b.high)};
}
TRG_FN Float16 max16(const Float16& a, const Float16& b) {
    return {max8(a.low, b.low), max8(a.high, b.high)};
}
TRG_FN uint32_t mask_less_equal(const Float16& a, const Float16& b) {
    return mask_less_equal(a.low, b.low) | mask_less_equal(a.high, b.high) << kWidth;
}

#endif

}  // namespace trg::TRG_ISA

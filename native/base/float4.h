/// Four floats at once, for work on boxes: SSE2, which every x86-64 has, or plain loops.
#pragma once

#include "base/config.h"

#if defined(__SSE2__) || defined(_M_X64)
#define TRG_HAS_SSE2 1
#include <emmintrin.h>
#endif

namespace trg {

#if defined(TRG_HAS_SSE2)

struct Float4 {
    __m128 v;
};

/// `p` must be aligned to 16 bytes.
TRG_FN Float4 load4(const float* p) {
    return {_mm_load_ps(p)};
}
TRG_FN void store4(float* p, Float4 a) {
    _mm_storeu_ps(p, a.v);
}
TRG_FN Float4 splat4(float x) {
    return {_mm_set1_ps(x)};
}
TRG_FN Float4 operator+(Float4 a, Float4 b) {
    return {_mm_add_ps(a.v, b.v)};
}
TRG_FN Float4 operator-(Float4 a, Float4 b) {
    return {_mm_sub_ps(a.v, b.v)};
}
TRG_FN Float4 operator*(Float4 a, Float4 b) {
    return {_mm_mul_ps(a.v, b.v)};
}
TRG_FN Float4 min4(Float4 a, Float4 b) {
    return {_mm_min_ps(a.v, b.v)};
}
TRG_FN Float4 max4(Float4 a, Float4 b) {
    return {_mm_max_ps(a.v, b.v)};
}
/// The four numbers cut to integers.
TRG_FN void truncate4(int* p, Float4 a) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm_cvttps_epi32(a.v));
}
/// Number by number, x where a < b, else y; y where one of a and b is NaN.
TRG_FN Float4 select_less4(Float4 a, Float4 b, Float4 x, Float4 y) {
    const __m128 less = _mm_cmplt_ps(a.v, b.v);
    return {_mm_or_ps(_mm_and_ps(less, x.v), _mm_andnot_ps(less, y.v))};
}
/// The first three columns of three rows, as rows; the fourth number of each means nothing.
TRG_FN void transpose3(Float4 rows[3]) {
    const __m128 low = _mm_unpacklo_ps(rows[0].v, rows[1].v);
    const __m128 high = _mm_unpackhi_ps(rows[0].v, rows[1].v);
    const __m128 last = rows[2].v;
    rows[0].v = _mm_movelh_ps(low, last);
    rows[1].v = _mm_shuffle_ps(low, last, _MM_SHUFFLE(3, 1, 3, 2));
    rows[2].v = _mm_shuffle_ps(high, last, _MM_SHUFFLE(3, 2, 1, 0));
}
/// Integers, at an address aligned to 16 bytes, as numbers.
TRG_FN Float4 load_ints4(const int* p) {
    return {_mm_cvtepi32_ps(_mm_load_si128(reinterpret_cast<const __m128i*>(p)))};
}

#else

struct Float4 {
    float v[4];
};

TRG_FN Float4 load4(const float* p) {
    return {{p[0], p[1], p[2], p[3]}};
}
TRG_FN void store4(float* p, const Float4& a) {
    for (int k = 0; k < 4; ++k) p[k] = a.v[k];
}
TRG_FN Float4 splat4(float x) {
    return {{x, x, x, x}};
}
TRG_FN Float4 operator+(Float4 a, const Float4& b) {
    for (int k = 0; k < 4; ++k) a.v[k] += b.v[k];
    return a;
}
TRG_FN Float4 operator-(Float4 a, const Float4& b) {
    for (int k = 0; k < 4; ++k) a.v[k] -= b.v[k];
    return a;
}
TRG_FN Float4 operator*(Float4 a, const Float4& b) {
    for (int k = 0; k < 4; ++k) a.v[k] *= b.v[k];
    return a;
}
TRG_FN Float4 min4(Float4 a, const Float4& b) {
    for (int k = 0; k < 4; ++k) a.v[k] = a.v[k] < b.v[k] ? a.v[k] : b.v[k];
    return a;
}
TRG_FN Float4 max4(Float4 a, const Float4& b) {
    for (int k = 0; k < 4; ++k) a.v[k] = a.v[k] > b.v[k] ? a.v[k] : b.v[k];
    return a;
}
TRG_FN void truncate4(int* p, const Float4& a) {
    for (int k = 0; k < 4; ++k) p[k] = static_cast<int>(a.v[k]);
}
TRG_FN Float4 select_less4(const Float4& a, const Float4& b, const Float4& x, Float4 y) {
    for (int k = 0; k < 4; ++k) y.v[k] = a.v[k] < b.v[k] ? x.v[k] : y.v[k];
    return y;
}
TRG_FN void transpose3(Float4 rows[3]) {
    const Float4 a = rows[0], b = rows[1], c = rows[2];
    for (int k = 0; k < 3; ++k) rows[k] = {{a.v[k], b.v[k], c.v[k], 0}};
}
TRG_FN Float4 load_ints4(const int* p) {
    Float4 a;
    for (int k = 0; k < 4; ++k) a.v[k] = static_cast<float>(p[k]);
    return a;
}

#endif

}  // namespace trg

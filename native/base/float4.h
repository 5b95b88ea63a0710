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

#endif

}  // namespace trg

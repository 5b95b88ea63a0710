/// Macros that every unit of the native core shares.
#pragma once

/// Marks a function of a header that is compiled once per instruction set: each unit keeps its own
/// copy, so that the linker can never put AVX code into the baseline build.
#define TRG_FN [[maybe_unused]] static inline

/// As TRG_FN, for the few steps of inner loops that must not become calls.
#if defined(__GNUC__)
#define TRG_INLINE_FN [[maybe_unused]] __attribute__((always_inline)) static inline
#define TRG_INLINE_METHOD __attribute__((always_inline))
#else
#define TRG_INLINE_FN [[maybe_unused]] static inline
#define TRG_INLINE_METHOD
#endif

/// As TRG_FN, for what is rarely called and must not take registers from its callers.
#if defined(__GNUC__)
#define TRG_RARE_FN [[maybe_unused]] __attribute__((noinline, cold)) static
#else
#define TRG_RARE_FN [[maybe_unused]] static
#endif

/// As TRG_FN, for large parts that are entered once for much work and must stay apart from what is
/// inlined beside them.
#if defined(__GNUC__)
#define TRG_APART_FN [[maybe_unused]] __attribute__((noinline)) static
#else
#define TRG_APART_FN [[maybe_unused]] static
#endif

/// Namespace of the instruction set that this unit is compiled for (baseline, avx2 or avx512).
#ifndef TRG_ISA
#define TRG_ISA baseline
#endif

/// Owen-scrambled Sobol points in pairs of dimensions, found by hashing: no tables, no state.
/// Scrambling by the hash of Laine and Karras 2011 as tuned by Vegdahl 2021; shuffled padding after
/// Burley 2020, "Practical Hash-based Owen Scrambling".
#pragma once

#include <cstdint>

#include "base/config.h"

namespace trg {

/// Two uniform numbers in [0, 1 - 2^-24].
struct Sample2 {
    float u, v;
};

/// Names one sample of one pixel: what every number drawn for it depends on.
struct SampleKey {
    uint32_t stream;
    uint32_t reversed_index;
};

constexpr int kReplicates = 8;
constexpr float kBelowOne = 0.999999940395355225f;

/// Finaliser of MurmurHash3: every bit of the result depends on every bit of `x`.
TRG_INLINE_FN uint32_t hash_bits(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x85ebca6bu;
    x = (x ^ (x >> 13)) * 0xc2b2ae35u;
    return x ^ (x >> 16);
}

TRG_INLINE_FN uint32_t reverse_bits(uint32_t x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
#if defined(__GNUC__) && !defined(__CUDACC__)
    return __builtin_bswap32(x);
#else
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
#endif
}

/// A permutation in which bit i of the result depends on bits 0 to i of `x` alone: Owen scrambling
/// of the number whose bits are `x` reversed.
TRG_INLINE_FN uint32_t scramble_reversed(uint32_t x, uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// The second Sobol dimension of `index`, its bits reversed. Its generator matrix is Pascal's
/// triangle modulo 2, a Kronecker power of (1 1; 0 1), so five steps apply it.
TRG_INLINE_FN uint32_t sobol_second_reversed(uint32_t index) {
    uint32_t x = index;
    x ^= (x & 0xaaaaaaaau) >> 1;
    x ^= (x & 0xccccccccu) >> 2;
    x ^= (x & 0xf0f0f0f0u) >> 4;
    x ^= (x & 0xff00ff00u) >> 8;
    x ^= (x & 0xffff0000u) >> 16;
    return x;
}

TRG_INLINE_FN float uniform_of_bits(uint32_t bits) {
    return static_cast<float>(static_cast<int32_t>(bits >> 8)) * 5.9604644775390625e-8f;
}

/// Key of sample `sample` of pixel (x, y): the replicate is sample mod 8, each with points of its
/// own; the index within the replicate is sample / 8.
TRG_INLINE_FN SampleKey make_sample_key(uint32_t x, uint32_t y, uint32_t sample, uint32_t seed) {
    const uint32_t replicate = sample % kReplicates;
    const uint32_t of_seed = hash_bits(seed * 0x9e3779b9u + replicate * 0x7feb352du + 1u);
    const uint32_t of_row = hash_bits(of_seed ^ (y * 0x9e3779b1u));
    return {hash_bits(of_row ^ (x * 0x85ebca77u)), reverse_bits(sample / kReplicates)};
}

/// The pair of raw 32-bit numbers of `dimension` (a pair counts once).
TRG_INLINE_FN void sample_bits(SampleKey key, uint32_t dimension, uint32_t bits[2]) {
    const uint32_t seed = hash_bits(key.stream ^ (dimension * 0x9e3779b9u));
    const uint32_t index = reverse_bits(scramble_reversed(key.reversed_index, seed));
    const uint32_t seed_u = hash_bits(seed + 0x68bc21ebu), seed_v = hash_bits(seed + 0x02e5be93u);
    bits[0] = reverse_bits(scramble_reversed(index, seed_u));
    bits[1] = reverse_bits(scramble_reversed(sobol_second_reversed(index), seed_v));
}

TRG_FN Sample2 sample_uniform2(SampleKey key, uint32_t dimension) {
    uint32_t bits[2];
    sample_bits(key, dimension, bits);
    return {uniform_of_bits(bits[0]), uniform_of_bits(bits[1])};
}

/// Numbers are drawn so many at a time where many are needed: side by side in vector registers they
/// cost little more than one.
constexpr int kSampleLanes = 8;

/// The raw pairs of kSampleLanes dimensions in a row.
struct DimensionBlock {
    uint32_t first[kSampleLanes], second[kSampleLanes];
};

TRG_FN void draw_dimensions(SampleKey key, uint32_t dimension, DimensionBlock* block) {
    for (int k = 0; k < kSampleLanes; ++k) {
        uint32_t bits[2];
        sample_bits(key, dimension + static_cast<uint32_t>(k), bits);
        block->first[k] = bits[0];
        block->second[k] = bits[1];
    }
}

/// Number `lane` of a block, as sample_uniform2 has it.
TRG_FN Sample2 uniform_of_block(const DimensionBlock& block, int lane) {
    return {uniform_of_bits(block.first[lane]), uniform_of_bits(block.second[lane])};
}

/// Keys of kSampleLanes samples of a pixel in a row and a pair of numbers for each.
struct KeyBlock {
    uint32_t stream[kSampleLanes], reversed_index[kSampleLanes];
    float u[kSampleLanes], v[kSampleLanes];
};

/// One sample of one pixel of a render of `seed`.
struct SamplePlace {
    uint32_t x, y, sample, seed;
};

/// As make_sample_key for `at` and the samples after it, and sample_uniform2 of `dimension`.
TRG_FN void draw_keys(const SamplePlace& at, uint32_t dimension, KeyBlock* block) {
    for (int k = 0; k < kSampleLanes; ++k) {
        const SampleKey key =
            make_sample_key(at.x, at.y, at.sample + static_cast<uint32_t>(k), at.seed);
        uint32_t bits[2];
        sample_bits(key, dimension, bits);
        block->stream[k] = key.stream;
        block->reversed_index[k] = key.reversed_index;
        block->u[k] = uniform_of_bits(bits[0]);
        block->v[k] = uniform_of_bits(bits[1]);
    }
}

}  // namespace trg

/// Gradient noise (Perlin 2002) in one to four dimensions and its fractal sums (Musgrave 1998),
/// with the lattice hash, the scales and the repeat distance that Blender's Noise Texture has.
#pragma once

#include <cstdint>
#include <cstring>

#include "shade/frame.h"

namespace trg {

TRG_FN uint32_t rotate_left(uint32_t x, int k) {
    return (x << k) | (x >> (32 - k));
}

/// Bob Jenkins' lookup3 (2006) of up to four words.
template <int N>
TRG_FN uint32_t hash_words(const uint32_t* k) {
    uint32_t a = 0xdeadbeefu + (static_cast<uint32_t>(N) << 2) + 13u, b = a, c = a;
    a += k[0];
    if constexpr (N > 1) b += k[1];
    if constexpr (N > 2) c += k[2];
    if constexpr (N > 3) {
        a = (a - c) ^ rotate_left(c, 4), c += b;
        b = (b - a) ^ rotate_left(a, 6), a += c;
        c = (c - b) ^ rotate_left(b, 8), b += a;
        a = (a - c) ^ rotate_left(c, 16), c += b;
        b = (b - a) ^ rotate_left(a, 19), a += c;
        c = (c - b) ^ rotate_left(b, 4), b += a;
        a += k[3];
    }
    c = (c ^ b) - rotate_left(b, 14);
    a = (a ^ c) - rotate_left(c, 11);
    b = (b ^ a) - rotate_left(a, 25);
    c = (c ^ b) - rotate_left(b, 16);
    a = (a ^ c) - rotate_left(c, 4);
    b = (b ^ a) - rotate_left(a, 14);
    c = (c ^ b) - rotate_left(b, 24);
    return c;
}

/// A number from 0 to 1 that belongs to the bits of `k`.
template <int N>
TRG_FN float hash_floats(const float* k) {
    uint32_t words[N];
    std::memcpy(words, k, sizeof words);
    return static_cast<float>(hash_words<N>(words)) * (1.0f / 4294967295.0f);
}

TRG_FN float turn_sign(float x, uint32_t negative) {
    return negative ? -x : x;
}

/// The dot product of `d` with the gradient that `hash` picks.
template <int N>
TRG_FN float lattice_slope(uint32_t hash, const float* d) {
    if constexpr (N == 1) {
        return turn_sign(1.0f + static_cast<float>(hash & 7u), hash & 8u) * d[0];
    } else if constexpr (N == 2) {
        const bool first = (hash & 7u) < 4u;
        return turn_sign(first ? d[0] : d[1], hash & 1u) +
               turn_sign(2.0f * (first ? d[1] : d[0]), hash & 2u);
    } else if constexpr (N == 3) {
        const uint32_t h = hash & 15u;
        const float other = h == 12u || h == 14u ? d[0] : d[2];
        return turn_sign(h < 8u ? d[0] : d[1], h & 1u) + turn_sign(h < 4u ? d[1] : other, h & 2u);
    } else {
        const uint32_t h = hash & 31u;
        return turn_sign(h < 24u ? d[0] : d[1], h & 1u) + turn_sign(h < 16u ? d[1] : d[2], h & 2u) +
               turn_sign(h < 8u ? d[2] : d[3], h & 4u);
    }
}

/// Noise between about -1 and 1, of a coordinate repeated every 100 000.
template <int N>
TRG_FN float eval_noise(const float* p) {
    constexpr float kScales[4] = {0.25f, 0.6616f, 0.982f, 0.8344f};
    uint32_t cell[N];
    float rest[N], fade[N];
    for (int k = 0; k < N; ++k) {
        // On whole numbers noise is null, and so far out there are no others.
        const float shift = std::fabs(p[k]) >= 1e6f ? 0.5f : 0.0f;
        const float x = std::isfinite(p[k]) ? std::fmod(p[k], 100000.0f) + shift : 0.0f;
        const float low = std::floor(x);
        cell[k] = static_cast<uint32_t>(static_cast<int32_t>(low));
        rest[k] = x - low;
        const float t = rest[k];
        fade[k] = t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
    }
    float value[1 << N];
    for (int corner = 0; corner < 1 << N; ++corner) {
        uint32_t at[N];
        float d[N];
        for (int k = 0; k < N; ++k) {
            const uint32_t step = (static_cast<uint32_t>(corner) >> k) & 1u;
            at[k] = cell[k] + step;
            d[k] = rest[k] - static_cast<float>(step);
        }
        value[corner] = lattice_slope<N>(hash_words<N>(at), d);
    }
    for (int k = 0, count = 1 << (N - 1); k < N; ++k, count >>= 1)
        for (int i = 0; i < count; ++i)
            value[i] = value[2 * i] * (1.0f - fade[k]) + value[2 * i + 1] * fade[k];
    return kScales[N - 1] * value[0];
}

enum class NoiseKind : int32_t { multifractal, ridged, hybrid, fbm, hetero };

/// How octaves add up.
struct Fractal {
    NoiseKind kind;
    bool normalize;
    float detail, roughness, lacunarity, offset, gain;
};

/// Where the next octave is looked up.
template <int N>
struct Octaves {
    float p[N];
    float lacunarity;
};

template <int N>
TRG_FN float next_octave(Octaves<N>& octaves) {
    const float value = eval_noise<N>(octaves.p);
    for (int k = 0; k < N; ++k) octaves.p[k] *= octaves.lacunarity;
    return value;
}

template <int N>
TRG_FN float sum_octaves(Octaves<N> octaves, const Fractal& f) {
    const float whole = std::floor(f.detail), part = f.detail - whole;
    float amplitude = 1.0f, total = 0.0f, sum = 0.0f;
    for (int32_t i = 0; i <= static_cast<int32_t>(whole); ++i) {
        sum += next_octave(octaves) * amplitude;
        total += amplitude;
        amplitude *= f.roughness;
    }
    const float plain = f.normalize ? 0.5f * sum / total + 0.5f : sum;
    if (part == 0.0f) return plain;
    const float more = sum + next_octave(octaves) * amplitude;
    const float last = f.normalize ? 0.5f * more / (total + amplitude) + 0.5f : more;
    return plain * (1.0f - part) + last * part;
}

template <int N>
TRG_FN float multiply_octaves(Octaves<N> octaves, const Fractal& f) {
    const float whole = std::floor(f.detail), part = f.detail - whole;
    float value = 1.0f, power = 1.0f;
    for (int32_t i = 0; i <= static_cast<int32_t>(whole); ++i) {
        value *= power * next_octave(octaves) + 1.0f;
        power *= f.roughness;
    }
    return part == 0.0f ? value : value * (part * power * next_octave(octaves) + 1.0f);
}

template <int N>
TRG_FN float hetero_octaves(Octaves<N> octaves, const Fractal& f) {
    const float whole = std::floor(f.detail), part = f.detail - whole;
    float power = f.roughness, value = f.offset + next_octave(octaves);
    for (int32_t i = 1; i <= static_cast<int32_t>(whole); ++i) {
        value += (next_octave(octaves) + f.offset) * power * value;
        power *= f.roughness;
    }
    if (part != 0.0f) value += part * (next_octave(octaves) + f.offset) * power * value;
    return value;
}

template <int N>
TRG_FN float hybrid_octaves(Octaves<N> octaves, const Fractal& f) {
    const float whole = std::floor(f.detail), part = f.detail - whole;
    float power = 1.0f, value = 0.0f, weight = 1.0f;
    for (int32_t i = 0; weight > 0.001f && i <= static_cast<int32_t>(whole); ++i) {
        weight = smaller(weight, 1.0f);
        const float signal = (next_octave(octaves) + f.offset) * power;
        power *= f.roughness;
        value += weight * signal;
        weight *= f.gain * signal;
    }
    if (part == 0.0f || !(weight > 0.001f)) return value;
    return value + part * smaller(weight, 1.0f) * (next_octave(octaves) + f.offset) * power;
}

template <int N>
TRG_FN float ridged_octaves(Octaves<N> octaves, const Fractal& f) {
    float power = f.roughness, value = 0.0f, signal = 0.0f;
    for (int32_t i = 0; i <= static_cast<int32_t>(std::floor(f.detail)); ++i) {
        const float ridge = f.offset - std::fabs(next_octave(octaves));
        const float weight = i == 0 ? 1.0f : clamp01(signal * f.gain);
        signal = ridge * ridge * weight;
        value += i == 0 ? signal : signal * power;
        if (i > 0) power *= f.roughness;
    }
    return value;
}

/// The fractal's value at `p`; `detail` lies between 0 and 15.
template <int N>
TRG_FN float eval_fractal(const float* p, const Fractal& f) {
    Octaves<N> octaves;
    for (int k = 0; k < N; ++k) octaves.p[k] = p[k];
    octaves.lacunarity = f.lacunarity;
    switch (f.kind) {
        case NoiseKind::multifractal:
            return multiply_octaves<N>(octaves, f);
        case NoiseKind::ridged:
            return ridged_octaves<N>(octaves, f);
        case NoiseKind::hybrid:
            return hybrid_octaves<N>(octaves, f);
        case NoiseKind::hetero:
            return hetero_octaves<N>(octaves, f);
        default:
            return sum_octaves<N>(octaves, f);
    }
}

/// Where another noise as good as independent begins: 100 to 200 along each axis.
template <int N>
TRG_FN void shift_noise(const float* p, float seed, float* shifted) {
    for (int k = 0; k < N; ++k) {
        const float key[2] = {seed, static_cast<float>(k)};
        shifted[k] =
            p[k] + (100.0f + 100.0f * (N == 1 ? hash_floats<1>(key) : hash_floats<2>(key)));
    }
}

/// The Noise Texture at the scaled place `p`: its value, and with `colored` the two others that
/// make it a colour (else all three are the value).
template <int N>
TRG_FN Vec3 eval_noise_texture(const float* p, const Fractal& f, float distortion, bool colored) {
    float place[N], other[N];
    for (int k = 0; k < N; ++k) place[k] = p[k];
    if (distortion != 0.0f)
        for (int k = 0; k < N; ++k) {
            shift_noise<N>(p, static_cast<float>(k), other);
            place[k] += eval_noise<N>(other) * distortion;
        }
    const float value = eval_fractal<N>(place, f);
    if (!colored) return {value, value, value};
    Vec3 color{value, 0.0f, 0.0f};
    shift_noise<N>(place, static_cast<float>(N), other);
    color.y = eval_fractal<N>(other, f);
    shift_noise<N>(place, static_cast<float>(N + 1), other);
    color.z = eval_fractal<N>(other, f);
    return color;
}

}  // namespace trg

/// Images and their plain look-up, as Cycles does it: interpolation of the values as they are
/// stored, then out of their encoding.
#pragma once

#include <cstdint>
#include <cstring>

#include "shade/frame.h"

namespace trg {

enum class PixelKind : int32_t { bytes, halves, floats };
enum class Wrap : int32_t { repeat, extend, clip, mirror };
enum class Filter : int32_t { linear, closest, cubic };
/// What of a texel is looked up: its colour, its alpha as a grey, its luminance as a grey.
enum class Channel : int32_t { color, alpha, luminance };

/// Red, green, blue and alpha.
struct Texel {
    float r, g, b, a;
};

/// Pixels of one image; row 0 is the bottom row.
struct ImageView {
    const void* pixels;
    PixelKind kind;
    const float* decode;  // kDecodeSteps + 2 linear values of evenly encoded ones; null: linear
    int32_t width, height, channels;
};
constexpr int32_t kDecodeSteps = 4096;

/// An image looked up at (scale_u u + skew_u v + offset_u, skew_v u + scale_v v + offset_v), or a
/// program.
struct Texture {
    int32_t image;
    float scale_u, scale_v, offset_u, offset_v, skew_u, skew_v;
    Wrap wrap;
    Filter filter;
    Channel channel;
    bool unassociate;  // the stored colour was multiplied by alpha: divide it again
    int32_t uv_map;    // 0: the mesh's own, else a corner attribute
    int32_t program;   // -1: an image
};

TRG_FN Texel operator+(Texel a, Texel b) {
    return {a.r + b.r, a.g + b.g, a.b + b.b, a.a + b.a};
}
TRG_FN Texel operator*(Texel a, float s) {
    return {a.r * s, a.g * s, a.b * s, a.a * s};
}

/// Value of an IEEE 754 half (finite; images hold nothing else).
TRG_FN float half_value(uint16_t half) {
    const uint32_t sign = static_cast<uint32_t>(half & 0x8000u) << 16;
    const uint32_t exponent = (half >> 10) & 31u, mantissa = half & 1023u;
    if (exponent == 0) {
        const float tiny = static_cast<float>(mantissa) * 5.9604645e-8f;
        return sign ? -tiny : tiny;
    }
    const uint32_t bits = sign | ((exponent + 112u) << 23) | (mantissa << 13);
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

/// One stored number; those of bytes lie between 0 and 1.
TRG_FN float stored_value(const ImageView& image, int64_t at) {
    switch (image.kind) {
        case PixelKind::bytes:
            return static_cast<float>(static_cast<const uint8_t*>(image.pixels)[at]) *
                   (1.0f / 255.0f);
        case PixelKind::halves:
            return half_value(static_cast<const uint16_t*>(image.pixels)[at]);
        default:
            return static_cast<const float*>(image.pixels)[at];
    }
}

TRG_FN Texel load_texel(const ImageView& image, int32_t x, int32_t y) {
    const int64_t at = (static_cast<int64_t>(y) * image.width + x) * image.channels;
    const float first = stored_value(image, at);
    if (image.channels == 1) return {first, first, first, 1.0f};
    return {first, stored_value(image, at + 1), stored_value(image, at + 2),
            image.channels > 3 ? stored_value(image, at + 3) : 1.0f};
}

/// The texel that stands for number `i` of `size`; -1 where there is none.
TRG_FN int32_t wrap_texel(int32_t i, int32_t size, Wrap wrap) {
    if (i >= 0 && i < size) return i;
    switch (wrap) {
        case Wrap::repeat: {
            const int32_t rest = i % size;
            return rest < 0 ? rest + size : rest;
        }
        case Wrap::extend:
            return i < 0 ? 0 : size - 1;
        case Wrap::mirror: {
            const int32_t turned = (i < 0 ? -i - 1 : i) % (2 * size);
            return turned < size ? turned : 2 * size - 1 - turned;
        }
        default:
            return -1;
    }
}

/// The texels of one axis that a look-up mixes, -1 for outside.
struct Taps {
    int32_t count;
    int32_t at[4];
    float weight[4];
};

/// A coordinate brought near the image, in texels; 0 when not finite.
TRG_FN float place_texel(float position, int32_t size, Wrap wrap) {
    if (!std::isfinite(position)) return 0.0f;
    if (wrap == Wrap::repeat) position -= std::floor(position);
    if (wrap == Wrap::mirror) position -= 2.0f * std::floor(0.5f * position);
    const float side = static_cast<float>(size);
    return smaller(larger(position * side, -4.0f), 2.0f * side + 4.0f);
}

/// Uniform cubic B-spline weights at `t` between the two middle ones.
TRG_FN void set_cubic_weights(float t, float* weight) {
    const float s = 1.0f - t;
    weight[0] = s * s * s * (1.0f / 6.0f);
    weight[1] = (0.5f * t - 1.0f) * t * t + 2.0f / 3.0f;
    weight[2] = (0.5f * s - 1.0f) * s * s + 2.0f / 3.0f;
    weight[3] = t * t * t * (1.0f / 6.0f);
}

TRG_FN Taps make_taps(float position, int32_t size, Wrap wrap, Filter filter) {
    const float texel = place_texel(position, size, wrap);
    Taps taps;
    if (filter == Filter::closest) {
        taps.count = 1;
        taps.at[0] = wrap_texel(static_cast<int32_t>(std::floor(texel)), size, wrap);
        taps.weight[0] = 1.0f;
        return taps;
    }
    const float low = std::floor(texel - 0.5f), t = texel - 0.5f - low;
    int32_t first = static_cast<int32_t>(low);
    taps.count = filter == Filter::cubic ? 4 : 2;
    if (filter == Filter::cubic) {
        first -= 1;
        set_cubic_weights(t, taps.weight);
    } else {
        taps.weight[0] = 1.0f - t;
        taps.weight[1] = t;
    }
    for (int32_t k = 0; k < taps.count; ++k) taps.at[k] = wrap_texel(first + k, size, wrap);
    return taps;
}

/// Linear value of a number stored in the image's encoding, which lies between 0 and 1.
TRG_FN float decode_value(const float* decode, float encoded) {
    const float at = clamp01(encoded) * static_cast<float>(kDecodeSteps);
    const int32_t step = static_cast<int32_t>(at);
    const float rest = at - static_cast<float>(step);
    return decode[step] + (decode[step + 1] - decode[step]) * rest;
}

/// Linear colour and alpha of an image at (u, v), 0 to 1 from edge to edge; outside a clipped image
/// all is 0.
TRG_FN Texel eval_texels(const ImageView& image, const Texture& how, float u, float v) {
    const Taps x = make_taps(u, image.width, how.wrap, how.filter);
    const Taps y = make_taps(v, image.height, how.wrap, how.filter);
    Texel sum{0.0f, 0.0f, 0.0f, 0.0f};
    for (int32_t row = 0; row < y.count; ++row) {
        if (y.at[row] < 0) continue;
        Texel line{0.0f, 0.0f, 0.0f, 0.0f};
        for (int32_t column = 0; column < x.count; ++column)
            if (x.at[column] >= 0)
                line = line + load_texel(image, x.at[column], y.at[row]) * x.weight[column];
        sum = sum + line * y.weight[row];
    }
    if (how.unassociate && sum.a != 0.0f && sum.a != 1.0f) {
        const float scale = 1.0f / sum.a;
        sum = {sum.r * scale, sum.g * scale, sum.b * scale, sum.a};
    }
    if (image.decode)
        sum = {decode_value(image.decode, sum.r), decode_value(image.decode, sum.g),
               decode_value(image.decode, sum.b), sum.a};
    return sum;
}

/// Linear colour of `image` at (u, v), bilinear, repeated at its edges.
TRG_FN Vec3 eval_image(const ImageView& image, float u, float v) {
    const Texel t = eval_texels(image, Texture{}, u, v);
    return {t.r, t.g, t.b};
}

TRG_FN Vec3 pick_channel(Texel t, Channel channel) {
    if (channel == Channel::color) return {t.r, t.g, t.b};
    const float grey = channel == Channel::alpha ? t.a : luminance({t.r, t.g, t.b});
    return {grey, grey, grey};
}

/// Linear value of an image texture at texture coordinates (u, v).
TRG_FN Vec3 eval_texture(const ImageView* images, const Texture& t, float u, float v) {
    const float x = t.scale_u * u + t.skew_u * v + t.offset_u;
    const float y = t.skew_v * u + t.scale_v * v + t.offset_v;
    return pick_channel(eval_texels(images[t.image], t, x, y), t.channel);
}

}  // namespace trg

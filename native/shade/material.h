/// Materials and textures as kernels see them: plain records and indices.
#pragma once

#include <cstdint>

#include "shade/frame.h"

namespace trg {

/// One row of the material table, ready for use. Textures are indices or -1.
struct Material {
    Vec3 base;
    float metallic, roughness, ior, specular, transmission;
    float mean_fresnel;  // of `ior`, over the hemisphere
    Vec3 emission;
    float emission_weight;  // how much emitter sampling favours it; 0: does not emit
    int32_t base_texture, roughness_texture, metallic_texture, emission_texture;
};

/// Pixels of one image; row 0 is the bottom row. One of `bytes` and `floats` is null.
struct ImageView {
    const uint8_t* bytes;
    const float* floats;          // linear
    const float* byte_to_linear;  // 256 values
    int32_t width, height, channels;
};

enum class Wrap : int32_t { repeat, extend };

/// An image looked up at uv * scale + offset.
struct Texture {
    int32_t image;
    float scale_u, scale_v, offset_u, offset_v;
    Wrap wrap;
};

struct TextureSet {
    const ImageView* images;
    const Texture* textures;
};

TRG_FN int32_t wrap_texel(int32_t i, int32_t size, Wrap wrap) {
    if (wrap == Wrap::extend) return i < 0 ? 0 : (i >= size ? size - 1 : i);
    return i < 0 ? i + size : (i >= size ? i - size : i);
}

TRG_FN Vec3 eval_texel(const ImageView& image, int32_t x, int32_t y) {
    const int64_t at = (static_cast<int64_t>(y) * image.width + x) * image.channels;
    const int second = image.channels > 1 ? 1 : 0, third = image.channels > 1 ? 2 : 0;
    if (image.bytes) {
        const uint8_t* texel = image.bytes + at;
        const float* linear = image.byte_to_linear;
        return {linear[texel[0]], linear[texel[second]], linear[texel[third]]};
    }
    const float* texel = image.floats + at;
    return {texel[0], texel[second], texel[third]};
}

/// A texel coordinate, brought near [0, size) so that it can be an integer; 0 when not finite.
TRG_FN float place_texel(float position, int32_t size, Wrap wrap) {
    if (!std::isfinite(position)) return 0.0f;
    if (wrap == Wrap::repeat) position -= std::floor(position);
    const float texel = position * static_cast<float>(size) - 0.5f;
    return smaller(larger(texel, -1.0f), static_cast<float>(size));
}

/// Linear colour of `texture` at (u, v), bilinear between the centres of texels.
TRG_FN Vec3 eval_texture(const TextureSet& set, const Texture& texture, float u, float v) {
    const ImageView& image = set.images[texture.image];
    const float x = place_texel(u * texture.scale_u + texture.offset_u, image.width, texture.wrap);
    const float y = place_texel(v * texture.scale_v + texture.offset_v, image.height, texture.wrap);
    const float x_floor = std::floor(x), y_floor = std::floor(y);
    const float fx = x - x_floor, fy = y - y_floor;
    const int32_t ix = static_cast<int32_t>(x_floor), iy = static_cast<int32_t>(y_floor);
    const int32_t x0 = wrap_texel(ix, image.width, texture.wrap);
    const int32_t x1 = wrap_texel(ix + 1, image.width, texture.wrap);
    const int32_t y0 = wrap_texel(iy, image.height, texture.wrap);
    const int32_t y1 = wrap_texel(iy + 1, image.height, texture.wrap);
    const Vec3 low = eval_texel(image, x0, y0) * (1.0f - fx) + eval_texel(image, x1, y0) * fx;
    const Vec3 high = eval_texel(image, x0, y1) * (1.0f - fx) + eval_texel(image, x1, y1) * fx;
    return low * (1.0f - fy) + high * fy;
}

}  // namespace trg

/// Methods of trg_native.Scene that take images, textures, their programs and what those read.
#pragma once

#include <string>

#include "py/buffer.h"
#include "scene/scene.h"

namespace trg::py {

extern PyMethodDef kSceneTextureMethods[];

constexpr int64_t kLargestImageSide = 1 << 20;

/// Copies (h, w, 1 | 3 | 4) pixels and notes their size in `image`. Throws ArgumentError.
template <class Item>
void copy_pixels(PyObject* object, Image* image, std::vector<Item>* pixels) {
    const Buffer buffer = Buffer::of<Item>(object, "pixels", {kAnyExtent, kAnyExtent, kAnyExtent});
    for (int k = 0; k < 2; ++k)
        if (buffer.extent(k) < 1 || buffer.extent(k) > kLargestImageSide)
            throw ArgumentError("pixels: expected sides from 1 to " +
                                std::to_string(kLargestImageSide));
    const int64_t channels = buffer.extent(2);
    if (channels != 1 && channels != 3 && channels != 4)
        throw ArgumentError("pixels: expected 1, 3 or 4 channels, got " + std::to_string(channels));
    image->height = static_cast<int32_t>(buffer.extent(0));
    image->width = static_cast<int32_t>(buffer.extent(1));
    image->channels = static_cast<int32_t>(channels);
    pixels->assign(buffer.data<Item>(), buffer.data<Item>() + buffer.count());
}

}  // namespace trg::py

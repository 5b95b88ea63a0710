"""Blender images -> ImageArrays in their own size, as Cycles takes them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..scene_arrays import Float32, ImageArrays

MISSING_COLOR = (255, 0, 255, 255)
"""What Cycles shows for an image that cannot be read."""
SRGB_SPACES = ("sRGB",)
LINEAR_SPACES = ("Non-Color", "Linear", "Linear Rec.709", "Raw", "Generic Data")


@dataclass(slots=True)
class KnownImages:
    """Images as they were read before; only those are kept that change by a word of Blender's alone."""

    _images: dict[tuple[object, ...], ImageArrays] = field(default_factory=dict)

    def find(self, image: bpy.types.Image | None) -> ImageArrays | None:
        return None if image is None or image.is_dirty else self._images.get(_identity(image))

    def keep(self, image: bpy.types.Image | None, arrays: ImageArrays) -> None:
        if image is not None and image.source == "FILE" and not image.is_dirty:
            self._images[_identity(image)] = arrays

    def forget(self, name: str) -> None:
        """Of every image of that name."""
        self._images = {key: value for key, value in self._images.items() if key[0] != name}

    def clear(self) -> None:
        self._images.clear()


def _identity(image: bpy.types.Image) -> tuple[object, ...]:
    """What tells the pixels of an image from others without looking at them."""
    space = image.colorspace_settings.name
    return (image.name, image.filepath, tuple(image.size), image.channels, image.alpha_mode, space)


@dataclass(slots=True)
class ImagePool:
    """Images met so far, each read once."""

    warnings: list[str]
    images: list[ImageArrays] = field(default_factory=list)
    known: KnownImages | None = None
    """of the scene as it was read before"""
    _rows: dict[int, int] = field(default_factory=dict)

    def row(self, image: bpy.types.Image | None, where: str) -> int:
        """Row of `image`; a row of pink, and one warning, when it has no pixels."""
        key = image.as_pointer() if image is not None else 0
        if key not in self._rows:
            found = None if self.known is None else self.known.find(image)
            if found is None:
                found = read_image(image, where, self.warnings)
                if self.known is not None:
                    self.known.keep(image, found)
            self.images.append(found)
            self._rows[key] = len(self.images) - 1
        return self._rows[key]


def multiplies_alpha(image: bpy.types.Image | None) -> bool:
    """Whether Cycles keeps the colour of `image` multiplied by its alpha."""
    if image is None or image.channels != 4 or image.alpha_mode in ("CHANNEL_PACKED", "NONE"):
        return False
    return not image.colorspace_settings.is_data


def read_image(image: bpy.types.Image | None, where: str, warnings: list[str]) -> ImageArrays:
    """Pixels as stored: u8 for 8-bit images, else float16 where that loses nothing, or float32."""
    if image is None or not image.size[0] or not image.size[1] or not image.channels:
        name = "no image" if image is None else f"image {image.name!r} ({image.filepath}) has no pixels"
        warnings.append(f"{where}: {name}; shown in magenta")
        return ImageArrays(np.array(MISSING_COLOR, np.uint8).reshape(1, 1, 4), srgb=False, origin=where)
    width, height = image.size
    flat = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(flat)
    pixels = flat.reshape(height, width, image.channels)
    if image.channels == 2:
        pixels = np.ascontiguousarray(pixels[:, :, :1])
    if image.alpha_mode == "NONE" and image.channels == 4:
        pixels = np.ascontiguousarray(pixels[:, :, :3])
    if image.is_float:
        return ImageArrays(_as_floats(image, pixels, warnings), srgb=False, origin=image.name)
    return ImageArrays(_as_bytes(image, pixels), _is_srgb(image, where, warnings), image.name)


def _as_floats(image: bpy.types.Image, pixels: Float32, warnings: list[str]) -> NDArray[np.float16] | Float32:
    """Finite pixels, as halves where all of them are halves."""
    broken = ~np.isfinite(pixels)
    if broken.any():
        count = int(broken.any(axis=2).sum())
        warnings.append(f"image {image.name!r}: {count} pixels are not finite and become 0")
        pixels[broken] = 0.0
    if bpy.app.version >= (5, 0, 0) and image.alpha_mode == "STRAIGHT" and multiplies_alpha(image):
        pixels[..., :3] *= pixels[..., 3:]
    if np.abs(pixels).max(initial=0.0) > 65504.0:
        return pixels
    halves = pixels.astype(np.float16)
    return halves if np.array_equal(halves.astype(np.float32), pixels) else pixels


def _as_bytes(image: bpy.types.Image, pixels: Float32) -> NDArray[np.uint8]:
    np.multiply(pixels, 255.0, out=pixels)
    np.rint(pixels, out=pixels)
    values: NDArray[Any] = pixels.astype(np.uint8)
    if multiplies_alpha(image) and (values[..., 3] < 255).any():
        alpha = values[..., 3:].astype(np.uint16)
        values[..., :3] = (values[..., :3].astype(np.uint16) * alpha // 255).astype(np.uint8)
    return values


def _is_srgb(image: bpy.types.Image, where: str, warnings: list[str]) -> bool:
    space = image.colorspace_settings.name
    if space in SRGB_SPACES or space in LINEAR_SPACES:
        return space in SRGB_SPACES
    warnings.append(f"{where}: colour space {space!r} of image {image.name!r} is read as sRGB")
    return True

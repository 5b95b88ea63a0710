"""Pictures of textures as images of Blender: the group's formats, embedded ones, and what Blender reads."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import bpy
import numpy as np
from numpy.typing import NDArray

from ...lang.scene import MaterialRecord, TextureRecord
from ..formats import IMAGE_SUFFIXES, FormatError, ModelTexture, read_g24
from .errors import SceneError
from .tags import IMAGE

PLACEHOLDER_CHECKS = 8
PLACEHOLDER_CHECK_PIXELS = 8
MAX_SIDE = 16_384
COLOR_SLOTS = ("base_color", "emission")
"""slots whose pictures are colours; the others hold data"""


@dataclass(slots=True)
class ImageStore:
    """The images of one frame. `prepare` makes what is missing; `roll_back` removes what it made."""

    embedded: dict[str, ModelTexture] = field(default_factory=dict)
    """pictures inside model files, by the key of their record"""
    _images: dict[str, bpy.types.Image] = field(default_factory=dict)
    _made: list[bpy.types.Image] = field(default_factory=list)

    def __post_init__(self) -> None:
        own = (image for image in bpy.data.images if IMAGE in image and image.library is None)
        self._images = {image[IMAGE]: image for image in own}

    def prepare(self, texture: TextureRecord, is_color: bool) -> bpy.types.Image:
        """The image of `texture`; `is_color` False marks it as data (no sRGB decoding).

        A texture without a file is a magenta and black check. Raises SceneError for a damaged file.
        """
        key = f"{self.source_key(texture)}|{'color' if is_color else 'data'}"
        image = self._images.get(key)
        if image is None:
            image = self._make(texture, is_color)
            image[IMAGE] = key
            self._images[key] = image
            self._made.append(image)
        return image

    def prepare_all(self, material: MaterialRecord) -> None:
        """Make the images that the material needs. Raises SceneError for a damaged file."""
        for slot, texture in material.textures:
            self.prepare(texture, slot in COLOR_SLOTS)

    def roll_back(self) -> None:
        for image in self._made:
            bpy.data.images.remove(image)
        self._made.clear()

    def source_key(self, texture: TextureRecord) -> str:
        """Names the picture behind a texture; changes when its file does."""
        if texture.path in self.embedded:
            return str(texture.path)
        if texture.path is None:
            return "missing"
        try:
            status = Path(texture.path).stat()
        except OSError:
            return "missing"
        return f"{texture.path}:{status.st_mtime_ns}:{status.st_size}"

    def _make(self, texture: TextureRecord, is_color: bool) -> bpy.types.Image:
        picture = self.embedded.get(texture.path) if texture.path is not None else None
        name = Path(texture.file.replace("\\", "/")).name or "texture"
        if picture is not None:
            return _image_of_pixels(name, picture.pixels, is_color)
        if texture.path is None or not Path(texture.path).is_file():
            return _image_of_pixels(f"missing {name}", placeholder_pixels(), is_color)
        if Path(texture.path).suffix.lower() in IMAGE_SUFFIXES:
            try:
                return _image_of_pixels(name, read_g24(texture.path), is_color)
            except (FormatError, OSError) as error:
                message = f"the texture cannot be read: {error}"
                raise SceneError(message, texture.origin, texture.key) from error
        return _load_by_blender(texture, is_color)


def placeholder_pixels() -> NDArray[np.uint8]:
    """Magenta and black checks, uint8 (64, 64, 3)."""
    side = PLACEHOLDER_CHECKS * PLACEHOLDER_CHECK_PIXELS
    cells = np.arange(side) // PLACEHOLDER_CHECK_PIXELS
    is_magenta = (cells[:, None] + cells[None, :]) % 2 == 0
    return np.where(is_magenta[..., None], np.uint8([255, 0, 255]), np.uint8([0, 0, 0]))


def _image_of_pixels(name: str, pixels: NDArray[np.uint8], is_color: bool) -> bpy.types.Image:
    """A packed 8-bit image of pixels (h, w, 1, 3 or 4), row 0 the bottom row."""
    height, width, channels = pixels.shape
    image = bpy.data.images.new(name, width, height, alpha=channels == 4, is_data=not is_color)
    rgba = np.ones((height, width, 4), dtype=np.float32)
    rgba[..., : min(channels, 3) if channels != 1 else 3] = pixels[..., :3] / np.float32(255.0)
    if channels == 4:
        rgba[..., 3] = pixels[..., 3] / np.float32(255.0)
    # Another colour space throws the pixels away: it comes first.
    _set_color_space(image, is_color)
    image.pixels.foreach_set(rgba.reshape(-1))
    image.update()
    image.pack()
    return image


def _load_by_blender(texture: TextureRecord, is_color: bool) -> bpy.types.Image:
    try:
        image = bpy.data.images.load(str(texture.path), check_existing=False)
    except RuntimeError as error:
        raise SceneError(f"the texture cannot be read: {error}", texture.origin, texture.key) from error
    width, height = image.size
    if not 0 < width <= MAX_SIDE or not 0 < height <= MAX_SIDE:
        bpy.data.images.remove(image)
        message = f"{texture.path}: not a picture that Blender reads, or more than {MAX_SIDE} pixels a side"
        raise SceneError(message, texture.origin, texture.key)
    if not is_color:
        _set_color_space(image, is_color)
    return image


def _set_color_space(image: bpy.types.Image, is_color: bool) -> None:
    image.colorspace_settings.name = "sRGB" if is_color else "Non-Color"

"""Image Texture nodes (with Mapping and UV Map) -> Texture rows and ImageArrays."""

from __future__ import annotations

from dataclasses import dataclass, field

import bpy
import numpy as np

from ..scene_arrays import WRAP_MODES, ImageArrays, Texture
from .sockets import describe, feeding_socket, input_socket

MISSING_COLOR = (255, 0, 255, 255)
"""What Cycles shows for an image that cannot be read."""

SRGB_SPACES = ("sRGB",)
LINEAR_SPACES = ("Non-Color", "Linear", "Linear Rec.709", "Raw", "Generic Data")
WRAP_OF_EXTENSION = {"REPEAT": "repeat", "EXTEND": "extend"}


@dataclass(slots=True)
class TextureTable:
    """Textures and images met so far; equal look-ups share a row, equal images share their pixels."""

    warnings: list[str]
    textures: list[Texture] = field(default_factory=list)
    images: list[ImageArrays] = field(default_factory=list)
    _image_rows: dict[int, int] = field(default_factory=dict)

    def add(self, node: bpy.types.Node, owner: str) -> tuple[int, str]:
        """Row of the Image Texture `node`, and the name of the UV map that it asks for ("": the default)."""
        placement, uv_map = _placement(node, owner, self.warnings)
        row = Texture(self._image_row(node, owner), *placement, _wrap_mode(node, owner, self.warnings))
        if row in self.textures:
            return self.textures.index(row), uv_map
        self.textures.append(row)
        return len(self.textures) - 1, uv_map

    def _image_row(self, node: bpy.types.Node, owner: str) -> int:
        image = node.image
        key = image.as_pointer() if image is not None else 0
        if key not in self._image_rows:
            self.images.append(_read_image(image, describe(owner, node), self.warnings))
            self._image_rows[key] = len(self.images) - 1
        return self._image_rows[key]


def _read_image(image: bpy.types.Image | None, where: str, warnings: list[str]) -> ImageArrays:
    """Pixels as stored: u8 for 8-bit images, float32 for the rest; magenta when there are none."""
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
    if image.is_float:
        return ImageArrays(pixels, srgb=False, origin=image.name)
    np.multiply(pixels, 255.0, out=pixels)
    np.rint(pixels, out=pixels)
    return ImageArrays(pixels.astype(np.uint8), srgb=_is_srgb(image, where, warnings), origin=image.name)


def _is_srgb(image: bpy.types.Image, where: str, warnings: list[str]) -> bool:
    space = image.colorspace_settings.name
    if space in SRGB_SPACES or space in LINEAR_SPACES:
        return space in SRGB_SPACES
    warnings.append(f"{where}: colour space {space!r} of image {image.name!r} is read as sRGB")
    return True


def _wrap_mode(node: bpy.types.Node, owner: str, warnings: list[str]) -> int:
    wrap = WRAP_OF_EXTENSION.get(node.extension)
    if wrap is None:
        warnings.append(f"{describe(owner, node)}: extension {node.extension} is rendered as extend")
        wrap = "extend"
    if node.projection != "FLAT":
        warnings.append(f"{describe(owner, node)}: projection {node.projection} is rendered as flat")
    if node.image is not None and node.image.source == "TILED":
        warnings.append(f"{describe(owner, node)}: only the first tile of the image is used")
    return WRAP_MODES.index(wrap)


def _placement(
    node: bpy.types.Node, owner: str, warnings: list[str]
) -> tuple[tuple[float, float, float, float], str]:
    """(scale u, scale v, offset u, offset v) and UV map behind the Vector input."""
    scale, offset = [1.0, 1.0], [0.0, 0.0]
    socket = input_socket(node, "Vector")
    source = feeding_socket(socket) if socket else None
    if source is not None and source.node.type == "MAPPING":
        scale, offset = _mapping(source.node, owner, warnings)
        source = feeding_socket(source.node.inputs["Vector"])
    return (*scale, *offset), _uv_map(source, owner, warnings)


def _mapping(node: bpy.types.Node, owner: str, warnings: list[str]) -> tuple[list[float], list[float]]:
    """Scale and offset of a Mapping node; anything it does besides is warned about."""
    values = {}
    for name in ("Location", "Rotation", "Scale"):
        socket = input_socket(node, name)
        values[name] = [float(x) for x in socket.default_value] if socket else [float(name == "Scale")] * 3
        if socket is not None and feeding_socket(socket) is not None:
            warnings.append(f"{describe(owner, node)}: a link into {name} is not supported")
    if any(abs(angle) > 1e-6 for angle in values["Rotation"]):
        warnings.append(f"{describe(owner, node)}: rotation is not supported")
    location, scale = values["Location"][:2], values["Scale"][:2]
    if node.vector_type == "POINT":
        return scale, location
    if node.vector_type == "VECTOR":
        return scale, [0.0, 0.0]
    if node.vector_type == "TEXTURE":
        safe = [s if s else 1.0 for s in scale]
        return [1.0 / s for s in safe], [-x / s for x, s in zip(location, safe, strict=True)]
    warnings.append(f"{describe(owner, node)}: vector type {node.vector_type} is not supported")
    return [1.0, 1.0], [0.0, 0.0]


def _uv_map(source: bpy.types.NodeSocket | None, owner: str, warnings: list[str]) -> str:
    if source is None:
        return ""
    if source.node.type == "UVMAP":
        return str(source.node.uv_map)
    if source.node.type == "TEX_COORD" and source.name == "UV":
        return ""
    warnings.append(f"{describe(owner, source.node)}: output {source.name!r} is read as the UV map")
    return ""

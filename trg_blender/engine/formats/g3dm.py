"""Models of the CGSG group, `.g3dm`: little-endian, no padding, primitives, materials, textures.

Layout: header `G3DM` and three counts; a primitive is NV, NI, MtlNo, NV vertices of 48 bytes and NI
indices; a material has 680 bytes; a texture has a name, W, H, C and W*H*C bytes, bottom row first.
Nothing follows the last texture.
"""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

from .byte_reader import ByteReader, pack_name
from .model import Color, Model, ModelMaterial, ModelTexture, Primitive
from .pixels import RGB_FROM_BGR, check_pixels, swap_red_blue
from .vertex_block import BlockHead, pack_block, parse_block

SIGNATURE = b"G3DM"
PRIMITIVE_HEAD_BYTES = 12
MATERIAL_BYTES = 680
TEXTURE_HEAD_BYTES = 312
NAME_BYTES = 300
SHADER_UNSET = 0xFFFFFFFF


def read_g3dm(path: str | Path) -> Model:
    """The model in `path`. Raises FormatError for a damaged file, OSError for an unreadable one."""
    return parse_g3dm(Path(path).read_bytes(), str(path))


def write_g3dm(path: str | Path, model: Model) -> None:
    """Writes `model`; ValueError when its parts do not fit together."""
    Path(path).write_bytes(pack_g3dm(model))


def parse_g3dm(data: bytes, file: str) -> Model:
    """The model in `data`; `file` names it in a FormatError. Memory stays in proportion to len(data)."""
    reader = ByteReader(data, file)
    if reader.read_bytes(4, "signature") != SIGNATURE:
        raise reader.fail("the signature 'G3DM'", 0)
    primitive_count, material_count, texture_count = reader.read_u32s(3, "header")
    reader.require(
        PRIMITIVE_HEAD_BYTES * primitive_count
        + MATERIAL_BYTES * material_count
        + TEXTURE_HEAD_BYTES * texture_count,
        f"{primitive_count} primitives, {material_count} materials and {texture_count} textures",
    )
    primitives = []
    warnings: list[str] = []
    for index in range(primitive_count):
        primitive, notes = _parse_primitive(reader, index, material_count)
        primitives.append(primitive)
        warnings.extend(notes)
    materials = tuple(_parse_material(reader, index, texture_count) for index in range(material_count))
    textures = tuple(_parse_texture(reader, index) for index in range(texture_count))
    reader.expect_end()
    return Model(tuple(primitives), materials, textures, warnings=tuple(warnings))


def _parse_primitive(
    reader: ByteReader, index: int, material_count: int
) -> tuple[Primitive, tuple[str, ...]]:
    vertex_count, index_count, material = (
        int(value) for value in reader.read_struct("IIi", f"the head of primitive {index}")
    )
    known = material if 0 <= material < material_count else -1
    return parse_block(reader, BlockHead(f"primitive {index}", vertex_count, index_count, known))


def _parse_material(reader: ByteReader, index: int, texture_count: int) -> ModelMaterial:
    title = f"material {index}"
    reader.require(MATERIAL_BYTES, title)
    name = reader.read_name(NAME_BYTES, title)
    start = reader.offset
    numbers = reader.read_floats(11, title)
    if not np.isfinite(numbers).all():
        first = int(np.flatnonzero(~np.isfinite(numbers))[0])
        raise reader.fail(f"finite numbers in {title}", start + 4 * first)
    slots = reader.read_int32s(8, title)
    shader = reader.read_name(NAME_BYTES, title)
    reader.read_u32s(1, title)
    return ModelMaterial(
        name=name,
        ambient=_color(numbers[0:3]),
        diffuse=_color(numbers[3:6]),
        specular=_color(numbers[6:9]),
        phong_power=float(numbers[9]),
        opacity=float(numbers[10]),
        textures=tuple(int(slot) if 0 <= slot < texture_count else -1 for slot in slots),
        shader=shader,
    )


def _color(numbers: np.ndarray) -> Color:
    return float(numbers[0]), float(numbers[1]), float(numbers[2])


def _parse_texture(reader: ByteReader, index: int) -> ModelTexture:
    title = f"texture {index}"
    reader.require(TEXTURE_HEAD_BYTES, f"the head of {title}")
    name = reader.read_name(NAME_BYTES, title)
    size_offset = reader.offset
    width, height, channels = reader.read_u32s(3, title)
    if channels not in RGB_FROM_BGR:
        raise reader.fail(f"1, 3 or 4 bytes a pixel in {title}, found {channels}", size_offset + 8)
    if not width or not height:
        raise reader.fail(f"a size of at least 1 x 1 of {title}, found {width} x {height}", size_offset)
    raw = reader.read_pixels(width * height * channels, f"{width} x {height} pixels of {title}")
    return ModelTexture(name, swap_red_blue(raw.reshape(height, width, channels)))


def pack_g3dm(model: Model) -> bytes:
    """The file's bytes; parse_g3dm gives an equal model back. ValueError when parts do not fit together."""
    counts = len(model.primitives), len(model.materials), len(model.textures)
    parts = [SIGNATURE, struct.pack("<3I", *counts)]
    for primitive in model.primitives:
        head = len(primitive.vertices), 3 * len(primitive.triangles), primitive.material
        parts += [struct.pack("<IIi", *head), pack_block(primitive)]
    parts += [_pack_material(material) for material in model.materials]
    parts += [_pack_texture(texture) for texture in model.textures]
    return b"".join(parts)


def _pack_material(material: ModelMaterial) -> bytes:
    numbers = (*material.ambient, *material.diffuse, *material.specular)
    return b"".join(
        (
            pack_name(material.name, NAME_BYTES),
            struct.pack("<11f", *numbers, material.phong_power, material.opacity),
            struct.pack("<8i", *material.textures),
            pack_name(material.shader, NAME_BYTES),
            struct.pack("<I", SHADER_UNSET),
        )
    )


def _pack_texture(texture: ModelTexture) -> bytes:
    check_pixels(texture.pixels)
    height, width, channels = texture.pixels.shape
    head = pack_name(texture.name, NAME_BYTES) + struct.pack("<3I", width, height, channels)
    return head + swap_red_blue(texture.pixels).tobytes()

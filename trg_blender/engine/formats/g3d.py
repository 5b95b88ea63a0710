"""The older models of the CGSG group, `.g3d`: primitives that name a material of an external library.

Layout: `G3D` NUL, number of primitives, library file name (300 bytes); a primitive is NV, NI, material
name (300 bytes), NV vertices of 48 bytes and NI indices. The library is a text file of its own and is not
read here: its materials arrive with their names and default values.
"""

from __future__ import annotations

import struct
from pathlib import Path

from .byte_reader import ByteReader, pack_name
from .model import Model, ModelMaterial
from .vertex_block import BlockHead, pack_block, parse_block

SIGNATURE = b"G3D\0"
NAME_BYTES = 300
PRIMITIVE_HEAD_BYTES = 8 + NAME_BYTES


def read_g3d(path: str | Path) -> Model:
    """The model in `path`. Raises FormatError for a damaged file, OSError for an unreadable one."""
    return parse_g3d(Path(path).read_bytes(), str(path))


def write_g3d(path: str | Path, model: Model) -> None:
    """Writes `model` without material values and textures, which the format cannot hold."""
    Path(path).write_bytes(pack_g3d(model))


def parse_g3d(data: bytes, file: str) -> Model:
    """The model in `data`; `file` names it in a FormatError. Memory stays in proportion to len(data)."""
    reader = ByteReader(data, file)
    if reader.read_bytes(4, "signature") != SIGNATURE:
        raise reader.fail("the signature 'G3D' and a zero byte", 0)
    (count,) = reader.read_u32s(1, "header")
    library = reader.read_name(NAME_BYTES, "the library's name")
    reader.require(PRIMITIVE_HEAD_BYTES * count, f"{count} primitives")
    numbers: dict[str, int] = {}
    primitives = []
    warnings: list[str] = []
    for index in range(count):
        title = f"primitive {index}"
        vertex_count, index_count = reader.read_u32s(2, f"the head of {title}")
        name = reader.read_name(NAME_BYTES, f"the material name of {title}")
        material = numbers.setdefault(name, len(numbers)) if name else -1
        primitive, notes = parse_block(reader, BlockHead(title, vertex_count, index_count, material))
        primitives.append(primitive)
        warnings.extend(notes)
    reader.expect_end()
    materials = tuple(ModelMaterial(name) for name in numbers)
    return Model(tuple(primitives), materials, library=library, warnings=tuple(warnings))


def pack_g3d(model: Model) -> bytes:
    """The file's bytes; ValueError when parts do not fit together."""
    parts = [SIGNATURE, struct.pack("<I", len(model.primitives)), pack_name(model.library, NAME_BYTES)]
    for primitive in model.primitives:
        name = model.materials[primitive.material].name if primitive.material >= 0 else ""
        parts.append(struct.pack("<II", len(primitive.vertices), 3 * len(primitive.triangles)))
        parts += [pack_name(name, NAME_BYTES), pack_block(primitive)]
    return b"".join(parts)

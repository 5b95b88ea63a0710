"""The vertices and indices that .g3dm and .g3d share: 48-byte vertices P, T, N, C and int32 indices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .byte_reader import ByteReader
from .model import Primitive, repair_normals

VERTEX_FLOATS = 12
VERTEX_BYTES = 4 * VERTEX_FLOATS


@dataclass(frozen=True, slots=True)
class BlockHead:
    """What stands before a block."""

    title: str
    """for messages, such as 'primitive 2'"""
    vertex_count: int
    index_count: int
    material: int


def parse_block(reader: ByteReader, head: BlockHead) -> tuple[Primitive, tuple[str, ...]]:
    """The primitive at the cursor and what had to be mended in it.

    Raises FormatError for counts past the end of the file, a part of a triangle, a position that is not
    finite, an index out of range. Bad normals are replaced, bad texture coordinates become 0, colours 1.
    """
    if head.index_count % 3:
        raise reader.fail(f"a multiple of 3 indices in {head.title}, {head.index_count} are announced")
    reader.require(
        VERTEX_BYTES * head.vertex_count + 4 * head.index_count,
        f"{head.vertex_count} vertices and {head.index_count} indices in {head.title}",
    )
    start = reader.offset
    floats = reader.read_floats(VERTEX_FLOATS * head.vertex_count, "vertices")
    floats = floats.reshape(-1, VERTEX_FLOATS)
    bad = np.flatnonzero(~np.isfinite(floats[:, :3]).all(axis=1))
    if bad.size:
        offset = start + VERTEX_BYTES * int(bad[0])
        raise reader.fail(f"a finite position of vertex {bad[0]} in {head.title}", offset)
    triangles = _parse_indices(reader, head)
    normals, replaced = repair_normals(floats[:, 5:8], floats[:, :3], triangles)
    uvs_colors = np.isfinite(floats[:, 3:5]), np.isfinite(floats[:, 8:12])
    primitive = Primitive(
        vertices=np.ascontiguousarray(floats[:, 0:3]),
        uvs=np.where(uvs_colors[0], floats[:, 3:5], np.float32(0)),
        normals=normals,
        colors=np.where(uvs_colors[1], floats[:, 8:12], np.float32(1)),
        triangles=triangles,
        material=head.material,
    )
    return primitive, _describe_repairs(head.title, replaced, *uvs_colors)


def _parse_indices(reader: ByteReader, head: BlockHead) -> np.ndarray:
    start = reader.offset
    indices = reader.read_int32s(head.index_count, "indices")
    bad = np.flatnonzero((indices < 0) | (indices >= head.vertex_count))
    if bad.size:
        raise reader.fail(
            f"an index below {head.vertex_count} in {head.title}, found {indices[bad[0]]}",
            start + 4 * int(bad[0]),
        )
    return indices.reshape(-1, 3)


def _describe_repairs(title: str, replaced: int, uvs: np.ndarray, colors: np.ndarray) -> tuple[str, ...]:
    notes = []
    if replaced:
        notes.append(f"{title}: {replaced} zero or non-finite normals replaced by face normals")
    if not uvs.all():
        notes.append(f"{title}: {(~uvs.all(axis=1)).sum()} non-finite texture coordinates set to 0")
    if not colors.all():
        notes.append(f"{title}: {(~colors.all(axis=1)).sum()} non-finite vertex colours set to 1")
    return tuple(notes)


def pack_block(primitive: Primitive) -> bytes:
    """Vertices and indices of `primitive`; ValueError when its arrays do not fit together."""
    count = len(primitive.vertices)
    used = np.asarray(primitive.triangles)
    if used.size and not 0 <= np.min(used) <= np.max(used) < count:
        raise ValueError("a triangle names a vertex that is not there")
    columns = (primitive.vertices, primitive.uvs, primitive.normals, primitive.colors)
    vertices: np.ndarray = np.concatenate([np.asarray(column, dtype="<f4") for column in columns], axis=1)
    if vertices.shape != (count, VERTEX_FLOATS):
        raise ValueError(f"vertex columns 3, 2, 3 and 4 wide are needed, got {vertices.shape}")
    indices: np.ndarray = np.asarray(primitive.triangles, dtype="<i4")
    return bytes(vertices.tobytes()) + bytes(indices.tobytes())

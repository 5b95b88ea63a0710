"""A polygon mesh as arrays, in TRG's space, before it becomes one of Blender's."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class MeshData:
    """Polygons over shared vertices: `corners[starts[f]:starts[f + 1]]` are the vertices of face f."""

    vertices: NDArray[np.float64]
    """(n, 3)"""
    corners: NDArray[np.int32]
    """(c,) vertex of each corner, counter-clockwise seen from outside"""
    starts: NDArray[np.int32]
    """(f,) first corner of each face"""
    uvs: NDArray[np.float32] | None = None
    """(c, 2)"""
    flat_faces: NDArray[np.bool_] | None = None
    """(f,) True where a face is shaded flat; None is smooth everywhere"""
    normals: NDArray[np.float32] | None = None
    """(c, 3) corner normals that overrule the shading computed from faces"""
    slots: NDArray[np.int32] | None = None
    """(f,) material slot of each face; None is slot 0"""

    @property
    def face_sizes(self) -> NDArray[np.int32]:
        """(f,) corners of each face."""
        return np.diff(np.append(self.starts, np.int32(len(self.corners))))

    @property
    def slot_count(self) -> int:
        return 1 if self.slots is None or not len(self.slots) else int(self.slots.max()) + 1


def mesh_of_faces(
    vertices: Float64, faces: list[list[int]], uvs: list[tuple[float, float]] | None = None
) -> MeshData:
    """Mesh of faces given as vertex lists; `uvs` has one pair a corner, in the order of the faces."""
    sizes = [len(face) for face in faces]
    starts = np.concatenate(([0], np.cumsum(sizes)[:-1])).astype(np.int32)
    corners = np.array([vertex for face in faces for vertex in face], dtype=np.int32)
    corner_uvs = None if uvs is None else np.array(uvs, dtype=np.float32).reshape(-1, 2)
    return MeshData(np.asarray(vertices, dtype=np.float64), corners, starts, corner_uvs)


def mesh_of_triangles(vertices: Float64, triangles: NDArray[np.int32]) -> MeshData:
    """Mesh of vertex triples (m, 3)."""
    starts = np.arange(0, 3 * len(triangles), 3, dtype=np.int32)
    return MeshData(np.asarray(vertices, dtype=np.float64), triangles.reshape(-1).astype(np.int32), starts)


def shaded_flat(mesh: MeshData) -> MeshData:
    return replace(mesh, flat_faces=np.ones(len(mesh.starts), dtype=bool))


def transformed(mesh: MeshData, linear: Float64) -> MeshData:
    """The mesh with `linear` (3, 3) applied to it. A mirroring one turns the faces, so that they still
    face outwards; a singular one keeps no corner normals."""
    vertices = mesh.vertices @ linear.T
    determinant = float(np.linalg.det(linear))
    normals = mesh.normals
    if normals is not None:
        normals = None if determinant == 0.0 else _unit(normals @ np.linalg.inv(linear)).astype(np.float32)
    changed = replace(mesh, vertices=vertices, normals=normals)
    return _turned(changed) if determinant < 0.0 else changed


def _turned(mesh: MeshData) -> MeshData:
    """The mesh with the corners of every face in the opposite order."""
    face_of_corner = np.repeat(np.arange(len(mesh.starts)), mesh.face_sizes)
    first = mesh.starts[face_of_corner]
    last = first + mesh.face_sizes[face_of_corner] - 1
    order = first + last - np.arange(len(mesh.corners))
    return replace(
        mesh,
        corners=mesh.corners[order],
        uvs=None if mesh.uvs is None else mesh.uvs[order],
        normals=None if mesh.normals is None else mesh.normals[order],
    )


def _unit(vectors: NDArray) -> NDArray:
    lengths = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(lengths > 0.0, lengths, 1.0)

"""A model as its file stores it: primitives, materials, textures, in the file's own space (Y up)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Float32 = NDArray[np.float32]
Int32 = NDArray[np.int32]
Pixels = NDArray[np.uint8]
Color = tuple[float, float, float]

NO_TEXTURES = (-1,) * 8
UNIT_LENGTH_SLACK = 1e-3
"""Stored normals this close to unit length are kept bit by bit."""


@dataclass(frozen=True, slots=True)
class Primitive:
    """An indexed triangle list with one material."""

    vertices: Float32
    """(n, 3) positions, finite, never rescaled"""
    uvs: Float32
    """(n, 2), finite"""
    normals: Float32
    """(n, 3), unit"""
    colors: Float32
    """(n, 4) RGBA, finite"""
    triangles: Int32
    """(m, 3) indices into the vertices, all in range"""
    material: int = -1
    """index into Model.materials, -1: none"""


@dataclass(frozen=True, slots=True)
class ModelMaterial:
    """A Phong material row."""

    name: str
    ambient: Color = (0.1, 0.1, 0.1)
    diffuse: Color = (0.8, 0.8, 0.8)
    specular: Color = (0.0, 0.0, 0.0)
    phong_power: float = 32.0
    opacity: float = 1.0
    """the file's Trans: 1 is opaque"""
    textures: tuple[int, ...] = NO_TEXTURES
    """eight indices into Model.textures, -1: none"""
    shader: str = ""


@dataclass(frozen=True, slots=True)
class ModelTexture:
    name: str
    pixels: Pixels
    """(h, w, c), c = 1 grey, 3 RGB or 4 RGBA; row 0 is the bottom row"""


@dataclass(frozen=True, slots=True)
class Model:
    primitives: tuple[Primitive, ...]
    materials: tuple[ModelMaterial, ...] = ()
    textures: tuple[ModelTexture, ...] = ()
    library: str = ""
    """file name of an external material library (.g3d, .obj), as written"""
    warnings: tuple[str, ...] = ()
    """what the reader had to mend, one sentence each"""


def repair_normals(normals: Float32, vertices: Float32, triangles: Int32) -> tuple[Float32, int]:
    """Unit normals and how many were replaced.

    A zero or non-finite normal becomes the area-weighted mean of the normals of the vertex's faces
    ((0, 1, 0) without a proper face); a normal of another length is brought to length one.
    """
    repaired = normals.astype(np.float32, copy=True)
    wide = normals.astype(np.float64)
    finite = np.isfinite(wide).all(axis=1)
    lengths = np.linalg.norm(np.where(finite[:, None], wide, 0.0), axis=1)
    broken = lengths < 1e-12
    stretched = ~broken & (np.abs(lengths - 1.0) > UNIT_LENGTH_SLACK)
    repaired[stretched] = (wide[stretched] / lengths[stretched, None]).astype(np.float32)
    if broken.any():
        repaired[broken] = mean_face_normals(vertices, triangles)[broken]
    return repaired, int(broken.sum())


def mean_face_normals(vertices: Float32, triangles: Int32) -> Float32:
    """(n, 3) unit normals: area-weighted mean over each vertex's faces, (0, 1, 0) where there is none."""
    faces = face_normals(vertices, triangles)
    sums = np.zeros((len(vertices), 3))
    for corner in range(3):
        np.add.at(sums, triangles[:, corner], faces)
    return _unit_or_up(sums)


def face_normals(vertices: Float32, triangles: Int32) -> NDArray[np.float64]:
    """(m, 3) cross products of the triangles' edges (twice the area in length), finite."""
    corners = vertices.astype(np.float64)[triangles]
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def _unit_or_up(vectors: NDArray[np.float64]) -> Float32:
    lengths = np.linalg.norm(vectors, axis=1)
    units = np.tile(np.array([0.0, 1.0, 0.0]), (len(vectors), 1))
    proper = (lengths > 0.0) & np.isfinite(lengths)
    units[proper] = vectors[proper] / lengths[proper, None]
    return units.astype(np.float32)

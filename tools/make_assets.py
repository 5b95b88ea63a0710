"""Makes the small files that the examples use, with the project's own writers; always the same bytes.

Usage: python tools/make_assets.py [FOLDER]      default: examples/
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from implicit_surface import (
    Grid,
    Points,
    ellipsoid,
    extract_surface,
    gradient,
    smooth_union,
    tapered_capsule,
)

from trg_blender.engine.formats import Model, ModelMaterial, Primitive, write_g3dm, write_g24

CHESS_SIDE = 128
CHESS_SQUARES = 8
CHESS_DARK = (70, 42, 28)
CHESS_LIGHT = (232, 214, 178)
QUANTUM = 1.0 / 2048.0
"""Stored numbers are multiples of this, so that the last bits of a machine's arithmetic do not matter."""

HEIGHT = 13.0
GRID = Grid(low=(-8.1, -0.83, -5.7), cell=0.6, counts=(39, 24, 19))
FLOOR_ROUNDING = 0.4
ELLIPSOIDS = (
    # centre, radii, seam
    ((0.0, 8.0, 0.0), (6.2, 4.2, 3.7), 0.1),
    ((7.0, 9.6, 0.0), (2.9, 3.2, 2.5), 1.6),
    ((5.9, 9.7, 3.3), (1.7, 2.8, 1.0), 0.8),
    ((5.9, 9.7, -3.3), (1.7, 2.8, 1.0), 0.8),
)
CAPSULES = (
    # from, to, radii at both ends, seam
    ((3.7, 7.0, 1.9), (4.0, -1.0, 2.1), (1.7, 1.35), 0.8),
    ((3.7, 7.0, -1.9), (3.4, -1.0, -2.1), (1.7, 1.35), 0.8),
    ((-3.8, 7.0, 1.9), (-4.4, -1.0, 2.1), (1.9, 1.35), 0.8),
    ((-3.8, 7.0, -1.9), (-3.6, -1.0, -2.1), (1.9, 1.35), 0.8),
    ((8.8, 9.2, 0.0), (10.6, 6.6, 0.0), (1.5, 1.05), 0.9),
    ((10.6, 6.6, 0.0), (10.9, 4.0, 0.0), (1.05, 0.85), 0.3),
    ((10.9, 4.0, 0.0), (11.8, 2.6, 0.0), (0.85, 0.75), 0.3),
    ((11.8, 2.6, 0.0), (13.2, 3.0, 0.0), (0.75, 0.65), 0.3),
    ((8.6, 8.1, 1.3), (10.9, 6.9, 1.9), (0.7, 0.45), 0.5),
    ((8.6, 8.1, -1.3), (10.9, 6.9, -1.9), (0.7, 0.45), 0.5),
    ((-5.8, 9.3, 0.0), (-7.1, 6.2, 0.3), (0.55, 0.45), 0.5),
)


def elephant(points: Points) -> np.ndarray:
    """A standing elephant that looks along +X, cut flat at y = 0."""
    body = np.full(len(points), 1e3)
    for centre, radii, seam in ELLIPSOIDS:
        body = smooth_union(body, ellipsoid(points, np.array(centre), np.array(radii)), seam)
    for start, end, ends, seam in CAPSULES:
        body = smooth_union(body, tapered_capsule(points, np.array([start, end]), ends), seam)
    return -smooth_union(-body, points[:, 1], FLOOR_ROUNDING)


def quantize(values: np.ndarray) -> np.ndarray:
    return np.asarray(np.round(values / QUANTUM) * QUANTUM, dtype=np.float32)


def split_quads(vertices: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """(2 m, 3) triangles; each quad is cut along its shorter diagonal."""
    a, b, c, d = (vertices[quads[:, corner]] for corner in range(4))
    first = ((a - c) ** 2).sum(axis=1) <= ((b - d) ** 2).sum(axis=1)
    halves = np.where(first[:, None], quads[:, [0, 1, 2, 0, 2, 3]], quads[:, [0, 1, 3, 1, 2, 3]])
    return halves.reshape(-1, 3)


def wrap_cylinder(vertices: np.ndarray) -> np.ndarray:
    """(n, 2) texture coordinates: the angle round Y, seam at -X, and the height."""
    angle = np.arctan2(vertices[:, 2].astype(np.float64), vertices[:, 0].astype(np.float64))
    return quantize(np.column_stack([0.5 - angle / (2.0 * np.pi), vertices[:, 1] / HEIGHT]))


def open_seam(uvs: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Source vertex of each vertex, their uvs, and triangles, with the vertices on the seam doubled."""
    across = uvs[triangles, 0]
    wrapped = (across.max(axis=1) - across.min(axis=1) > 0.5)[:, None] & (across < 0.5)
    doubled = np.unique(triangles[wrapped])
    twin = np.arange(len(uvs))
    twin[doubled] = len(uvs) + np.arange(len(doubled))
    source = np.concatenate([np.arange(len(uvs)), doubled])
    spread = np.concatenate([uvs, uvs[doubled] + np.array([1.0, 0.0], dtype=np.float32)])
    return source, spread, np.where(wrapped, twin[triangles], triangles).astype(np.int32)


def build_elephant() -> Model:
    """About 13 units tall, standing on y = 0 like the paper's cow, with smooth normals and uvs."""
    points, quads = extract_surface(elephant, GRID)
    slope = gradient(elephant, points)
    normals = quantize(slope / np.sqrt((slope**2).sum(axis=1))[:, None])
    points[:, 1] -= points[:, 1].min()
    vertices = quantize(points * (HEIGHT / points[:, 1].max()))
    source, uvs, triangles = open_seam(wrap_cylinder(vertices), split_quads(vertices, quads))
    primitive = Primitive(
        vertices=vertices[source],
        uvs=uvs,
        normals=normals[source],
        colors=np.ones((len(source), 4), dtype=np.float32),
        triangles=triangles,
        material=0,
    )
    skin = ModelMaterial("elephant", (0.09, 0.09, 0.1), (0.36, 0.37, 0.42), (0.1, 0.1, 0.1), 20.0)
    return Model((primitive,), (skin,))


def build_chess() -> np.ndarray:
    """A chess board (side, side, 3), row 0 at the bottom; a1, bottom left, is dark."""
    square = np.arange(CHESS_SIDE) * CHESS_SQUARES // CHESS_SIDE
    light = (square[:, None] + square[None, :]) % 2 == 1
    return np.where(light[:, :, None], CHESS_LIGHT, CHESS_DARK).astype(np.uint8)


def make_assets(folder: Path) -> None:
    """Writes every asset below `folder`."""
    (folder / "models").mkdir(parents=True, exist_ok=True)
    write_g24(folder / "chess.g24", build_chess())
    write_g3dm(folder / "models" / "elephant.g3dm", build_elephant())


if __name__ == "__main__":
    default = Path(__file__).resolve().parent.parent / "examples"
    make_assets(Path(sys.argv[1]) if len(sys.argv) > 1 else default)

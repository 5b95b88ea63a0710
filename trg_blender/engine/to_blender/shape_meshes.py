"""Meshes of TRG's shapes, in TRG's space (Y up), around the origin and of unit size where that is possible.

Faces run counter-clockwise seen from outside. Curved shapes are inscribed in the true surface.
"""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
from numpy.typing import NDArray

from .mesh_data import MeshData, mesh_of_faces, mesh_of_triangles, shaded_flat

Float64 = NDArray[np.float64]

SPHERE_SEGMENTS, SPHERE_RINGS = 64, 32
TORUS_SEGMENTS, TORUS_RINGS = 96, 48
ROUND_SEGMENTS = 64
PLANE_HALF_SIZE = 10_000.0
FENCE_GAP = 0.05
"""Share of a fence's side that stays open between two pieces."""
FENCE_THICKNESS = 0.02
"""Thickness of a piece as a share of the fence's radius, when the pieces are few."""

BOX_CORNERS = np.array(
    [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)], dtype=np.float64
)
BOX_FACES = [[0, 1, 3, 2], [5, 4, 6, 7], [0, 4, 5, 1], [3, 7, 6, 2], [4, 0, 2, 6], [1, 5, 7, 3]]
SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def sphere_mesh() -> MeshData:
    """Unit sphere round the origin, poles on Y; u runs round Y, v from the lower pole to the upper."""
    angles = np.linspace(-pi / 2, pi / 2, SPHERE_RINGS + 1)
    profile = np.stack((np.cos(angles), np.sin(angles)), axis=1)
    profile[[0, -1], 0] = 0.0
    return _revolve(profile, SPHERE_SEGMENTS, closed=False)


def torus_mesh(ratio: float) -> MeshData:
    """Torus round Y with ring radius 1 and tube radius `ratio`."""
    angles = np.linspace(0.0, 2.0 * pi, TORUS_RINGS, endpoint=False)
    profile = np.stack((1.0 + ratio * np.cos(angles), ratio * np.sin(angles)), axis=1)
    return _revolve(profile, TORUS_SEGMENTS, closed=True)


def cylinder_mesh() -> MeshData:
    """Cylinder of radius 1 from y = 0 to y = 1: smooth side, flat caps with a sharp rim."""
    side = _revolve(np.array([[1.0, 0.0], [1.0, 1.0]]), ROUND_SEGMENTS, closed=False)
    lower = list(range(ROUND_SEGMENTS))
    upper = [vertex + ROUND_SEGMENTS for vertex in lower]
    return _with_caps(side, [lower[::-1], upper])


def cone_mesh() -> MeshData:
    """Cone with base radius 1 on y = 0 and its tip at y = 1; the side keeps the true cone's normals."""
    side = _revolve(np.array([[1.0, 0.0], [0.0, 1.0]]), ROUND_SEGMENTS, closed=False)
    mesh = _with_caps(side, [list(range(ROUND_SEGMENTS))[::-1]])
    turns = np.arange(ROUND_SEGMENTS)[:, None] + np.array([0.0, 1.0, 0.5])
    angles = turns.reshape(-1) * (2.0 * pi / ROUND_SEGMENTS)
    slope = np.sqrt(0.5)
    side_normals = np.stack(
        (slope * np.sin(angles), np.full(len(angles), slope), slope * np.cos(angles)), axis=1
    )
    cap_normals = np.tile((0.0, -1.0, 0.0), (ROUND_SEGMENTS, 1))
    return replace(mesh, normals=np.concatenate((side_normals, cap_normals)).astype(np.float32))


def box_mesh(size: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> MeshData:
    """Box of the given size round the origin, flat, each side once over the whole texture."""
    return shaded_flat(mesh_of_faces(BOX_CORNERS * size, BOX_FACES, SQUARE * 6))


def plane_mesh() -> MeshData:
    """The plane y = 0, seen from +Y, as a square of 20 km; u and v are metres along X and -Z."""
    h = PLANE_HALF_SIZE
    vertices = np.array([(-h, 0.0, h), (h, 0.0, h), (h, 0.0, -h), (-h, 0.0, -h)])
    uvs = [(x, -z) for x, _, z in vertices.tolist()]
    return shaded_flat(mesh_of_faces(vertices, [[0, 1, 2, 3]], uvs))


def fence_mesh(radius: float, height: float, count: int) -> MeshData:
    """`count` thin walls in a ring round Y, their centres `radius` away, from -height/2 to height/2.

    Each stands along the ring's tangent and leaves a small gap to the next. The first is on +Z; one or two
    are as wide as pieces of a square.
    """
    thickness = FENCE_THICKNESS * radius / (1.0 + count / 50.0)
    side = 2.0 * (radius - thickness / 2.0) * np.tan(pi / (count if count > 2 else 4))
    width = side * (1.0 - FENCE_GAP)
    piece = BOX_CORNERS * (width, height, thickness) + (0.0, 0.0, radius)
    vertices, faces = [], []
    for index in range(count):
        angle = 2.0 * pi * index / count
        c, s = np.cos(angle), np.sin(angle)
        vertices.append(piece @ np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]).T)
        faces += [[vertex + 8 * index for vertex in face] for face in BOX_FACES]
    return shaded_flat(mesh_of_faces(np.concatenate(vertices), faces, SQUARE * (6 * count)))


def triangle_mesh(p1: Float64, p2: Float64) -> MeshData:
    """Triangle of the origin and two points, seen from the side where it runs counter-clockwise."""
    mesh = mesh_of_triangles(np.array([np.zeros(3), p1, p2]), np.array([[0, 1, 2]], dtype=np.int32))
    uvs = np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)], dtype=np.float32)
    return shaded_flat(replace(mesh, uvs=uvs))


def _revolve(profile: Float64, segments: int, closed: bool) -> MeshData:
    """Surface of revolution of (radius, y) points round Y, smooth, outside on the profile's right.

    A point of radius 0 becomes one vertex. `closed` joins the last point to the first.
    """
    angles = np.arange(segments) * (2.0 * pi / segments)
    vertices, rings = [], []
    for radius, y in profile.tolist():
        first = len(vertices)
        if radius == 0.0:
            vertices.append((0.0, y, 0.0))
            rings.append([first] * segments)
            continue
        vertices += [(radius * np.sin(a), y, radius * np.cos(a)) for a in angles]
        rings.append(list(range(first, first + segments)))
    faces: list[list[int]] = []
    uvs: list[tuple[float, float]] = []
    bands = len(rings) if closed else len(rings) - 1
    for band in range(bands):
        _add_band(
            (rings[band], rings[(band + 1) % len(rings)]), (band / bands, (band + 1) / bands), faces, uvs
        )
    return mesh_of_faces(np.array(vertices), faces, uvs)


def _add_band(
    rings: tuple[list[int], list[int]],
    heights: tuple[float, float],
    faces: list[list[int]],
    uvs: list[tuple[float, float]],
) -> None:
    """Append the faces between a lower and an upper ring; a ring that is one point gives triangles."""
    lower, upper = rings
    low, high = heights
    segments = len(lower)
    for j in range(segments):
        k = (j + 1) % segments
        left, right, middle = j / segments, (j + 1) / segments, (j + 0.5) / segments
        if lower[j] == lower[k]:
            faces.append([lower[j], upper[k], upper[j]])
            uvs += [(middle, low), (right, high), (left, high)]
        elif upper[j] == upper[k]:
            faces.append([lower[j], lower[k], upper[j]])
            uvs += [(left, low), (right, low), (middle, high)]
        else:
            faces.append([lower[j], lower[k], upper[k], upper[j]])
            uvs += [(left, low), (right, low), (right, high), (left, high)]


def _with_caps(side: MeshData, caps: list[list[int]]) -> MeshData:
    """The mesh with flat polygons added; their texture is the unit square over x and z."""
    corners = np.array([vertex for cap in caps for vertex in cap], dtype=np.int32)
    sizes = [len(cap) for cap in caps]
    starts = len(side.corners) + np.concatenate(([0], np.cumsum(sizes)[:-1]))
    flat = np.concatenate((np.zeros(len(side.starts), dtype=bool), np.ones(len(caps), dtype=bool)))
    cap_uvs = 0.5 + 0.5 * side.vertices[corners][:, [0, 2]] * (1.0, -1.0)
    assert side.uvs is not None
    return replace(
        side,
        corners=np.concatenate((side.corners, corners)),
        starts=np.concatenate((side.starts, starts)).astype(np.int32),
        uvs=np.concatenate((side.uvs, cap_uvs)).astype(np.float32),
        flat_faces=flat,
    )

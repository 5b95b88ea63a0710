"""Small scenes as arrays, for tests of renderers."""

from __future__ import annotations

import numpy as np

from trg_blender.engine.scene_arrays import (
    LIGHT_KINDS,
    Camera,
    ImageArrays,
    InstanceArrays,
    Light,
    MeshArrays,
    SceneArrays,
)

IDENTITY = np.eye(4, dtype=np.float32)[None, :3]


def quad(half: float = 1.0, height: float = 0.0, origin: str = "Quad") -> MeshArrays:
    """A square across z that faces +z, with the unit square as uvs."""
    vertices = [[-half, -half, height], [half, -half, height], [half, half, height], [-half, half, height]]
    uvs = np.array([[[0, 0], [1, 0], [1, 1]], [[0, 0], [1, 1], [0, 1]]], dtype=np.float32)
    return MeshArrays(
        np.array(vertices, np.float32), np.array([[0, 1, 2], [0, 2, 3]], np.int32), uvs=uvs, origin=origin
    )


def box(half: float = 0.5, origin: str = "Box") -> MeshArrays:
    """A cube around the origin, facing outwards."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], np.float32) * half
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]
    return MeshArrays(corners, np.array(triangles, np.int32), origin=origin)


def ball(radius: float = 0.5, rings: int = 12, smooth: bool = True) -> MeshArrays:
    """A sphere of latitude and longitude, facing outwards, with uvs."""
    u, v = np.meshgrid(np.linspace(0, 1, 2 * rings + 1), np.linspace(0, 1, rings + 1))
    theta, phi = np.pi * (1.0 - v), 2.0 * np.pi * u
    points = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], -1).reshape(
        -1, 3
    )
    across = 2 * rings + 1
    triangles = []
    for row in range(rings):
        for column in range(2 * rings):
            a, b = row * across + column, row * across + column + 1
            c, d = a + across, b + across
            triangles += [(a, b, d)] if row > 0 else []
            triangles += [(a, d, c)] if row < rings - 1 or row == 0 else []
    index = np.array(triangles, np.int32)
    uvs = np.stack([u, v], -1).reshape(-1, 2)[index].astype(np.float32)
    normals = points[index].astype(np.float32) if smooth else None
    return MeshArrays((radius * points).astype(np.float32), index, normals, uvs, origin="Ball")


def place(
    mesh: int, material: int = 0, at: tuple[float, float, float] = (0, 0, 0), **kwargs
) -> InstanceArrays:
    """One copy of mesh number `mesh`; `linear` (3, 3) turns and scales it."""
    transform = IDENTITY.copy()
    transform[0, :, :3] = kwargs.get("linear", np.eye(3))
    transform[0, :, 3] = at
    return InstanceArrays(
        mesh, transform, np.array([material], np.int32), origin=kwargs.get("origin", "Thing")
    )


def light(kind: str, color: tuple[float, float, float], position=(0, 0, 0), **fields) -> Light:
    """A row of the light table; `direction`, `axis_u`, `axis_v`, `falloff` as triples."""
    row = Light(LIGHT_KINDS.index(kind), *color, *position)
    for name, value in fields.items():
        if name == "falloff":
            row.falloff_constant, row.falloff_linear, row.falloff_quadratic = value
        elif name in ("direction", "axis_u", "axis_v"):
            value = np.asarray(value, dtype=float)
            value = value / np.linalg.norm(value) if name == "direction" else value
            row_names = [f"{name}_{axis}" for axis in "xyz"]
            for row_name, part in zip(row_names, value, strict=True):
                setattr(row, row_name, float(part))
        else:
            setattr(row, name, value)
    return row


def look_at(position, target, half_width: float = 0.4, kind: int = 0) -> Camera:
    """A square camera at `position`; `half_width` on the plane at distance 1, or in metres."""
    position, target = np.asarray(position, float), np.asarray(target, float)
    back = (position - target) / np.linalg.norm(position - target)
    up = np.array([0.0, 0.0, 1.0]) if abs(back[2]) < 0.99 else np.array([0.0, 1.0, 0.0])
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    matrix = np.stack([right, np.cross(back, right), back, position], axis=1)
    return Camera(kind, matrix, (-half_width, half_width, -half_width, half_width))


def checker(size: int = 4, srgb: bool = True) -> ImageArrays:
    """Coloured squares, one a texel."""
    pixels = np.zeros((size, size, 3), np.uint8)
    pixels[..., 0] = 40 + 150 * (np.indices((size, size)).sum(axis=0) % 2)
    pixels[..., 1] = np.linspace(30, 220, size, dtype=np.uint8)[None, :]
    pixels[..., 2] = np.linspace(200, 20, size, dtype=np.uint8)[:, None]
    return ImageArrays(pixels, srgb, "Checker")


def floor_scene(material, *lights: Light, world=(0.0, 0.0, 0.0)) -> SceneArrays:
    """A square of 8 m across z = 0, seen from 3 m above its middle."""
    return SceneArrays(
        look_at((0, 0, 3), (0, 0, 0), 0.2),
        [quad(4.0)],
        [place(0)],
        [material],
        lights=list(lights),
        world=world,
    )

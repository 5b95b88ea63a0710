"""From a shape's record to a mesh that others may share, and a matrix that puts it in its place.

Size and position go into the matrix wherever the mesh allows it: a thousand spheres of a thousand
radii are one mesh.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ...lang.scene import IDENTITY, ShapeRecord
from . import shape_meshes
from .mesh_data import MeshData, transformed
from .models import MeshContents
from .transforms import matrix_of_rows, placing

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class MeshRecipe:
    """How to make a mesh; recipes of equal `key` make equal meshes."""

    key: str
    build: Callable[[], MeshContents]


@dataclass(frozen=True, slots=True)
class Placement:
    recipe: MeshRecipe
    matrix: Float64
    """(4, 4) mesh to TRG world"""


Vector = tuple[float, float, float]


def place_shape(shape: ShapeRecord, model_recipe: Callable[[ShapeRecord], MeshRecipe]) -> Placement:
    """Mesh and place of a checked record; `model_recipe` answers for the kind `model`."""
    if shape.kind == "model":
        return Placement(model_recipe(shape), matrix_of_rows(shape.transform))
    recipe, local = PLACERS[shape.kind](*shape.parameters)
    if shape.transform == IDENTITY:
        return Placement(recipe, local)
    return Placement(recipe, matrix_of_rows(shape.transform) @ local)


def bake_linear_part(placement: Placement) -> Placement:
    """The same shape with rotation, scale and shear in the mesh and only the translation in the matrix."""
    linear = placement.matrix[:3, :3]
    digits = ",".join(repr(x) for x in linear.reshape(-1).tolist())
    source = placement.recipe

    def build() -> MeshContents:
        contents = source.build()
        return replace(contents, mesh=transformed(contents.mesh, linear))

    return Placement(MeshRecipe(f"{source.key}|{digits}", build), placing(placement.matrix[:3, 3]))


def _recipe(key: str, build_mesh: Callable[..., MeshData], *arguments: object) -> MeshRecipe:
    return MeshRecipe(key, lambda: MeshContents(build_mesh(*arguments)))


def _place_sphere(centre: Vector, radius: float) -> tuple[MeshRecipe, Float64]:
    recipe = _recipe("sphere", shape_meshes.sphere_mesh)
    return recipe, placing(centre, (radius, radius, radius))


def _place_box(corner1: Vector, corner2: Vector) -> tuple[MeshRecipe, Float64]:
    size = tuple(abs(b - a) for a, b in zip(corner1, corner2, strict=True))
    centre = tuple((a + b) / 2 for a, b in zip(corner1, corner2, strict=True))
    if min(size) > 0.0:
        return _recipe("box", shape_meshes.box_mesh), placing(centre, size)
    return _recipe(f"box:{size!r}", shape_meshes.box_mesh, size), placing(centre)


def _place_plane(normal: Vector, distance: float) -> tuple[MeshRecipe, Float64]:
    length = float(np.linalg.norm(normal))
    up = np.array(normal) / length
    side = np.array((1.0, 0.0, 0.0)) if abs(up[1]) > 0.999_999 else np.cross((0.0, 1.0, 0.0), up)
    side = side - up * (side @ up)
    side = side / np.linalg.norm(side)
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack((side, up, np.cross(side, up)), axis=1)
    matrix[:3, 3] = up * (distance / length)
    return _recipe("plane", shape_meshes.plane_mesh), matrix


def _place_torus(centre: Vector, tube: float, ring: float) -> tuple[MeshRecipe, Float64]:
    ratio = tube / ring
    recipe = _recipe(f"tor:{ratio!r}", shape_meshes.torus_mesh, ratio)
    return recipe, placing(centre, (ring, ring, ring))


def _place_cone(base: Vector, radius: float, height: float) -> tuple[MeshRecipe, Float64]:
    recipe = _recipe("conus", shape_meshes.cone_mesh)
    return recipe, placing(base, (radius, height, radius))


def _place_cylinder(base: Vector, radius: float, height: float) -> tuple[MeshRecipe, Float64]:
    recipe = _recipe("cylinder", shape_meshes.cylinder_mesh)
    return recipe, placing(base, (radius, height, radius))


def _place_fence(centre: Vector, radius: float, height: float, count: float) -> tuple[MeshRecipe, Float64]:
    key = f"fence:{float(radius)!r}:{float(height)!r}:{int(count)}"
    recipe = _recipe(key, shape_meshes.fence_mesh, radius, height, int(count))
    return recipe, placing(centre)


def _place_triangle(p0: Vector, p1: Vector, p2: Vector) -> tuple[MeshRecipe, Float64]:
    first, second = np.subtract(p1, p0), np.subtract(p2, p0)
    digits = ",".join(repr(x) for x in (*first.tolist(), *second.tolist()))
    recipe = _recipe(f"triangle:{digits}", shape_meshes.triangle_mesh, first, second)
    return recipe, placing(p0)


PLACERS: dict[str, Callable[..., tuple[MeshRecipe, Float64]]] = {
    "sphere": _place_sphere,
    "box": _place_box,
    "plane": _place_plane,
    "tor": _place_torus,
    "conus": _place_cone,
    "cylinder": _place_cylinder,
    "fence": _place_fence,
    "triangle": _place_triangle,
}

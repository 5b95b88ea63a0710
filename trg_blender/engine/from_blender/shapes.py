"""Which meshes of a program's scene stand for a true sphere or plane, and still look like it."""

from __future__ import annotations

from functools import cache

import bpy
import numpy as np

from ..scene_arrays import Float32, MeshArrays
from ..to_blender import shape_meshes
from ..to_blender.axes import points_to_blender
from ..to_blender.mesh_data import MeshData
from ..to_blender.tags import PLANE, SPHERE

UNIT_SPHERE = (0.0, 0.0, 0.0, 1.0)
GROUND_PLANE = (0.0, 0.0, 1.0, 0.0)


def claimed_shape(owner: bpy.types.Object) -> str:
    """What the object's tags say: `sphere` or `plane` for those of unit size at its origin, else
    `triangles`."""
    if tuple(owner.get(SPHERE, ())) == UNIT_SPHERE:
        return "sphere"
    if tuple(owner.get(PLANE, ())) == GROUND_PLANE:
        return "plane"
    return "triangles"


def is_unedited(mesh: MeshArrays, shape: str) -> bool:
    """Whether `mesh` is still what to_blender makes for `shape`: vertices, faces, shading and texture
    places, bit by bit. Modifiers and edits make it a mesh like any other."""
    if shape == "triangles":
        return False
    data, vertices = _stand_in(shape)
    if len(mesh.triangles) != int((data.face_sizes - 2).sum()) or mesh.slots is not None:
        return False
    if not np.array_equal(mesh.vertices, vertices) or (mesh.normals is None) != (shape == "plane"):
        return False
    if mesh.uvs is None or data.uvs is None:
        return mesh.uvs is None
    return np.array_equal(_distinct(mesh.uvs), _distinct(data.uvs))


@cache
def _stand_in(shape: str) -> tuple[MeshData, Float32]:
    data = shape_meshes.sphere_mesh() if shape == "sphere" else shape_meshes.plane_mesh()
    return data, points_to_blender(data.vertices).astype(np.float32)


def _distinct(uvs: Float32) -> Float32:
    return np.unique(uvs.reshape(-1, 2), axis=0)

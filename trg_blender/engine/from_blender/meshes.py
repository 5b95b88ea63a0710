"""Evaluated Blender mesh -> MeshArrays, as fast as Blender's memory allows.

Two ways give the same arrays: `safe` asks Blender to copy everything (foreach_get), `fast` looks at
the loop triangles in place. The layout that `fast` relies on is not part of Blender's interface, so
`view_in_place` proves it on the very elements it is about to use. (A mesh made for the proof would not
do: making data while Blender renders an animation crashes it at the next frame.)
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..scene_arrays import Float32, Int32, MeshArrays
from .mesh_attributes import corner_uvs, read_attributes, texture_space


@dataclass(frozen=True, slots=True)
class MeshRequest:
    """What the caller wants of a mesh."""

    slot_count: int
    """material slots; face indices beyond the last slot mean the last slot, as in Cycles"""
    with_uvs: bool = False
    """whether the UV map that is active for rendering is wanted"""
    attributes: tuple[tuple[int, str], ...] = ()
    """number and kind:name of further corner attributes"""
    fast: bool = True


def read_mesh(mesh: bpy.types.Mesh, request: MeshRequest, warnings: list[str]) -> MeshArrays:
    """Copies of the triangles of `mesh`; triangles at non-finite vertices are left out with a warning.

    The arrays own their memory: they outlive the depsgraph. An empty mesh gives empty arrays.
    """
    mesh.calc_loop_triangles()
    corners = _corner_triangles(mesh, request.fast)
    triangles = np.take(_corner_vertices(mesh, request.fast), corners)
    vertices = np.zeros(len(mesh.vertices) * 3, np.float32)
    if len(vertices):
        mesh.attributes["position"].data.foreach_get("vector", vertices)
    vertices = vertices.reshape(-1, 3)
    arrays = MeshArrays(
        vertices=vertices,
        triangles=triangles,
        normals=_corner_normals(mesh, corners, triangles, request.fast),
        uvs=corner_uvs(mesh, corners, "", warnings) if request.with_uvs else None,
        slots=_triangle_slots(mesh, request.slot_count),
        origin=mesh.name,
        attributes=read_attributes(mesh, corners, request.attributes, warnings),
        texture_space=texture_space(mesh),
    )
    return _without_broken_triangles(arrays, warnings)


def view_in_place(
    collection: bpy.types.bpy_prop_collection, name: str, dtype: type, width: int
) -> NDArray[Any] | None:
    """(n, width) view of Blender's own memory, valid while the mesh is; None when it is not laid out so.

    `collection` is not empty. First, second and last element have to lie where a packed array has them, and
    the last has to read the same both ways.
    """
    count = len(collection)
    kind = ctypes.c_int32 if dtype is np.int32 else ctypes.c_float
    first = collection[0].as_pointer()
    stride = ctypes.sizeof(kind) * width
    if any(collection[k].as_pointer() != first + stride * k for k in {min(1, count - 1), count - 1}):
        return None
    view = np.ctypeslib.as_array((kind * (count * width)).from_address(first)).reshape(count, width)
    last = np.array(getattr(collection[count - 1], name), dtype).reshape(-1)
    return view if np.array_equal(view[-1], last, equal_nan=dtype is not np.int32) else None


def _column(
    collection: bpy.types.bpy_prop_collection, name: str, dtype: type, width: int, fast: bool
) -> NDArray[Any]:
    """(n, width) values of property `name`: in place when `fast` and possible, else a copy."""
    count = len(collection)
    if not count:
        return np.empty((0, width), dtype)
    view = view_in_place(collection, name, dtype, width) if fast else None
    if view is not None:
        return view
    flat = np.empty(count * width, dtype)
    collection.foreach_get(name, flat)
    return flat.reshape(count, width)


def _corner_triangles(mesh: bpy.types.Mesh, fast: bool) -> Int32:
    """(m, 3) corner indices of the triangles."""
    return _column(mesh.loop_triangles, "loops", np.int32, 3, fast)


def _corner_vertices(mesh: bpy.types.Mesh, fast: bool) -> Int32:
    """(corners,) vertex of each corner."""
    attribute = mesh.attributes.get(".corner_vert")
    if attribute is None:
        return _column(mesh.loops, "vertex_index", np.int32, 1, False).ravel()
    return _column(attribute.data, "value", np.int32, 1, fast).ravel()


def _vertex_normals(mesh: bpy.types.Mesh, fast: bool) -> Float32:
    return _column(mesh.vertex_normals, "vector", np.float32, 3, fast)


def _corner_normals(mesh: bpy.types.Mesh, corners: Int32, triangles: Int32, fast: bool) -> Float32 | None:
    """(m, 3, 3) normals, or None when every face is flat."""
    if mesh.normals_domain == "FACE" or not len(triangles):
        return None
    if mesh.normals_domain == "POINT":
        return np.take(_vertex_normals(mesh, fast), triangles, axis=0)
    normals = _column(mesh.corner_normals, "vector", np.float32, 3, False)
    return np.take(normals, corners, axis=0)


def _triangle_slots(mesh: bpy.types.Mesh, slot_count: int) -> Int32 | None:
    """(m,) material slot of each triangle; None when all are slot 0."""
    attribute = mesh.attributes.get("material_index")
    if attribute is None or slot_count < 2:
        return None
    of_face = np.empty(len(mesh.polygons), np.int32)
    attribute.data.foreach_get("value", of_face)
    np.clip(of_face, 0, slot_count - 1, out=of_face)
    if not of_face.any():
        return None
    faces = np.empty(len(mesh.loop_triangles), np.int32)
    mesh.loop_triangle_polygons.foreach_get("value", faces)
    return np.take(of_face, faces)


def _without_broken_triangles(arrays: MeshArrays, warnings: list[str]) -> MeshArrays:
    """Triangles that touch a NaN or infinite vertex are dropped, and said so."""
    if np.isfinite(arrays.vertices.sum(dtype=np.float64)):
        return arrays
    bad = ~np.isfinite(arrays.vertices).all(axis=1)
    if not bad.any():
        return arrays
    keep = ~bad[arrays.triangles].any(axis=1)
    warnings.append(
        f"mesh {arrays.origin!r}: {int(bad.sum())} vertices are not finite; "
        f"{int((~keep).sum())} triangles that touch them are left out"
    )
    vertices = arrays.vertices.copy()
    vertices[bad] = 0.0
    return MeshArrays(
        vertices=vertices,
        triangles=arrays.triangles[keep],
        normals=None if arrays.normals is None else arrays.normals[keep],
        uvs=None if arrays.uvs is None else arrays.uvs[keep],
        slots=None if arrays.slots is None else arrays.slots[keep],
        origin=arrays.origin,
        attributes={number: values[keep] for number, values in arrays.attributes.items()},
        texture_space=arrays.texture_space,
    )

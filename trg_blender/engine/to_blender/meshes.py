"""Mesh arrays in TRG's space as meshes of Blender."""

from __future__ import annotations

import bpy
import numpy as np

from .axes import points_to_blender
from .mesh_data import MeshData
from .tags import MESH


def build_mesh(name: str, key: str, data: MeshData) -> bpy.types.Mesh:
    """A new mesh with `data.slot_count` empty material slots, tagged with the recipe's key."""
    mesh = bpy.data.meshes.new(name)
    mesh[MESH] = key
    for _ in range(data.slot_count):
        mesh.materials.append(None)
    if len(data.corners):
        _write_topology(mesh, data)
        _write_attributes(mesh, data)
    return mesh


def meshes_by_key() -> dict[str, bpy.types.Mesh]:
    """Every mesh that a mirror made, whatever the scene."""
    return {mesh[MESH]: mesh for mesh in bpy.data.meshes if MESH in mesh and mesh.library is None}


def _write_topology(mesh: bpy.types.Mesh, data: MeshData) -> None:
    mesh.vertices.add(len(data.vertices))
    mesh.loops.add(len(data.corners))
    mesh.polygons.add(len(data.starts))
    positions = np.ascontiguousarray(points_to_blender(data.vertices), dtype=np.float32).reshape(-1)
    corners = np.ascontiguousarray(data.corners, dtype=np.int32)
    # The attribute arrays are many times faster than the collections, but their names are not promised.
    position = mesh.attributes.get("position")
    if position is not None:
        position.data.foreach_set("vector", positions)
    else:
        mesh.vertices.foreach_set("co", positions)
    corner_vertex = mesh.attributes.get(".corner_vert")
    if corner_vertex is not None:
        corner_vertex.data.foreach_set("value", corners)
    else:
        mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.foreach_set("loop_start", np.ascontiguousarray(data.starts, dtype=np.int32))
    mesh.update(calc_edges=True)


def _write_attributes(mesh: bpy.types.Mesh, data: MeshData) -> None:
    if data.flat_faces is not None and data.flat_faces.any():
        sharp = mesh.attributes.get("sharp_face") or mesh.attributes.new("sharp_face", "BOOLEAN", "FACE")
        sharp.data.foreach_set("value", np.ascontiguousarray(data.flat_faces))
    if data.slots is not None:
        slots = mesh.attributes.get("material_index") or mesh.attributes.new("material_index", "INT", "FACE")
        slots.data.foreach_set("value", np.ascontiguousarray(data.slots, dtype=np.int32))
    if data.uvs is not None:
        layer = mesh.uv_layers.new(name="UVMap")
        layer.uv.foreach_set("vector", np.ascontiguousarray(data.uvs, dtype=np.float32).reshape(-1))
    if data.normals is not None:
        mesh.normals_split_custom_set(points_to_blender(data.normals).tolist())
    mesh.update()

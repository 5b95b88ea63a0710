"""Finding out what a model file holds, whoever can read it: the engine's readers or Blender's importers."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import bpy
import numpy as np

from ...lang.scene import ShapeRecord
from ..formats import MODEL_READERS, FormatError, read_model
from .axes import points_to_trg
from .errors import SceneError
from .mesh_data import MeshData
from .models import MISSING_MODEL_KEY, MeshContents, contents_of_model, missing_model_contents

IMPORTED_ID_LISTS = (
    "objects",
    "meshes",
    "materials",
    "images",
    "collections",
    "armatures",
    "actions",
    "cameras",
    "lights",
    "node_groups",
)

# .ply and .stl hold bare coordinates: they are TRG's. .glb and .gltf have Y up by their standard and
# Blender's importer turns them.
IMPORTERS: dict[str, tuple[bool, Callable[[str], object]]] = {
    ".glb": (True, lambda path: bpy.ops.import_scene.gltf(filepath=path, loglevel=50)),
    ".gltf": (True, lambda path: bpy.ops.import_scene.gltf(filepath=path, loglevel=50)),
    ".ply": (False, lambda path: bpy.ops.wm.ply_import(filepath=path, forward_axis="Y", up_axis="Z")),
    ".stl": (False, lambda path: bpy.ops.wm.stl_import(filepath=path, forward_axis="Y", up_axis="Z")),
}


def model_key(shape: ShapeRecord) -> str:
    """Changes when the file does, so that a mesh made of an older file is not taken for this one's."""
    if shape.path is None:
        return MISSING_MODEL_KEY
    path = Path(shape.path)
    try:
        status = path.stat()
    except OSError:
        return MISSING_MODEL_KEY
    return f"model:{path}:{status.st_mtime_ns}:{status.st_size}"


def read_contents(shape: ShapeRecord) -> MeshContents:
    """What the model's file holds; a placeholder when there is no file.

    Raises SceneError for a damaged file or an unknown suffix; Blender's data is then as before.
    """
    key = model_key(shape)
    if key == MISSING_MODEL_KEY:
        return missing_model_contents()
    path = Path(str(shape.path))
    suffix = path.suffix.lower()
    try:
        if suffix in MODEL_READERS:
            return contents_of_model(read_model(path), key)
        if suffix in IMPORTERS:
            return _import_with_blender(path, *IMPORTERS[suffix])
    except (FormatError, OSError, RuntimeError) as error:
        raise SceneError(f"the model cannot be read: {error}", shape.origin, shape.key) from error
    known = ", ".join(sorted((*MODEL_READERS, *IMPORTERS)))
    raise SceneError(f"{path.name}: a model's name ends with one of {known}", shape.origin, shape.key)


def _import_with_blender(path: Path, y_is_turned: bool, importer: Callable[[str], object]) -> MeshContents:
    """Import, keep the triangles as arrays, remove all that the importer made. RuntimeError: it failed."""
    before = {name: set(getattr(bpy.data, name)) for name in IMPORTED_ID_LISTS}
    selected = [obj for obj in bpy.context.view_layer.objects if obj and obj.select_get()]
    active = bpy.context.view_layer.objects.active
    try:
        importer(str(path))
        bpy.context.view_layer.update()
        made = [obj for obj in bpy.data.objects if obj not in before["objects"] and obj.type == "MESH"]
        parts = [_world_triangles(obj) for obj in made]
    finally:
        for name, old in before.items():
            collection = getattr(bpy.data, name)
            for block in [block for block in collection if block not in old]:
                collection.remove(block)
        for obj in selected:
            obj.select_set(True)
        bpy.context.view_layer.objects.active = active
    parts = [part for part in parts if len(part[0])]
    if not parts:
        raise RuntimeError(f"{path.name} holds no triangles")
    return MeshContents(_joined(parts, y_is_turned))


Part = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]


def _world_triangles(obj: bpy.types.Object) -> Part:
    """Positions, triangles, corner normals and corner UVs of one imported object, in Blender's world."""
    mesh = obj.data
    mesh.calc_loop_triangles()
    count = len(mesh.loop_triangles)
    positions = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", positions)
    corners = np.empty(3 * count, dtype=np.int32)
    mesh.loop_triangles.foreach_get("loops", corners)
    vertex_of_corner = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", vertex_of_corner)
    normals = np.empty(3 * len(mesh.loops), dtype=np.float32)
    mesh.corner_normals.foreach_get("vector", normals)
    uvs = np.zeros(2 * len(mesh.loops), dtype=np.float32)
    if mesh.uv_layers.active is not None:
        mesh.uv_layers.active.uv.foreach_get("vector", uvs)
    matrix = np.array(obj.matrix_world)
    world = positions.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]
    turned = normals.reshape(-1, 3)[corners] @ np.linalg.pinv(matrix[:3, :3])
    lengths = np.linalg.norm(turned, axis=1, keepdims=True)
    unit = turned / np.where(lengths > 0.0, lengths, 1.0)
    return world, vertex_of_corner[corners], unit, uvs.reshape(-1, 2)[corners]


def _joined(parts: list[Part], y_is_turned: bool) -> MeshData:
    offsets = np.concatenate(([0], np.cumsum([len(part[0]) for part in parts])[:-1]))
    vertices = np.concatenate([part[0] for part in parts])
    normals = np.concatenate([part[2] for part in parts])
    if y_is_turned:
        vertices, normals = points_to_trg(vertices), points_to_trg(normals)
    corners = np.concatenate([part[1] + offset for part, offset in zip(parts, offsets, strict=True)])
    return MeshData(
        vertices=vertices.astype(np.float64),
        corners=corners.astype(np.int32),
        starts=np.arange(0, len(corners), 3, dtype=np.int32),
        uvs=np.concatenate([part[3] for part in parts]).astype(np.float32),
        normals=normals.astype(np.float32),
    )

"""What textures read of a mesh beside its shape: UV maps, tangents, colours, texture space."""

from __future__ import annotations

import bpy
import numpy as np

from ..scene_arrays import Color, Float32, Int32

NUMBERS_OF = {
    "FLOAT": ("value", 1),
    "INT": ("value", 1),
    "FLOAT2": ("vector", 2),
    "FLOAT_VECTOR": ("vector", 3),
    "FLOAT_COLOR": ("color", 4),
    "BYTE_COLOR": ("color", 4),
}
"""kind of attribute -> property that holds its numbers, and how many"""


def read_attributes(
    mesh: bpy.types.Mesh, corners: Int32, wanted: tuple[tuple[int, str], ...], warnings: list[str]
) -> dict[int, Float32]:
    """(m, 3, 1 to 4) values of the attributes `wanted` (number, kind:name) that `mesh` has."""
    found = {}
    for number, key in wanted:
        kind, name = key.split(":", 1)
        if kind == "uv":
            values = corner_uvs(mesh, corners, name, warnings)
        elif kind == "tangent":
            values = _tangents(mesh, corners, name, warnings)
        else:
            values = _colors(mesh, corners, name, warnings)
        if values is not None:
            found[number] = values
    return found


def corner_uvs(mesh: bpy.types.Mesh, corners: Int32, name: str, warnings: list[str]) -> Float32 | None:
    """(m, 3, 2) of UV map `name`, or of the one that is active for rendering; None where there is none."""
    layer = mesh.uv_layers.get(name) if name else None
    if layer is None and name:
        warnings.append(f"mesh {mesh.name!r} has no UV map {name!r}: its render map is used")
    if layer is None:
        layer = next((each for each in mesh.uv_layers if each.active_render), None)
    if layer is None:
        return None
    flat = np.empty(len(mesh.loops) * 2, np.float32)
    layer.uv.foreach_get("vector", flat)
    return np.take(flat.reshape(-1, 2), corners, axis=0)


def _tangents(mesh: bpy.types.Mesh, corners: Int32, name: str, warnings: list[str]) -> Float32 | None:
    """(m, 3, 4) tangent and sign by MikkTSpace (Mikkelsen 2008), for normal maps."""
    layer = mesh.uv_layers.get(name) if name else next((u for u in mesh.uv_layers if u.active_render), None)
    if layer is None:
        warnings.append(f"mesh {mesh.name!r} has no UV map for a normal map: its normals stay")
        return None
    try:
        mesh.calc_tangents(uvmap=layer.name)
    except RuntimeError as error:
        warnings.append(f"mesh {mesh.name!r}: no tangents for a normal map ({str(error).strip()})")
        return None
    values = np.empty((len(mesh.loops), 4), np.float32)
    flat = np.empty(len(mesh.loops) * 3, np.float32)
    mesh.loops.foreach_get("tangent", flat)
    values[:, :3] = flat.reshape(-1, 3)
    signs = np.empty(len(mesh.loops), np.float32)
    mesh.loops.foreach_get("bitangent_sign", signs)
    values[:, 3] = signs
    mesh.free_tangents()
    return np.take(values, corners, axis=0)


def _colors(mesh: bpy.types.Mesh, corners: Int32, name: str, warnings: list[str]) -> Float32 | None:
    """Values of attribute `name`, or of the colours that are active for rendering."""
    if not name:
        index = mesh.color_attributes.render_color_index
        attribute = mesh.color_attributes[index] if 0 <= index < len(mesh.color_attributes) else None
    else:
        attribute = mesh.attributes.get(name)
    if attribute is None or attribute.data_type not in NUMBERS_OF:
        warnings.append(f"mesh {mesh.name!r} has no attribute {name!r} of numbers: 0 is used")
        return None
    field, width = NUMBERS_OF[attribute.data_type]
    flat = np.empty(len(attribute.data) * width, np.float32)
    attribute.data.foreach_get(field, flat)
    values = flat.reshape(-1, width)
    if attribute.domain == "POINT":
        vertex = np.empty(len(mesh.loops), np.int32)
        mesh.loops.foreach_get("vertex_index", vertex)
        values = values[vertex]
    elif attribute.domain == "FACE":
        values = np.repeat(values, [len(face.vertices) for face in mesh.polygons], axis=0)
    elif attribute.domain != "CORNER":
        warnings.append(f"mesh {mesh.name!r}: attribute {name!r} of edges is not supported, 0 is used")
        return None
    return np.take(values, corners, axis=0)


def texture_space(mesh: bpy.types.Mesh) -> tuple[Color, Color]:
    """Scale and offset that take a place in the mesh to its generated coordinates, 0 to 1 over its box."""
    scale = [0.5 / size if size else 0.0 for size in mesh.texspace_size]
    offset = [0.5 - at * by for at, by in zip(mesh.texspace_location, scale, strict=True)]
    return (scale[0], scale[1], scale[2]), (offset[0], offset[1], offset[2])

"""Image Texture nodes: how they look an image up, and those that need no program."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import bpy
from mathutils import Euler, Matrix, Vector

from ..scene_arrays import CHANNELS, FILTERS, WRAP_MODES, Texture
from .image_reader import multiplies_alpha
from .sockets import describe, feeding_socket, input_socket

if TYPE_CHECKING:
    from .textures import TextureTable

FILTER_OF = {"Linear": "linear", "Closest": "closest", "Cubic": "cubic", "Smart": "cubic"}


def image_row(node: bpy.types.Node, image: int, owner: str, warnings: list[str]) -> Texture:
    """The look-up of `image` as `node` says, without placement."""
    if node.image is not None and node.image.source == "TILED":
        warnings.append(f"{describe(owner, node)}: only the first tile of the image is used")
    wrap = WRAP_MODES.index(node.extension.lower())
    return Texture(image, wrap=wrap, filter=FILTERS.index(FILTER_OF[node.interpolation]))


def plain_row(
    source: bpy.types.NodeSocket, target: bpy.types.NodeSocket, owner: str, table: TextureTable
) -> Texture | None:
    """The whole of an Image Texture whose place is an affine map of a UV map; None for others."""
    node = source.node
    placed = _placement(node)
    if node.projection != "FLAT" or placed is None:
        return None
    matrix, uv_map = placed
    row = image_row(node, table.pool.row(node.image, describe(owner, node)), owner, table.warnings)
    row.scale_u, row.skew_u, row.offset_u = matrix[0][0], matrix[0][1], matrix[0][3]
    row.skew_v, row.scale_v, row.offset_v = matrix[1][0], matrix[1][1], matrix[1][3]
    row.uv_map = table.attribute("uv", uv_map) if uv_map else 0
    row.unassociate = int(node.outputs["Alpha"].is_linked and multiplies_alpha(node.image))
    if source.name == "Alpha":
        row.channel = CHANNELS.index("alpha")
    elif target.type == "VALUE":
        row.channel = CHANNELS.index("luminance")
    return row


def _placement(node: bpy.types.Node) -> tuple[Matrix, str] | None:
    """Map behind the Vector input and the name of its UV map ("": the default)."""
    socket = input_socket(node, "Vector")
    source = feeding_socket(socket) if socket else None
    matrix = Matrix()
    if source is not None and source.node.type == "MAPPING":
        mapped = constant_mapping(source.node)
        if mapped is None:
            return None
        matrix = mapped
        source = feeding_socket(source.node.inputs["Vector"])
        if source is None:
            return None
    if source is None or (source.node.type == "TEX_COORD" and source.name == "UV"):
        return matrix, ""
    if source.node.type == "UVMAP":
        return matrix, str(source.node.uv_map)
    return None


def constant_mapping(node: bpy.types.Node) -> Matrix | None:
    """The affine map of a Mapping node; None when an input is linked or it normalises."""
    values = {}
    for name in ("Location", "Rotation", "Scale"):
        socket = input_socket(node, name)
        if socket is not None and feeding_socket(socket) is not None:
            return None
        values[name] = Vector(socket.default_value) if socket else Vector([float(name == "Scale")] * 3)
    turn = Euler(values["Rotation"], "XYZ").to_matrix().to_4x4()
    scale = Matrix.Diagonal((*values["Scale"], 1.0))
    move = Matrix.Translation(values["Location"])
    if node.vector_type == "POINT":
        return move @ turn @ scale
    if node.vector_type == "VECTOR":
        return turn @ scale
    if node.vector_type == "TEXTURE":
        shrink = [1.0 / s if s and math.isfinite(s) else 0.0 for s in values["Scale"]]
        return Matrix.Diagonal((*shrink, 1.0)) @ turn.transposed() @ move.inverted()
    return None

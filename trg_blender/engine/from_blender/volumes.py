"""Volume shaders -> absorption of what a material's surface encloses."""

from __future__ import annotations

import bpy

from ..scene_arrays import Color
from .shaders import ShaderReader
from .sockets import feeding_socket


def read_absorption(reader: ShaderReader, output: bpy.types.Node) -> Color:
    """Per metre and channel, of the Volume Absorption node in the output node's Volume input: as Blender has
    it, Density * (1 - Color). Anything else there is named in the warning and absorbs nothing."""
    socket = output.inputs["Volume"]
    source = feeding_socket(socket)
    if source is None:
        return (0.0, 0.0, 0.0)
    node = source.node
    if node.type != "VOLUME_ABSORPTION":
        reader.miss(f"node {node.name!r} ({node.bl_label or node.type}) in the Volume socket")
        return (0.0, 0.0, 0.0)
    color = reader.plain_color(node, "Color")
    density = max(reader.plain_number(node, "Density"), 0.0)
    red, green, blue = (density * max(1.0 - channel, 0.0) for channel in color)
    return (red, green, blue)

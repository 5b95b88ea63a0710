"""Blender's world -> one constant radiance."""

from __future__ import annotations

import bpy

from ..scene_arrays import Color
from .sockets import active_tree, as_color, as_number, constant_of, feeding_socket


def read_world(world: bpy.types.World | None, warnings: list[str]) -> Color:
    """Radiance of the background: Background node colour times strength; black without a world."""
    if world is None:
        return (0.0, 0.0, 0.0)
    tree = active_tree(world)
    if tree is None:
        return as_color(world.color)
    output = tree.get_output_node("CYCLES")
    if output is None:
        return (0.0, 0.0, 0.0)
    if output.inputs["Volume"].is_linked:
        warnings.append(f"world {world.name!r}: its volume is not rendered")
    source = feeding_socket(output.inputs["Surface"])
    if source is None:
        return (0.0, 0.0, 0.0)
    if source.node.type not in ("BACKGROUND", "EMISSION"):
        warnings.append(f"world {world.name!r}: node {source.node.name!r} is not supported, black is used")
        return (0.0, 0.0, 0.0)
    red, green, blue = as_color(_constant(source.node.inputs["Color"], world.name, warnings))
    strength = as_number(_constant(source.node.inputs["Strength"], world.name, warnings))
    return (red * strength, green * strength, blue * strength)


def _constant(socket: bpy.types.NodeSocket, name: str, warnings: list[str]) -> object:
    source = feeding_socket(socket)
    if source is None:
        return socket.default_value
    value = constant_of(source)
    if value is None:
        warnings.append(
            f"world {name!r}: node {source.node.name!r} on {socket.name} is not supported, "
            f"the socket's own value is used"
        )
        return socket.default_value
    return value

"""Following links of a node tree: what feeds a socket, and the constant it stands for."""

from __future__ import annotations

from collections.abc import Sequence

import bpy

from ..scene_arrays import Color


def active_tree(
    owner: bpy.types.Material | bpy.types.Light | bpy.types.World,
) -> bpy.types.ShaderNodeTree | None:
    """The shader nodes that `owner` is rendered with; since Blender 5 it always uses those it has."""
    if owner.node_tree is None or (bpy.app.version < (5, 0, 0) and not owner.use_nodes):
        return None
    return owner.node_tree


def feeding_socket(socket: bpy.types.NodeSocket) -> bpy.types.NodeSocket | None:
    """The output that feeds `socket`, through reroutes; None when nothing valid is plugged in."""
    seen = 0
    while socket.is_linked and seen < 256:
        link = next((each for each in socket.links if each.is_valid and not each.is_muted), None)
        if link is None:
            return None
        source = link.from_socket
        if source.node.type != "REROUTE":
            return source
        socket = source.node.inputs[0]
        seen += 1
    return None


def input_socket(node: bpy.types.Node, *names: str) -> bpy.types.NodeSocket | None:
    """The first input of `node` with one of `names` (names differ between Blender versions)."""
    return next((node.inputs[name] for name in names if name in node.inputs), None)


def constant_of(source: bpy.types.NodeSocket) -> float | Sequence[float] | None:
    """The value of an RGB or Value node's output; None for any other node."""
    if source.node.type in ("RGB", "VALUE"):
        return source.default_value
    return None


def as_color(value: float | Sequence[float]) -> Color:
    """Linear RGB of a socket's value; a number is a grey."""
    if isinstance(value, (int, float)):
        return (float(value),) * 3
    return (float(value[0]), float(value[1]), float(value[2]))


def as_number(value: float | Sequence[float]) -> float:
    """A number; a colour counts by its Rec.709 luminance, as Blender's implicit conversion does."""
    if isinstance(value, (int, float)):
        return float(value)
    return 0.2126 * float(value[0]) + 0.7152 * float(value[1]) + 0.0722 * float(value[2])


def describe(owner: str, node: bpy.types.Node) -> str:
    """How a message names a node."""
    return f"{owner}: node {node.name!r} ({node.bl_label or node.type})"

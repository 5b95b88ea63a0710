"""Walks the node graph behind one material input and emits its program."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import bpy

from ..program_builder import ProgramBuilder, Value
from ..texture_ops import MATH_OPERATIONS, NORMALS, VECTOR_MODES, VECTOR_OPERATIONS
from .sockets import describe

if TYPE_CHECKING:
    from .textures import TextureTable

DEEPEST = 200
"""Nodes in a row beyond which a graph is taken for endless."""
Place = tuple[bpy.types.NodeSocket, tuple[bpy.types.Node, ...]]
"""an output, and the groups that one has to enter to reach it"""


def number(value: float) -> Value:
    return Value((float(value),))


def triple(values: object) -> Value:
    return Value(tuple(float(x) for x in values)[:3])  # type: ignore[attr-defined]


@dataclass(slots=True)
class GraphReader:
    """One program in the making."""

    table: TextureTable
    owner: str
    used: set[int]
    builder: ProgramBuilder = field(default_factory=ProgramBuilder)
    groups: tuple[bpy.types.Node, ...] = ()
    _depth: int = 0

    def input(self, socket: bpy.types.NodeSocket) -> Value:
        """What comes into `socket`, converted to its type."""
        found = find_source(socket, self.groups)
        if found is None:
            return self.own_value(socket)
        source, groups = found
        if not source.is_output:
            before, self.groups = self.groups, groups
            value = self.own_value(source)
            self.groups = before
            return self.convert(value, source.type, socket.type)
        return self.convert(self.output(source, groups), source.type, socket.type)

    def named(self, node: bpy.types.Node, identifier: str) -> Value:
        """What comes into the input of `node` with that identifier; 0 where this Blender has none."""
        socket = find_input(node, identifier)
        return number(0.0) if socket is None else self.input(socket)

    def place_or(self, node: bpy.types.Node, default: str) -> Value:
        """What the Vector input of `node` says, or where textures lie without it."""
        socket = find_input(node, "Vector")
        if socket is not None and find_source(socket, self.groups) is not None:
            return self.input(socket)
        if default == "uv":
            self.used.add(0)
            return self.builder.emit("attribute")
        return self.builder.emit(default)

    def normal_or(self, node: bpy.types.Node) -> Value:
        socket = find_input(node, "Normal")
        if socket is not None and find_source(socket, self.groups) is not None:
            return self.input(socket)
        return self.builder.emit("normal", mode=NORMALS.index("shading"))

    def own_value(self, socket: bpy.types.NodeSocket) -> Value:
        """The value that an unplugged input has."""
        value = getattr(socket, "default_value", 0.0)
        if isinstance(value, (bool, int, float)):
            return number(value)
        try:
            return triple(value)
        except TypeError:
            return Value((0.0, 0.0, 0.0))

    def output(self, source: bpy.types.NodeSocket, groups: tuple[bpy.types.Node, ...]) -> Value:
        """What the output `source` gives, reached through `groups`."""
        from .texture_nodes import NODE_READERS  # the readers use this module

        node = source.node
        read = NODE_READERS.get(node.type)
        if read is None or self._depth > DEEPEST:
            return self._missing(node, source)
        before, self.groups = self.groups, groups
        self._depth += 1
        value = read(self, node, source)
        self._depth -= 1
        self.groups = before
        return value

    def _missing(self, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
        """The first colour input of a node that is not supported, or the value of its output."""
        color = next((each for each in node.inputs if each.type == "RGBA"), None)
        used = "the value of its output is" if color is None else f"its input {color.name} is"
        self.warn(f"{describe(self.owner, node)} is not supported, {used} used")
        if color is None or self._depth > DEEPEST:
            return self.own_value(source)
        self._depth += 1
        value = self.convert(self.input(color), "RGBA", source.type)
        self._depth -= 1
        return value

    def warn(self, text: str) -> None:
        if text not in self.table.warnings:
            self.table.warnings.append(text)

    def convert(self, value: Value, given: str, wanted: str) -> Value:
        """Blender's implicit conversions: a colour counts by its luminance, a vector by its mean."""
        wide, single = ("RGBA", "VECTOR"), ("VALUE", "INT", "BOOLEAN")
        if given in single and wanted in wide:
            return self.spread(value)
        if given == "RGBA" and wanted in single:
            return self.builder.emit("grey", value).part(0)
        if given == "VECTOR" and wanted in single:
            third = Value((1.0 / 3.0,) * 3)
            return self.vector_math("DOT_PRODUCT", value, third)
        return value

    def spread(self, value: Value) -> Value:
        """A number three times."""
        if value.constant is not None:
            return Value((value.constant[0],) * 3)
        return self.builder.emit("copy", value, value, value)

    def math(self, operation: str, *operands: Value) -> Value:
        return self.builder.emit("math", *operands, mode=MATH_OPERATIONS.index(operation))

    def vector_math(self, operation: str, *operands: Value) -> Value:
        if operation in VECTOR_OPERATIONS:
            return self.builder.emit(
                "vector_math", *operands, mode=VECTOR_MODES + VECTOR_OPERATIONS.index(operation)
            )
        names = {"FRACTION": "FRACT"}
        mode = MATH_OPERATIONS.index(names.get(operation, operation))
        return self.builder.emit("vector_math", *operands, mode=mode)

    def clamp(self, value: Value, low: Value | None = None, high: Value | None = None) -> Value:
        return self.builder.emit(
            "clamp", value, low or Value((0.0, 0.0, 0.0)), high or Value((1.0, 1.0, 1.0))
        )


def find_input(node: bpy.types.Node, identifier: str) -> bpy.types.NodeSocket | None:
    return next((each for each in node.inputs if each.identifier == identifier), None)


def find_source(socket: bpy.types.NodeSocket, groups: tuple[bpy.types.Node, ...]) -> Place | None:
    """The output that feeds `socket`, through reroutes, muted links left out, into groups and out of them;
    or the unplugged input of a group that stands for it. None when nothing is plugged in."""
    for _ in range(DEEPEST):
        link = next((each for each in socket.links if each.is_valid and not each.is_muted), None)
        if link is None:
            return (socket, groups) if socket.node.type == "GROUP" else None
        source = link.from_socket
        kind = source.node.type
        if kind == "REROUTE":
            socket = source.node.inputs[0]
        elif kind == "GROUP":
            inner = _group_result(source)
            if inner is None:
                return None
            socket, groups = inner, (*groups, source.node)
        elif kind == "GROUP_INPUT" and groups:
            outer = find_input(groups[-1], source.identifier)
            if outer is None:
                return None
            socket, groups = outer, groups[:-1]
        else:
            return source, groups
    return None


def _group_result(source: bpy.types.NodeSocket) -> bpy.types.NodeSocket | None:
    """The input of a group's output node that `source` shows."""
    tree = source.node.node_tree
    if tree is None:
        return None
    outputs = [each for each in tree.nodes if each.type == "GROUP_OUTPUT"]
    active = next((each for each in outputs if each.is_active_output), None)
    return None if active is None else find_input(active, source.identifier)

"""Texture rows of a scene: plain images, and node graphs as programs."""

from __future__ import annotations

from dataclasses import dataclass, field

import bpy

from ..program_builder import ProgramPool, ProgramTooLargeError, Value
from ..scene_arrays import Texture
from .image_reader import ImagePool, multiplies_alpha
from .image_texture import image_row, plain_row
from .sockets import describe, feeding_socket
from .texture_graph import GraphReader

Constant = tuple[float, ...]


@dataclass(slots=True)
class TextureTable:
    """Textures met so far; equal look-ups share a row, equal images their pixels."""

    warnings: list[str]
    textures: list[Texture] = field(default_factory=list)
    pool: ImagePool = field(init=False)
    programs: ProgramPool = field(default_factory=ProgramPool)
    attributes: list[str] = field(default_factory=lambda: [""])
    """kind:name of what textures read at corners of meshes; number 0 is the mesh's render UV map"""

    def __post_init__(self) -> None:
        self.pool = ImagePool(self.warnings)

    def read(self, socket: bpy.types.NodeSocket, owner: str, used: set[int]) -> tuple[Constant | None, int]:
        """What feeds the linked input `socket`: a constant and -1, or None and the row of a texture.

        `used` receives the numbers of the corner attributes that it reads. What is not supported is one
        warning a node, and its nearest sensible result.
        """
        source = feeding_socket(socket)
        if source is not None and source.node.type == "TEX_IMAGE":
            row = plain_row(source, socket, owner, self)
            if row is not None:
                used.add(row.uv_map)
                return None, self.add(row)
        graph = GraphReader(self, owner, used)
        value = graph.input(socket)
        if value.constant is not None:
            return value.constant, -1
        if socket.type == "VALUE":
            value = graph.builder.emit("copy", value, value, value)
        try:
            program = self.programs.add(graph.builder.steps, value)
        except ProgramTooLargeError:
            self.warnings.append(f"{owner}: the nodes behind {socket.name} are too many, its value is used")
            return graph.own_value(socket).constant, -1
        return None, self.add(Texture(-1, program=program))

    def product(
        self, sockets: tuple[bpy.types.NodeSocket | None, ...], owner: str, used: set[int]
    ) -> int:
        """Row of the texture that is the product of inputs, colours or numbers; -1 where it is too large."""
        graph = GraphReader(self, owner, used)
        value = Value((1.0, 1.0, 1.0))
        for socket in sockets:
            if socket is not None:
                factor = graph.input(socket)
                wide = factor if socket.type == "RGBA" else graph.spread(factor)
                value = graph.vector_math("MULTIPLY", value, wide)
        try:
            return self.add(Texture(-1, program=self.programs.add(graph.builder.steps, value)))
        except ProgramTooLargeError:
            self.warnings.append(f"{owner}: the nodes behind its emission are too many, it is left out")
            return -1

    def add(self, row: Texture) -> int:
        if row not in self.textures:
            self.textures.append(row)
        return self.textures.index(row)

    def image_texture(self, node: bpy.types.Node, owner: str, alpha_used: bool) -> int:
        """Row of the image of `node` alone, for programs."""
        row = image_row(node, self.pool.row(node.image, describe(owner, node)), owner, self.warnings)
        row.unassociate = int(alpha_used and multiplies_alpha(node.image))
        return self.add(row)

    def attribute(self, kind: str, name: str) -> int:
        """Number of a corner attribute: kind is uv, tangent or color."""
        key = f"{kind}:{name}"
        if key not in self.attributes:
            self.attributes.append(key)
        return self.attributes.index(key)

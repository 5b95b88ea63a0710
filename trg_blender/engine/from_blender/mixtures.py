"""Mix and Add Shader: a tree of shaders flattened to weighted rows, and the row that stands for all of them.

With w the weight of a row and a its alpha, light passes straight through by the sum of w (1 - a), is
scattered by each row with w a, and the emission is the sum of w a times each row's own.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import bpy

from ..program_builder import ProgramTooLargeError, Value
from ..scene_arrays import Color, Material, Texture
from .sockets import input_socket
from .texture_graph import GraphReader, number

if TYPE_CHECKING:
    from .shaders import ShaderReader

MOST_ROWS = 64
"""What one material may be a mixture of: `kMostClosures` of native/shade/material.h."""


@dataclass(frozen=True, slots=True)
class Factor:
    """What a Mix Shader gives to one of its shaders where a texture says it."""

    socket: bpy.types.NodeSocket
    inverted: bool


@dataclass(frozen=True, slots=True)
class Part:
    """A shader that is no Mix or Add, and how much of it there is."""

    row: Material
    node: bpy.types.Node | None
    share: float
    factors: tuple[Factor, ...]

    @property
    def is_plain(self) -> bool:
        """Whether no texture has a say in weight or alpha."""
        return not self.factors and self.row.alpha_texture < 0


def mix_parts(parts: list[Part], reader: ShaderReader) -> tuple[Material, list[Material]]:
    """The row of the material, and the rows that it is a mixture of (none: it stands for itself)."""
    parts = [part for part in parts if part.share > 0.0]
    if len(parts) == 1 and parts[0].share == 1.0 and not parts[0].factors:
        return parts[0].row, []
    if len(parts) > MOST_ROWS:
        reader.miss(f"shaders beyond {MOST_ROWS} in one material")
        parts = parts[:MOST_ROWS]
    if all(part.is_plain for part in parts):
        whole = _plain_whole(parts, reader)
        weights = [(part.share * part.row.alpha, -1) for part in parts]
    else:
        programs = _Programs(parts, reader)
        whole = programs.whole()
        weights = [(1.0, programs.row(value)) for value in programs.present]
    rows = [
        replace(
            part.row,
            weight=weight,
            weight_texture=texture,
            alpha=1.0,
            alpha_texture=-1,
            emission_r=0.0,
            emission_g=0.0,
            emission_b=0.0,
            emission_texture=-1,
        )  # fmt: skip
        for part, (weight, texture) in zip(parts, weights, strict=True)
        if scatters(part.row) and (weight > 0.0)
    ]
    if len(rows) == 1 and all(part.is_plain for part in parts) and abs(rows[0].weight - whole.alpha) < 1e-6:
        return _with_surface(rows[0], whole), []
    return whole, rows


def scatters(row: Material) -> bool:
    """Whether a row does anything but shine and let light straight through."""
    has_base = row.base_texture >= 0 or row.base_r > 0 or row.base_g > 0 or row.base_b > 0
    has_sheen = max(row.sheen_r, row.sheen_g, row.sheen_b) > 0
    has_coat = row.coat > 0 or row.coat_texture >= 0
    has_lobes = has_base or row.specular > 0 or has_sheen or has_coat
    return row.alpha > 0.0 and (row.holdout == 1 or has_lobes)


def _with_surface(row: Material, whole: Material) -> Material:
    """`row` with what of `whole` is not scattering."""
    names = ("alpha", "through_r", "through_g", "through_b")
    names += ("emission_r", "emission_g", "emission_b", "emission_texture")
    return replace(row, weight=1.0, **{name: getattr(whole, name) for name in names})


def _plain_whole(parts: list[Part], reader: ShaderReader) -> Material:
    """Emission, alpha and colour of what passes, all constant but for one emission texture."""
    passed = sum(part.share * (1.0 - part.row.alpha) for part in parts)
    through = _sum_colors(parts, "through", [part.share * (1.0 - part.row.alpha) for part in parts])
    # Where all passes and something is added nevertheless, half of the paths look at each.
    alpha = 1.0 - passed if passed < 1.0 else 0.5
    if all(part.row.alpha == 0.0 for part in parts):
        alpha = 0.0
    scale = 1.0 / alpha if alpha > 0.0 else 0.0
    emission = _sum_colors(parts, "emission", [scale * part.share * part.row.alpha for part in parts])
    glowing = [part for part in parts if max(_color(part.row, "emission")) > 0.0]
    texture = max((part.row.emission_texture for part in glowing), default=-1)
    if texture >= 0 and len(glowing) > 1:
        reader.miss("textures on the emission of several shaders of one mixture")
        texture = -1
    if alpha < 1.0:
        through = tuple(channel / (1.0 - alpha) for channel in through)  # type: ignore[assignment]
    else:
        through = (1.0, 1.0, 1.0)
    return _whole(emission, texture, alpha, through)


def _whole(emission: Color, texture: int, alpha: float, through: Color) -> Material:
    return Material(
        0.0, 0.0, 0.0, specular=0.0, emission_texture=texture, alpha=alpha,
        emission_r=emission[0], emission_g=emission[1], emission_b=emission[2],
        through_r=through[0], through_g=through[1], through_b=through[2],
    )  # fmt: skip


def _color(row: Material, name: str) -> Color:
    return (getattr(row, f"{name}_r"), getattr(row, f"{name}_g"), getattr(row, f"{name}_b"))


def _sum_colors(parts: list[Part], name: str, weights: list[float]) -> Color:
    colors = [_color(part.row, name) for part in parts]
    red, green, blue = (
        sum(weight * color[channel] for weight, color in zip(weights, colors, strict=True))
        for channel in range(3)
    )
    return (red, green, blue)


class _Programs:
    """The same sums where textures have a say, as texture programs."""

    def __init__(self, parts: list[Part], reader: ShaderReader) -> None:
        self.parts, self.reader = parts, reader
        self.graph = GraphReader(reader.textures, reader.owner, reader.attributes)
        self.alphas = [self._alpha(part) for part in parts]
        self.weights = [self._weight(part) for part in parts]
        math = self.graph.math
        pairs = list(zip(self.weights, self.alphas, strict=True))
        self.present = [math("MULTIPLY", weight, alpha) for weight, alpha in pairs]
        self.passed = [
            math("MULTIPLY", weight, math("SUBTRACT", number(1.0), alpha)) for weight, alpha in pairs
        ]

    def row(self, value: Value) -> int:
        """Row of the texture that gives `value` three times."""
        spread = self.graph.spread(value)
        if spread.constant is not None:
            spread = self.graph.builder.emit("copy", number(0.0), number(0.0), number(0.0))
        textures = self.reader.textures
        try:
            program = textures.programs.add(self.graph.builder.steps, spread)
        except ProgramTooLargeError:
            self.reader.miss("the factors of its Mix Shaders, whose nodes are too many")
            return -1
        return textures.add(Texture(-1, program=program))

    def whole(self) -> Material:
        passes = [part for part in self.parts if part.row.alpha < 1.0 or part.row.alpha_texture >= 0]
        colors = {_color(part.row, "through") for part in passes}
        if len(colors) > 1:
            self.reader.miss("different colours of Transparent shaders mixed by textures")
        alpha = self.graph.math("SUBTRACT", number(1.0), self._sum(self.passed))
        through = next(iter(colors), (1.0, 1.0, 1.0))
        found = _whole(*self._emission(alpha), 1.0, through)
        return replace(found, alpha_texture=self.row(alpha)) if passes else found

    def _emission(self, alpha: Value) -> tuple[Color, int]:
        glowing = [k for k, part in enumerate(self.parts) if max(_color(part.row, "emission")) > 0.0]
        if not glowing:
            return (0.0, 0.0, 0.0), -1
        if any(self.parts[k].row.emission_texture >= 0 for k in glowing):
            self.reader.miss("textures on the emission of a shader that a texture mixes")
        math = self.graph.math
        # The largest colour stands in the row, for it tells how much light to look for here.
        colors = {k: _color(self.parts[k].row, "emission") for k in glowing}
        peak = max(max(color) for color in colors.values())
        channels = []
        for channel in range(3):
            terms = [
                math("MULTIPLY", self.present[k], number(color[channel] / peak))
                for k, color in colors.items()
            ]
            channels.append(math("DIVIDE", self._sum(terms), alpha))
        joined = self.graph.builder.emit("copy", *channels)
        program = self.reader.textures.programs.add(self.graph.builder.steps, joined)
        return (peak, peak, peak), self.reader.textures.add(Texture(-1, program=program))

    def _sum(self, values: list[Value]) -> Value:
        total = number(0.0)
        for value in values:
            total = self.graph.math("ADD", total, value)
        return total

    def _alpha(self, part: Part) -> Value:
        if part.row.alpha_texture < 0 or part.node is None:
            return number(part.row.alpha)
        socket = input_socket(part.node, "Alpha")
        assert socket is not None
        return self._share(self.graph.input(socket))

    def _weight(self, part: Part) -> Value:
        total = number(part.share)
        for factor in part.factors:
            value = self._share(self.graph.input(factor.socket))
            if factor.inverted:
                value = self.graph.math("SUBTRACT", number(1.0), value)
            total = self.graph.math("MULTIPLY", total, value)
        return total

    def _share(self, value: Value) -> Value:
        """Between 0 and 1."""
        math = self.graph.math
        return math("MINIMUM", math("MAXIMUM", value, number(0.0)), number(1.0))

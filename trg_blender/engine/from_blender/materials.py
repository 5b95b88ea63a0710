"""Blender materials -> rows of the material table.

`MaterialTable` hands out a row a material. What a node does beyond the model of
docs/architecture.md section 4 is rendered as the nearest thing and said in one warning a material.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import bpy

from ..classic_arrays import ClassicMaterial
from ..scene_arrays import Identity, Material
from .classic import read_classic
from .identities import identity_of_material
from .media import AIR, Medium, fill_rows
from .shaders import ShaderReader
from .sockets import active_tree
from .textures import TextureTable
from .volumes import read_absorption


@dataclass(slots=True)
class MaterialTable:
    """Materials met so far, in order; row of None is Cycles' grey for empty slots."""

    warnings: list[str]
    rows: list[Material] = field(default_factory=list)
    classic: list[ClassicMaterial | None] = field(default_factory=list)
    textures: TextureTable = field(init=False)
    identities: list[Identity] = field(default_factory=list)
    """of the rows, for passes"""
    _index: dict[tuple[int, Medium], int] = field(default_factory=dict)
    _attributes: dict[int, frozenset[int]] = field(default_factory=dict)
    """row -> numbers of the corner attributes that its textures read"""

    def __post_init__(self) -> None:
        self.textures = TextureTable(self.warnings)

    def add(self, material: bpy.types.Material | None, medium: Medium = AIR) -> int:
        """Row of `material` (evaluated) around `medium`, read at its first mention."""
        key = (material.as_pointer() if material is not None else 0, medium)
        if key not in self._index:
            reader = ShaderReader("" if material is None else f"material {material.name!r}", self.textures)
            self._index[key] = len(self.rows)
            row, parts = fill_rows(*_read_material(material, reader), material, medium)
            if parts:
                row = replace(row, mix_first=len(self.rows) + 1, mix_count=len(parts))
            self.rows += [row, *parts]
            self.identities += [identity_of_material(material)] * (1 + len(parts))
            self.classic += [read_classic(material, row)] * (1 + len(parts))
            self._finish(self._index[key], reader)
        return self._index[key]

    def attributes_of(self, slot_rows: tuple[int, ...]) -> tuple[int, ...]:
        """Numbers of the corner attributes that a mesh with these materials needs, in order."""
        wanted: set[int] = set().union(*(self._attributes.get(row, frozenset()) for row in slot_rows))
        return tuple(sorted(wanted))

    def _finish(self, row: int, reader: ShaderReader) -> None:
        if reader.attributes:
            self._attributes[row] = frozenset(reader.attributes)
        if reader.missed:
            self.warnings.append(f"{reader.owner}: not supported, nearest used: {'; '.join(reader.missed)}")


def _read_material(
    material: bpy.types.Material | None, reader: ShaderReader
) -> tuple[Material, list[Material]]:
    """The row of a material, and the rows that it is a mixture of."""
    if material is None:
        return Material(specular=0.0), []
    tree = active_tree(material)
    if tree is None:
        red, green, blue = material.diffuse_color[:3]
        return Material(red, green, blue, specular=0.0), []
    output = tree.get_output_node("CYCLES")
    if output is None:
        reader.miss("a node tree without a Material Output")
        return Material(0.0, 0.0, 0.0, specular=0.0), []
    if output.inputs["Displacement"].is_linked:
        reader.miss(f"the Displacement socket of node {output.name!r}")
    row, parts = reader.read_surface(output.inputs["Surface"])
    red, green, blue = read_absorption(reader, output)
    if max(red, green, blue) > 0.0 and (row.alpha < 1.0 or row.alpha_texture >= 0):
        reader.miss("absorption behind a surface that is partly transparent")
    return replace(row, absorption_r=red, absorption_g=green, absorption_b=blue), parts

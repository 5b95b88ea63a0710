"""Blender materials -> rows of the material table.

`MaterialTable` hands out a row a material. What a node does beyond the model of
docs/architecture.md section 4 is rendered as the nearest thing and said in one warning a material.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import bpy

from ..scene_arrays import Identity, Material
from .identities import identity_of_material
from .shaders import ShaderReader
from .sockets import active_tree
from .textures import TextureTable


@dataclass(slots=True)
class MaterialTable:
    """Materials met so far, in order; row of None is Cycles' grey for empty slots."""

    warnings: list[str]
    rows: list[Material] = field(default_factory=list)
    textures: TextureTable = field(init=False)
    identities: list[Identity] = field(default_factory=list)
    """of the rows, for passes"""
    _index: dict[int, int] = field(default_factory=dict)
    _attributes: dict[int, frozenset[int]] = field(default_factory=dict)
    """row -> numbers of the corner attributes that its textures read"""

    def __post_init__(self) -> None:
        self.textures = TextureTable(self.warnings)

    def add(self, material: bpy.types.Material | None) -> int:
        """Row of `material` (evaluated), read at its first mention."""
        key = material.as_pointer() if material is not None else 0
        if key not in self._index:
            reader = ShaderReader("" if material is None else f"material {material.name!r}", self.textures)
            self._index[key] = len(self.rows)
            self.rows.append(_read_material(material, reader))
            self.identities.append(identity_of_material(material))
            self._finish(len(self.rows) - 1, reader)
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


def _read_material(material: bpy.types.Material | None, reader: ShaderReader) -> Material:
    if material is None:
        return Material(specular=0.0)
    tree = active_tree(material)
    if tree is None:
        red, green, blue = material.diffuse_color[:3]
        return Material(red, green, blue, specular=0.0)
    output = tree.get_output_node("CYCLES")
    if output is None:
        reader.miss("a node tree without a Material Output")
        return Material(0.0, 0.0, 0.0, specular=0.0)
    for name in ("Volume", "Displacement"):
        if output.inputs[name].is_linked:
            reader.miss(f"the {name} socket of node {output.name!r}")
    return reader.read_surface(output.inputs["Surface"])

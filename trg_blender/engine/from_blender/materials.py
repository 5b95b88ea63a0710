"""Blender materials -> rows of the material table.

`MaterialTable` hands out a row a material. What a node does beyond the model of
docs/architecture.md section 4 is rendered as the nearest thing and said in one warning a material.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import bpy

from ..scene_arrays import Material
from .shaders import ShaderReader
from .sockets import active_tree
from .textures import TextureTable


@dataclass(slots=True)
class MaterialTable:
    """Materials met so far, in order; row of None is Cycles' grey for empty slots."""

    warnings: list[str]
    rows: list[Material] = field(default_factory=list)
    textures: TextureTable = field(init=False)
    _index: dict[int, int] = field(default_factory=dict)
    _uv_maps: dict[int, str] = field(default_factory=dict)
    """row -> UV map its textures ask for; only textured materials are in"""

    def __post_init__(self) -> None:
        self.textures = TextureTable(self.warnings)

    def add(self, material: bpy.types.Material | None) -> int:
        """Row of `material` (evaluated), read at its first mention."""
        key = material.as_pointer() if material is not None else 0
        if key not in self._index:
            reader = ShaderReader("" if material is None else f"material {material.name!r}", self.textures)
            self._index[key] = len(self.rows)
            self.rows.append(_read_material(material, reader))
            self._finish(len(self.rows) - 1, reader)
        return self._index[key]

    def uv_map_of(self, slot_rows: tuple[int, ...]) -> str | None:
        """UV map for a mesh with these materials; None when no material has a texture."""
        return next((self._uv_maps[row] for row in slot_rows if row in self._uv_maps), None)

    def _finish(self, row: int, reader: ShaderReader) -> None:
        if reader.uv_maps:
            self._uv_maps[row] = reader.uv_maps[0]
            if len(set(reader.uv_maps)) > 1:
                reader.miss(f"UV maps other than {reader.uv_maps[0]!r}")
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

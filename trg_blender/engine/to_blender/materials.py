"""Material records as Principled BSDF node trees, which Cycles and EEVEE render as well."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import bpy

from ...lang.scene import MaterialRecord, TextureRecord
from .edits import is_changed, note_material
from .images import COLOR_SLOTS, ImageStore
from .tags import HASH, KEY, ORIGIN, OWNER, blocks_by_key, fingerprint

TEXTURE_SIGNATURE = "trg_textures"

# Sockets by the names of 4.x and 5.x; a version that lacks one is served by the next name.
SOCKET_NAMES: dict[str, tuple[str, ...]] = {
    "base_color": ("Base Color",),
    "metallic": ("Metallic",),
    "roughness": ("Roughness",),
    "ior": ("IOR",),
    "transmission": ("Transmission Weight", "Transmission"),
    "emission": ("Emission Color", "Emission"),
    "emission_strength": ("Emission Strength",),
    "normal": ("Normal",),
}


@dataclass(slots=True)
class MaterialStore:
    """The materials of one scene's program, found by owner and key; counts what it writes."""

    owner: str
    images: ImageStore
    made: int = 0
    updated: int = 0
    warnings: list[str] = field(default_factory=list)
    """edits by hand that the program's new records replaced"""
    _materials: dict[str, bpy.types.Material] = field(default_factory=dict)
    _done: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        self._materials = blocks_by_key(bpy.data.materials, self.owner)

    def material_of(self, record: MaterialRecord) -> bpy.types.Material:
        """The material made equal to the record; untouched when it already is."""
        material = self._materials.get(record.key)
        if record.key in self._done and material is not None:
            return material
        self._done.add(record.key)
        pictures = [self.images.source_key(texture) for _, texture in record.textures]
        digest = fingerprint(replace(record, version=0), pictures)
        if material is not None and material.get(HASH) == digest:
            return material
        if material is None:
            material = bpy.data.materials.new(record.name or "material")
            material[KEY], material[OWNER] = record.key, self.owner
            self._materials[record.key] = material
            self.made += 1
        else:
            self.updated += 1
            if is_changed(material):
                self.warnings.append(
                    f"{material.name}: was edited by hand; the program has changed it and overwritten that"
                )
        self._write(material, record)
        note_material(material)
        material[HASH] = digest
        return material

    def remove_unused(self) -> None:
        """Remove materials of this program that no record named and no object uses."""
        unused = [m for key, m in self._materials.items() if key not in self._done and m.users == 0]
        if unused:
            bpy.data.batch_remove(unused)

    def _write(self, material: bpy.types.Material, record: MaterialRecord) -> None:
        if bpy.app.version < (5, 0, 0) and not material.use_nodes:
            material.use_nodes = True
        signature = repr(
            [(slot, self.images.source_key(texture), texture.tiles) for slot, texture in record.textures]
        )
        shader = next((n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED"), None)
        if shader is None or material.get(TEXTURE_SIGNATURE, "[]") != signature or not _has_output(material):
            shader = _new_tree(material.node_tree)
            for slot, texture in record.textures:
                self._add_texture(material.node_tree, shader, slot, texture)
            material[TEXTURE_SIGNATURE] = signature
        _write_values(shader, record)
        _write_properties(material, record)

    def _add_texture(
        self, tree: bpy.types.NodeTree, shader: bpy.types.Node, slot: str, texture: TextureRecord
    ) -> None:
        """UV Map -> Mapping (scale: tiles) -> Image Texture -> [Normal Map ->] the slot's socket."""
        socket = socket_of(shader, slot)
        if socket is None:
            return
        row = sum(node.bl_idname == "ShaderNodeTexImage" for node in tree.nodes)
        uv_map, mapping, picture = (
            _new_node(tree, name, (column, -300 * row))
            for name, column in (
                ("ShaderNodeUVMap", -1000),
                ("ShaderNodeMapping", -800),
                ("ShaderNodeTexImage", -550),
            )
        )
        mapping.inputs["Scale"].default_value = (texture.tiles, texture.tiles, 1.0)
        picture.image = self.images.prepare(texture, slot in COLOR_SLOTS)
        tree.links.new(mapping.inputs["Vector"], uv_map.outputs["UV"])
        tree.links.new(picture.inputs["Vector"], mapping.outputs["Vector"])
        output = picture.outputs["Color"]
        if slot == "normal":
            normal_map = _new_node(tree, "ShaderNodeNormalMap", (-250, -300 * row))
            tree.links.new(normal_map.inputs["Color"], output)
            output = normal_map.outputs["Normal"]
        tree.links.new(socket, output)


def socket_of(shader: bpy.types.Node, slot: str) -> bpy.types.NodeSocket | None:
    """Input of the Principled node for a slot, in whatever version of Blender; None: it has none."""
    for name in SOCKET_NAMES[slot]:
        for socket in shader.inputs:
            if socket.identifier == name or socket.name == name:
                return socket
    return None


def _has_output(material: bpy.types.Material) -> bool:
    return any(node.bl_idname == "ShaderNodeOutputMaterial" for node in material.node_tree.nodes)


def _new_tree(tree: bpy.types.NodeTree) -> bpy.types.Node:
    """Empty the tree and give it a Principled node with an output."""
    tree.nodes.clear()
    shader = _new_node(tree, "ShaderNodeBsdfPrincipled", (0, 0))
    output = _new_node(tree, "ShaderNodeOutputMaterial", (350, 0))
    tree.links.new(output.inputs["Surface"], shader.outputs["BSDF"])
    return shader


def _new_node(tree: bpy.types.NodeTree, name: str, location: tuple[int, int]) -> bpy.types.Node:
    node = tree.nodes.new(name)
    node.location = location
    return node


def _write_values(shader: bpy.types.Node, record: MaterialRecord) -> None:
    has_emission_texture = any(slot == "emission" for slot, _ in record.textures)
    strength = record.emission_strength
    if has_emission_texture and strength == 0.0:
        strength = 1.0
    values = {
        "base_color": (*record.base_color, 1.0),
        "metallic": record.metallic,
        "roughness": min(record.roughness, 1.0),
        "ior": record.ior,
        "transmission": record.transmission,
        "emission": (*record.emission_color, 1.0),
        "emission_strength": strength,
    }
    for slot, value in values.items():
        socket = socket_of(shader, slot)
        if socket is not None:
            socket.default_value = value


def _write_properties(material: bpy.types.Material, record: MaterialRecord) -> None:
    """The viewport's colour, and the Phong row for the integrator that wants it."""
    material.diffuse_color = (*record.base_color, 1.0)
    material.metallic, material.roughness = min(record.metallic, 1.0), min(record.roughness, 1.0)
    material[ORIGIN] = str(record.origin or "")
    material["trg_phong_ambient"] = record.phong_ambient
    material["trg_phong_diffuse"] = record.phong_diffuse
    material["trg_phong_specular"] = record.phong_specular
    material["trg_phong_power"] = float(record.phong_power)
    material["trg_reflect"] = float(record.reflect)
    material["trg_refract"] = float(record.refract)

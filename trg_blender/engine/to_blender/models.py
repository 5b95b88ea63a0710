"""Model files as mesh arrays and material records: the group's formats and Wavefront, without bpy."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

import numpy as np

from ...lang.scene import MaterialRecord, TextureRecord
from ..formats import Model, ModelMaterial, ModelTexture
from .mesh_data import MeshData, mesh_of_triangles, shaded_flat
from .shape_meshes import box_mesh

PLACEHOLDER_SIZE = 1.0
MISSING_MODEL_KEY = "missing"
"""recipe key of the placeholder's mesh"""
PLACEHOLDER_MATERIAL = MaterialRecord(
    key="missing model", version=1, name="missing model", base_color=(1.0, 0.0, 1.0), roughness=1.0
)


@dataclass(frozen=True, slots=True)
class MeshContents:
    """A mesh ready to be built. A model brings one material record a slot and embedded pictures."""

    mesh: MeshData
    materials: tuple[MaterialRecord, ...] = ()
    """used when the program gives the model no material of its own"""
    images: tuple[tuple[str, ModelTexture], ...] = ()
    """(key of the TextureRecord, picture)"""
    warnings: tuple[str, ...] = ()


def contents_of_model(model: Model, key: str) -> MeshContents:
    """One mesh of all primitives; `key` makes the keys of materials and textures unique."""
    textures = tuple((f"{key}#texture{index}", texture) for index, texture in enumerate(model.textures))
    records = tuple(
        _record_of_material(material, f"{key}#{index}", textures)
        for index, material in enumerate(model.materials)
    )
    needs_default = any(primitive.material < 0 for primitive in model.primitives)
    if records and needs_default:
        records += (MaterialRecord(key=f"{key}#none", version=1, name="none"),)
    return MeshContents(_mesh_of_model(model, len(records) - 1), records, textures, model.warnings)


def missing_model_contents() -> MeshContents:
    """A magenta box of one metre that stands on y = 0."""
    box = box_mesh((PLACEHOLDER_SIZE,) * 3)
    standing = box.vertices + (0.0, PLACEHOLDER_SIZE / 2, 0.0)
    mesh = MeshData(standing, box.corners, box.starts, box.uvs, box.flat_faces)
    return MeshContents(mesh, (PLACEHOLDER_MATERIAL,))


def _mesh_of_model(model: Model, default_slot: int) -> MeshData:
    """All primitives as one mesh with the stored normals; triangles that use a vertex twice are left out."""
    filled = [primitive for primitive in model.primitives if len(primitive.triangles)]
    if not filled:
        return shaded_flat(mesh_of_triangles(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int32)))
    offsets = np.concatenate(([0], np.cumsum([len(primitive.vertices) for primitive in filled])[:-1]))
    triangles = np.concatenate([p.triangles + offset for p, offset in zip(filled, offsets, strict=True)])
    slots = np.concatenate(
        [
            np.full(len(p.triangles), p.material if p.material >= 0 else max(default_slot, 0), dtype=np.int32)
            for p in filled
        ]
    )
    a, b, c = triangles.T
    whole = (a != b) & (b != c) & (c != a)
    triangles, slots = triangles[whole].astype(np.int32), slots[whole]
    corners = triangles.reshape(-1)
    return MeshData(
        vertices=np.concatenate([p.vertices for p in filled]).astype(np.float64),
        corners=corners,
        starts=np.arange(0, len(corners), 3, dtype=np.int32),
        uvs=np.concatenate([p.uvs for p in filled])[corners],
        normals=np.concatenate([p.normals for p in filled])[corners],
        slots=slots if default_slot >= 0 else None,
    )


def _record_of_material(
    material: ModelMaterial, key: str, textures: tuple[tuple[str, ModelTexture], ...]
) -> MaterialRecord:
    """Phong row as a microfacet material: roughness = sqrt(2 / (power + 2)) (Walter et al. 2007, section 5.2
    relates the two lobes by that exponent); what is not opaque transmits."""
    texture = material.textures[0] if material.textures else -1
    slots: tuple[tuple[str, TextureRecord], ...] = ()
    if 0 <= texture < len(textures):
        texture_key, picture = textures[texture]
        slots = (("base_color", TextureRecord(key=texture_key, file=picture.name, path=texture_key)),)
    power = max(material.phong_power, 0.0)
    return MaterialRecord(
        key=key,
        version=1,
        name=material.name or "material",
        base_color=_clamped(material.diffuse),
        roughness=sqrt(2.0 / (power + 2.0)),
        transmission=min(max(1.0 - material.opacity, 0.0), 1.0),
        phong_ambient=material.ambient,
        phong_diffuse=material.diffuse,
        phong_specular=material.specular,
        phong_power=power,
        textures=slots,
    )


def _clamped(color: tuple[float, float, float]) -> tuple[float, float, float]:
    r, g, b = (min(max(float(c), 0.0), 1.0) if np.isfinite(c) else 0.8 for c in color)
    return (r, g, b)

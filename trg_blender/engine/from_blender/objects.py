"""One pass over the depsgraph's instances: meshes grouped with their materials, and lights."""

from __future__ import annotations

from dataclasses import dataclass, field

import bpy
import numpy as np

from ..reference_patterns import hash_words
from ..scene_arrays import (
    CAMERA_RAY,
    DIFFUSE_RAY,
    EVERY_RAY,
    GLOSSY_RAY,
    SHADOW_RAY,
    TRANSMISSION_RAY,
    Float32,
)
from .media import AIR, Medium, claimed_medium
from .shapes import claimed_shape

WITHOUT_SURFACE = {"EMPTY", "CAMERA", "ARMATURE", "LATTICE", "SPEAKER", "CURVE", "FONT", "META", "SURFACE"}
"""Kinds that show nothing themselves; the surface of the last four arrives as an instance of a mesh."""

RAY_BITS = {
    "visible_camera": CAMERA_RAY,
    "visible_diffuse": DIFFUSE_RAY,
    "visible_glossy": GLOSSY_RAY,
    "visible_transmission": TRANSMISSION_RAY,
    "visible_shadow": SHADOW_RAY,
}
BOUNCES = ("visible_diffuse", "visible_glossy", "visible_transmission")

KIND_NAMES = {
    "VOLUME": "volume",
    "POINTCLOUD": "point cloud",
    "CURVES": "hair curves",
    "GPENCIL": "grease pencil",
    "GREASEPENCIL": "grease pencil",
    "LIGHT_PROBE": "light probe",
}


@dataclass(slots=True)
class MeshGroup:
    """Instances that share a mesh and their materials."""

    mesh: bpy.types.Mesh
    materials: tuple[bpy.types.Material | None, ...]
    origin: str
    shape: str
    """what the object's tags say that its mesh stands for: one of SHAPES"""
    mask: int = EVERY_RAY
    """bits of the rays that meet it"""
    holdout: bool = False
    rows: list[int] = field(default_factory=list)
    """indices into Found.transforms"""
    owners: set[str] = field(default_factory=set)
    """names of the objects, and of those that make instances of them"""
    medium: Medium = AIR
    """what the object's tags say that it is filled with"""


@dataclass(slots=True)
class Found:
    groups: list[MeshGroup]
    transforms: Float32
    """(n, 3, 4) object to world of every instance of the depsgraph"""
    randoms: Float32
    """(n,) what Object Info calls Random, 0 to 1"""
    lights: list[tuple[bpy.types.Object, int]]
    """original-or-evaluated light object and its row in `transforms`"""


def find_objects(depsgraph: bpy.types.Depsgraph, warnings: list[str]) -> Found:
    """Everything visible to `depsgraph`, each kind that cannot be rendered named once."""
    instances = depsgraph.object_instances
    flat = np.empty(len(instances) * 16, np.float32)
    instances.foreach_get("matrix_world", flat)
    random_ids = np.empty(len(instances), np.int32)
    instances.foreach_get("random_id", random_ids)
    randoms = (random_ids.view(np.uint32) / 4294967295.0).astype(np.float32)
    columns_first = flat.reshape(-1, 4, 4)
    transforms = np.ascontiguousarray(columns_first.transpose(0, 2, 1)[:, :3])
    groups: dict[tuple[int, ...], MeshGroup] = {}
    lights: list[tuple[bpy.types.Object, int]] = []
    refused: set[str] = set()
    for row, instance in enumerate(instances):
        owner = instance.object
        kind = owner.type
        if not instance.show_self or kind in WITHOUT_SURFACE:
            continue
        if kind == "MESH":
            if not instance.is_instance:
                randoms[row] = _random_of_name(owner.name)
            seen = _seen_by(instance, depsgraph.view_layer)
            group = _add_mesh(groups, owner, (row, *seen), warnings)
            group.owners.add(owner.name)
            if instance.is_instance and instance.parent is not None:
                group.owners.add(instance.parent.name)
        elif kind == "LIGHT":
            source = instance.instance_object if instance.is_instance else owner
            lights.append((source, row))
            if not all(getattr(owner, name) for name in BOUNCES):
                refused.add(f"light {owner.name!r}: visibility by kind of ray is not supported")
        else:
            refused.add(f"object {owner.name!r}: a {KIND_NAMES.get(kind, kind.lower())} is not rendered")
    warnings.extend(sorted(refused))
    return Found(list(groups.values()), transforms, randoms, lights)


def _add_mesh(
    groups: dict[tuple[int, ...], MeshGroup],
    owner: bpy.types.Object,
    found: tuple[int, int, bool],
    warnings: list[str],
) -> MeshGroup:
    """`found`: the instance's row, by which rays it is met, and whether it is a hole."""
    row, mask, holdout = found
    mesh = owner.data
    materials = tuple(slot.material for slot in owner.material_slots) or (None,)
    shape = claimed_shape(owner)
    medium = claimed_medium(owner)
    pointers = (0 if each is None else each.as_pointer() for each in materials)
    key = (mesh.as_pointer(), hash((shape, medium, mask, holdout)), *pointers)
    group = groups.get(key)
    if group is None:
        group = MeshGroup(mesh, materials, owner.name, shape, mask, holdout, medium=medium)
        groups[key] = group
        if owner.is_shadow_catcher:
            warnings.append(f"object {owner.name!r}: a shadow catcher is rendered as a plain surface")
    group.rows.append(row)
    return group


def _seen_by(instance: bpy.types.DepsgraphObjectInstance, layer: bpy.types.ViewLayer) -> tuple[int, bool]:
    """Bits of the rays that meet an instance, and whether the camera sees a hole there. What an instancer is
    hidden from, its instances are too."""
    owner, mask = instance.object, EVERY_RAY
    for each in (owner, instance.parent if instance.is_instance else None):
        for name, bit in RAY_BITS.items():
            if each is not None and not getattr(each, name):
                mask &= ~bit
    named = (instance.parent or owner).original if instance.is_instance else owner.original
    if named.indirect_only_get(view_layer=layer):
        mask &= ~CAMERA_RAY
    return mask, owner.is_holdout or named.holdout_get(view_layer=layer)


def _random_of_name(name: str) -> float:
    """What Cycles gives an object that no instancer made, 0 to 1."""
    mixed = 0
    for byte in name.encode():
        mixed = (mixed * 37 + byte) & 0xFFFFFFFF
    words = [np.array([mixed], np.uint32), np.zeros(1, np.uint32)]
    return float(hash_words(words)[0]) / 4294967295.0

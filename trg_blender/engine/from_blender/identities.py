"""Names and indices that passes ask for: of the depsgraph's instances, and of the scene's mist."""

from __future__ import annotations

from collections.abc import Collection

import bpy

from ..scene_arrays import Identity, PassData

FALLOFFS = {"QUADRATIC": 2.0, "LINEAR": 1.0, "INVERSE_QUADRATIC": 0.5}
NEEDS_IDENTITIES = {
    "object_index",
    "material_index",
    "cryptomatte_object",
    "cryptomatte_material",
    "cryptomatte_asset",
}
NEEDS_DATA = NEEDS_IDENTITIES | {"mist", "ambient_occlusion"}
DEFAULT_MATERIAL = "default_surface"
"""What Cycles calls the material of an empty slot."""


def read_identities(depsgraph: bpy.types.Depsgraph) -> list[Identity]:
    """One for each instance of `depsgraph`, in its order."""
    known: dict[int, Identity] = {}
    found = []
    for instance in depsgraph.object_instances:
        owner = instance.object
        key = owner.as_pointer()
        if key not in known:
            known[key] = Identity(owner.name, _topmost(owner).name, owner.pass_index)
        found.append(known[key])
    return found


def _topmost(owner: bpy.types.Object) -> bpy.types.Object:
    while owner.parent is not None:
        owner = owner.parent
    return owner


def identity_of_material(material: bpy.types.Material | None) -> Identity:
    if material is None:
        return Identity(DEFAULT_MATERIAL)
    return Identity(material.name, "", material.pass_index)


def read_pass_data(
    scene: bpy.types.Scene, layer: bpy.types.ViewLayer, materials: list[Identity], passes: Collection[str]
) -> PassData | None:
    """None when none of `passes` needs it."""
    if not NEEDS_DATA.intersection(passes):
        return None
    if scene.world is None:
        return PassData(tuple(materials), layer.pass_cryptomatte_depth)
    mist = scene.world.mist_settings
    return PassData(
        tuple(materials),
        layer.pass_cryptomatte_depth,
        (mist.start, max(mist.depth, 1e-6), FALLOFFS[mist.falloff]),
        max(scene.world.light_settings.distance, 1e-6),
    )

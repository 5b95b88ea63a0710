"""Which abilities of the renderer a scene uses."""

from __future__ import annotations

from .passes import PASS_NAMES
from .scene_arrays import LIGHT_KINDS, RenderSettings, SceneArrays

FEATURES = (
    "textures",
    "smooth_normals",
    "metal",
    "transmission",
    "emission_meshes",
    "suns",
    "sun_angle",
    "points",
    "spots",
    "area_lights",
    "instances",
    "world",
    "environment",
    "alpha",
    *PASS_NAMES,
)


def find_features(scene: SceneArrays, settings: RenderSettings) -> tuple[list[str], list[str]]:
    """(used, left out), both in the order of FEATURES."""
    present = material_features(scene) | light_features(scene)
    if any(mesh.normals is not None for mesh in scene.meshes):
        present.add("smooth_normals")
    if sum(len(instance.transforms) for instance in scene.instances) > len(scene.meshes):
        present.add("instances")
    if any(channel != 0.0 for channel in scene.world):
        present.add("world")
    if scene.environment is not None:
        present.add("environment")
    if scene.transparent_film:
        present.add("alpha")
    present |= set(settings.passes)
    return [name for name in FEATURES if name in present], [name for name in FEATURES if name not in present]


def material_features(scene: SceneArrays) -> set[str]:
    present = set()
    for row in scene.materials:
        textures = (row.base_texture, row.roughness_texture, row.metallic_texture, row.emission_texture)
        if max(textures) >= 0:
            present.add("textures")
        if row.metallic > 0.0 or row.metallic_texture >= 0:
            present.add("metal")
        if row.transmission > 0.0:
            present.add("transmission")
        if max(row.emission_r, row.emission_g, row.emission_b) > 0.0:
            present.add("emission_meshes")
    return present


def light_features(scene: SceneArrays) -> set[str]:
    names = {
        "sun": "suns",
        "point": "points",
        "spot": "spots",
        "area_rectangle": "area_lights",
        "area_ellipse": "area_lights",
    }
    present = {names[LIGHT_KINDS[light.kind]] for light in scene.lights}
    if any(LIGHT_KINDS[light.kind] == "sun" and light.angle > 0.0 for light in scene.lights):
        present.add("sun_angle")
    return present

"""Whether arrays and settings can be rendered at all, said before any renderer sees them."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from .antialiasing import ANTIALIASINGS, FINEST_GRID
from .coincidence import coincidence_warnings
from .errors import SceneError
from .motion import MOST_KEYS
from .passes import PASS_NAMES
from .path_rules import wrong_rules
from .scene_arrays import (
    CAMERA_KINDS,
    LIGHT_KINDS,
    MATERIAL_FIELDS,
    PIXEL_FILTERS,
    SHAPES,
    WRAP_MODES,
    Camera,
    Environment,
    Float64,
    InstanceArrays,
    MeshArrays,
    RenderSettings,
    SceneArrays,
)

TEXTURE_COLUMNS = tuple(name for name in MATERIAL_FIELDS if name.endswith("_texture"))


def check_settings(settings: RenderSettings) -> None:
    """Raises SceneError for a picture that cannot be."""
    width, height = settings.width, settings.height
    if width < 1 or height < 1:
        raise SceneError(f"the picture's size is {width} x {height}: both sides must be 1 pixel or more")
    if settings.border is not None:
        x_min, y_min, x_max, y_max = settings.border
        if not (0 <= x_min < x_max <= width and 0 <= y_min < y_max <= height):
            raise SceneError(
                f"the border {settings.border} is empty or leaves the picture of {width} x {height}"
            )
    if settings.pixel_filter not in PIXEL_FILTERS or not 0.0 < settings.filter_width <= 100.0:
        raise SceneError(
            f"the pixel filter is {settings.pixel_filter!r} of {settings.filter_width} pixels: it must be "
            f"one of {', '.join(PIXEL_FILTERS)}, wider than 0 and up to 100 pixels"
        )
    if settings.samples < 1:
        raise SceneError(f"samples is {settings.samples}: it must be 1 or more")
    for name in ("seconds", "rmse"):
        limit = getattr(settings, name)
        if not (math.isfinite(limit) and limit >= 0.0):
            raise SceneError(f"{name} is {limit}: it must be 0 (no limit) or more")
    if settings.device == "embree" and (settings.rmse > 0.0 or settings.adaptive):
        raise SceneError("the reference renderer stops by samples or time, not by error")
    if settings.max_bounces < 0:
        raise SceneError(f"max_bounces is {settings.max_bounces}: it must be 0 or more")
    for line in wrong_rules(settings.rules):
        raise SceneError(line)
    if settings.aa not in ANTIALIASINGS:
        raise SceneError(f"antialiasing {settings.aa!r} is unknown; there are {', '.join(ANTIALIASINGS)}")
    if not 1 <= settings.aa_side <= FINEST_GRID:
        raise SceneError(f"the grid of a pixel has {settings.aa_side} cells a side: 1 to {FINEST_GRID}")
    unknown = sorted(set(settings.passes) - set(PASS_NAMES))
    if unknown:
        raise SceneError(f"unknown passes: {', '.join(unknown)}; there are {', '.join(PASS_NAMES)}")


def check_scene(scene: SceneArrays) -> list[str]:
    """Warnings about what will be left out. Raises SceneError, naming the origin, for what cannot be."""
    check_camera(scene.camera)
    for mesh in scene.meshes:
        check_mesh(mesh)
    for instance in scene.instances:
        check_instance(scene, instance)
    check_tables(scene)
    check_environment(scene.environment)
    return [*non_finite_warnings(scene.meshes), *coincidence_warnings(scene)]


def check_camera(camera: Camera) -> None:
    left, right, bottom, top = camera.window
    if not 0 <= camera.kind < len(CAMERA_KINDS):
        raise SceneError(f"the camera's kind is {camera.kind}: it must be an index into {CAMERA_KINDS}")
    if not np.isfinite(np.asarray(camera.matrix, dtype=np.float64)).all():
        raise SceneError("the camera's matrix is not finite")
    if not np.isfinite(camera.window).all() or left == right or bottom == top:
        raise SceneError(f"the camera sees nothing: its window is {camera.window}")
    if camera.motion is not None:
        moved = np.asarray(camera.motion, dtype=np.float64)
        if moved.shape[1:] != (3, 4) or not 2 <= len(moved) <= MOST_KEYS or not np.isfinite(moved).all():
            raise SceneError(f"the camera's motion is impossible: its keys have the shape {moved.shape}")
    lens = (camera.aperture, camera.focus, camera.blade_turn, camera.squeeze)
    if not np.isfinite(lens).all() or camera.aperture < 0 or camera.focus <= 0 or camera.squeeze <= 0:
        raise SceneError(f"the camera's lens is impossible: {lens}")


def check_environment(environment: Environment | None) -> None:
    if environment is None:
        return
    name = f"environment {environment.origin!r}"
    shape = environment.pixels.shape
    if len(shape) != 3 or 0 in shape or shape[2] != 3:
        raise SceneError(f"{name}: its pixels have the shape {shape}, expected (height, width, 3)")
    if not np.isfinite(environment.pixels).all():
        raise SceneError(f"{name}: a pixel is not finite")
    turned = np.asarray(environment.rotation, dtype=np.float64)
    if turned.shape != (3, 3) or not np.allclose(turned @ turned.T, np.eye(3), atol=1e-5):
        raise SceneError(f"{name}: its rotation is none")


def check_mesh(mesh: MeshArrays) -> None:
    name = f"mesh {mesh.origin!r}"
    if mesh.shape not in SHAPES:
        raise SceneError(f"{name}: its shape is {mesh.shape!r}, expected one of {SHAPES}")
    count = len(mesh.triangles)
    expected = {
        "vertices": (len(mesh.vertices), 3),
        "triangles": (count, 3),
        "normals": (count, 3, 3),
        "uvs": (count, 3, 2),
        "slots": (count,),
    }
    for field, shape in expected.items():
        array = getattr(mesh, field)
        if array is not None and array.shape != shape:
            raise SceneError(f"{name}: {field} has the shape {array.shape}, expected {shape}")
    if count and (mesh.triangles.min() < 0 or mesh.triangles.max() >= len(mesh.vertices)):
        raise SceneError(
            f"{name}: a triangle names a vertex that is not there ({len(mesh.vertices)} vertices)"
        )


def check_instance(scene: SceneArrays, instance: InstanceArrays) -> None:
    name = f"object {instance.origin!r}"
    if not 0 <= instance.mesh < len(scene.meshes):
        raise SceneError(f"{name}: mesh {instance.mesh} is not there ({len(scene.meshes)} meshes)")
    slots = scene.meshes[instance.mesh].slots
    if slots is not None and len(slots) and slots.min() < 0:
        raise SceneError(f"{name}: material slot {int(slots.min())} is not there")
    if not len(instance.slot_materials):
        raise SceneError(f"{name}: it has no material slot")
    materials = instance.slot_materials
    if materials.min() < 0 or materials.max() >= len(scene.materials):
        raise SceneError(
            f"{name}: a slot names a material that is not there ({len(scene.materials)} materials)"
        )
    transforms = np.asarray(instance.transforms, dtype=np.float64)
    if transforms.shape[1:] != (3, 4):
        raise SceneError(f"{name}: transforms have the shape {transforms.shape}, expected (copies, 3, 4)")
    if not np.isfinite(transforms).all() or (np.linalg.det(transforms[:, :, :3]) == 0.0).any():
        raise SceneError(f"{name}: a transform is not finite or flattens space")
    if instance.motion is not None:
        check_motion(name, np.asarray(instance.motion, dtype=np.float64), len(transforms))


def check_motion(name: str, motion: Float64, copies: int) -> None:
    if motion.shape[:1] != (copies,) or motion.shape[2:] != (3, 4) or not 2 <= motion.shape[1] <= MOST_KEYS:
        raise SceneError(f"{name}: its motion has the shape {motion.shape}, expected ({copies}, keys, 3, 4)")
    if not np.isfinite(motion).all() or (np.linalg.det(motion[..., :3]) == 0.0).any():
        raise SceneError(f"{name}: its motion is not finite or flattens space")


def check_tables(scene: SceneArrays) -> None:
    """Indices between materials, textures and images."""
    for number, material in enumerate(scene.materials):
        for field in TEXTURE_COLUMNS:
            if not -1 <= getattr(material, field) < len(scene.textures):
                raise SceneError(f"material {number}: {field} {getattr(material, field)} is not there")
    for number, texture in enumerate(scene.textures):
        if texture.program >= len(scene.programs.programs):
            raise SceneError(f"texture {number}: program {texture.program} is not there")
        if texture.program < 0 and not 0 <= texture.image < len(scene.images):
            raise SceneError(f"texture {number}: image {texture.image} is not there")
        if not 0 <= texture.wrap < len(WRAP_MODES):
            raise SceneError(f"texture {number}: wrap {texture.wrap} is not an index into {WRAP_MODES}")
    for image in scene.images:
        if image.pixels.ndim != 3 or 0 in image.pixels.shape:
            raise SceneError(f"image {image.origin!r}: its pixels have the shape {image.pixels.shape}")
        if image.pixels.dtype != np.uint8 and not np.isfinite(image.pixels).all():
            raise SceneError(f"image {image.origin!r}: a pixel is not finite")
    for number, light in enumerate(scene.lights):
        if not 0 <= light.kind < len(LIGHT_KINDS):
            raise SceneError(f"light {number}: kind {light.kind} is not an index into {LIGHT_KINDS}")


def non_finite_warnings(meshes: list[MeshArrays]) -> Iterator[str]:
    """One for each mesh of which triangles will be dropped."""
    for mesh in meshes:
        finite = np.isfinite(mesh.vertices).all(axis=1)
        if not finite.all():
            dropped = int((~finite[mesh.triangles].all(axis=1)).sum())
            yield (
                f"mesh {mesh.origin!r}: {int((~finite).sum())} vertices are not finite; "
                f"{dropped} triangles are left out"
            )

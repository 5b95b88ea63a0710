"""SceneArrays -> trg_native.Scene."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import numpy as np

from .classic_arrays import pack_classic
from .cryptomatte import id_of
from .holes import has_holes
from .scene_arrays import (
    EVERY_RAY,
    LIGHT_FIELDS,
    MATERIAL_FIELDS,
    TEXTURE_FIELDS,
    Float32,
    Identity,
    MeshArrays,
    PassData,
    RenderSettings,
    SceneArrays,
    pack_table,
)


def build_native_scene(
    native: ModuleType, scene: SceneArrays, settings: RenderSettings
) -> tuple[Any, dict[str, Any]]:
    """The built native scene and its build statistics. The arrays are copied."""
    result = native.Scene(accel=settings.accel, triangle_test=settings.triangle_test)
    for mesh in scene.meshes:
        add_mesh(result, mesh)
    return result, finish_native_scene(result, scene, settings, merge=True)


def finish_native_scene(
    result: Any, scene: SceneArrays, settings: RenderSettings, merge: bool
) -> dict[str, Any]:
    """Everything but the meshes, which `result` has; build statistics.

    `merge`: meshes used once that stand where they are may share an index.
    """
    add_instances(result, scene)
    set_randoms(result, scene)
    set_textures(result, scene)
    set_tables(result, scene)
    if scene.environment is not None:
        add_environment(result, scene)
    if scene.pass_data is not None:
        set_pass_data(result, scene, scene.pass_data)
    set_view(result, scene, settings)
    return dict(result.build(settings.threads, expected_rays(scene, settings), merge))


def add_instances(result: Any, scene: SceneArrays) -> None:
    for instance in scene.instances:
        transforms = np.ascontiguousarray(instance.transforms, dtype=np.float32)
        first = result.add_instances(
            instance.mesh, transforms, np.ascontiguousarray(instance.slot_materials, dtype=np.int32)
        )
        if instance.motion is not None:
            set_motion(result, first, instance.motion)
    set_visibility(result, scene)


def set_tables(result: Any, scene: SceneArrays) -> None:
    """Materials, lights and the constant world."""
    result.set_materials(pack_table(scene.materials, MATERIAL_FIELDS))
    result.set_lights(pack_table(scene.lights, LIGHT_FIELDS))
    result.set_world(*(float(value) for value in scene.world))


def set_view(result: Any, scene: SceneArrays, settings: RenderSettings) -> None:
    """How the scene is looked at: camera, filter, antialiasing, and the constants of `classic`."""
    result.set_antialiasing(settings.aa, settings.aa_side, settings.frame)
    if settings.integrator == "classic":
        result.set_classic(pack_classic(scene), scene.ambient)
    camera = scene.camera
    result.set_camera(
        camera.kind,
        np.ascontiguousarray(camera.matrix, dtype=np.float64),
        np.array(camera.window, dtype=np.float64),
        camera.clip_start,
        camera.clip_end,
        camera.aperture,
        camera.focus,
        camera.blades,
        camera.blade_turn,
        camera.squeeze,
    )
    if camera.motion is not None:
        result.set_camera_motion(np.ascontiguousarray(camera.motion, dtype=np.float64))
    result.set_filter(settings.pixel_filter, settings.filter_width)


def set_motion(result: Any, first: int, motion: Float32) -> None:
    """Of the instances from `first` on, those that move at all."""
    for number in np.flatnonzero((motion != motion[:, :1]).any(axis=(1, 2, 3))):
        keys = np.ascontiguousarray(motion[number : number + 1], dtype=np.float32)
        result.set_motion(first + int(number), keys)


def set_visibility(result: Any, scene: SceneArrays) -> None:
    """Who is met by which rays; nothing where everybody is by all."""
    if not has_holes(scene) and all(one.mask == EVERY_RAY for one in scene.instances):
        return
    copies = [len(one.transforms) for one in scene.instances]
    masks = np.repeat(np.array([one.mask for one in scene.instances], np.uint8), copies)
    held_out = np.repeat(np.array([one.holdout for one in scene.instances], np.uint8), copies)
    result.set_visibility(masks, held_out, has_holes(scene) and not scene.transparent_film)


def set_textures(result: Any, scene: SceneArrays) -> None:
    """Images in their own size, textures and programs."""
    add_images(result, scene)
    set_look_ups(result, scene)


def add_images(result: Any, scene: SceneArrays) -> None:
    for image in scene.images:
        pixels = image.pixels
        if pixels.dtype == np.float16:
            pixels = pixels.view(np.uint16)
        elif pixels.dtype != np.uint8:
            pixels = pixels.astype(np.float32, copy=False)
        result.add_image(np.ascontiguousarray(pixels), image.srgb)


def set_look_ups(result: Any, scene: SceneArrays) -> None:
    """Textures and programs over the images that are there."""
    result.set_textures(pack_table(scene.textures, TEXTURE_FIELDS))
    programs = scene.programs
    result.set_programs(programs.ops, programs.constants, programs.programs)


def set_pass_data(result: Any, scene: SceneArrays, data: PassData) -> None:
    """Indices and Cryptomatte ids of instances and materials, and what mist and occlusion need."""
    instances = [
        (who.index, id_of(who.name), id_of(who.asset))
        for one in scene.instances
        for who in one.identities or (Identity("", ""),) * len(one.transforms)
    ]
    materials = [(who.index, id_of(who.name)) for who in data.materials[: len(scene.materials)]]
    materials += [(0, 0.0)] * (len(scene.materials) - len(materials))
    result.set_pass_data(
        np.array(instances, np.float32).reshape(-1, 3),
        np.array(materials, np.float32).reshape(-1, 2),
        data.matte_levels,
        tuple(data.mist),
        data.ambient_distance,
    )


def set_randoms(result: Any, scene: SceneArrays) -> None:
    if all(instance.randoms is None for instance in scene.instances):
        return
    parts = [
        np.zeros(len(one.transforms), np.float32) if one.randoms is None else one.randoms
        for one in scene.instances
    ]
    result.set_randoms(np.concatenate(parts).astype(np.float32, copy=False))


def expected_rays(scene: SceneArrays, settings: RenderSettings) -> float:
    """About how many rays a render traces: at every surface of a path one to go on and one to a light."""
    surfaces = min(settings.max_bounces + 1, 4)
    per_sample = 1 + surfaces * (2 if scene.lights else 1)
    return float(settings.width) * settings.height * settings.samples * per_sample


def add_environment(result: Any, scene: SceneArrays) -> None:
    """A transparent film never shows the environment to the camera."""
    environment = scene.environment
    assert environment is not None
    result.set_environment(
        np.ascontiguousarray(environment.pixels, dtype=np.float32),
        np.ascontiguousarray(environment.rotation, dtype=np.float64),
        environment.seen_by_camera and not scene.transparent_film,
    )


def add_mesh(result: Any, mesh: MeshArrays) -> None:
    """A mesh with its attributes."""
    if mesh.shape == "sphere":
        number = result.add_sphere()
    elif mesh.shape == "plane":
        number = result.add_plane()
    else:
        number = result.add_mesh(
            np.ascontiguousarray(mesh.vertices, dtype=np.float32),
            np.ascontiguousarray(mesh.triangles, dtype=np.int32),
            None if mesh.normals is None else np.ascontiguousarray(mesh.normals, dtype=np.float32),
            None if mesh.uvs is None else np.ascontiguousarray(mesh.uvs, dtype=np.float32),
            None if mesh.slots is None else np.ascontiguousarray(mesh.slots, dtype=np.int32),
        )
    set_attributes(result, number, mesh)


def set_attributes(result: Any, number: int, mesh: MeshArrays) -> None:
    """What texture programs read of a mesh beside its main UV map."""
    if mesh.shape == "triangles":
        for attribute, values in mesh.attributes.items():
            result.set_attribute(number, attribute, np.ascontiguousarray(values, dtype=np.float32))
    if mesh.texture_space is not None:
        result.set_texture_space(number, *mesh.texture_space)

"""Blender's camera -> Camera, by Blender's own projection matrix, so that fit, shift, pixel aspect and
orthographic scale are exactly Blender's."""

from __future__ import annotations

import bpy
import numpy as np
from mathutils import Matrix

from ..errors import SceneError
from ..scene_arrays import CAMERA_KINDS, Camera


def read_camera(
    scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph, size: tuple[int, int], warnings: list[str]
) -> Camera:
    """The camera of `scene` for a picture of `size` pixels.

    Raises SceneError when the scene has no camera or the camera is squashed flat.
    """
    if scene.camera is None:
        raise SceneError(f"scene {scene.name!r} has no camera")
    owner = scene.camera.evaluated_get(depsgraph)
    if owner.type != "CAMERA":
        raise SceneError(f"the camera object {owner.name!r} of scene {scene.name!r} is a {owner.type}")
    data = owner.data
    if data.type == "PANO" and data.panorama_type == "EQUIRECTANGULAR":
        return _panorama(owner, warnings)
    if data.type not in ("PERSP", "ORTHO"):
        what = data.panorama_type if data.type == "PANO" else data.type
        warnings.append(f"camera {owner.name!r}: type {what} is rendered as perspective")
    orthographic = data.type == "ORTHO"
    projection = owner.calc_matrix_camera(
        depsgraph,
        x=size[0],
        y=size[1],
        scale_x=scene.render.pixel_aspect_x,
        scale_y=scene.render.pixel_aspect_y,
    )
    camera = Camera(
        CAMERA_KINDS.index("orthographic" if orthographic else "perspective"),
        _rigid_matrix(owner.matrix_world, owner.name),
        window_of(projection, orthographic),
        clip_start=float(data.clip_start),
        clip_end=float(data.clip_end),
    )
    if data.dof.use_dof:
        add_lens(camera, data, depsgraph)
    return camera


def _panorama(owner: bpy.types.Object, warnings: list[str]) -> Camera:
    data = owner.data
    if data.dof.use_dof:
        warnings.append(f"camera {owner.name!r}: depth of field of a panorama is not rendered")
    return Camera(
        CAMERA_KINDS.index("panorama"),
        _rigid_matrix(owner.matrix_world, owner.name),
        (data.longitude_min, data.longitude_max, data.latitude_min, data.latitude_max),
        clip_start=float(data.clip_start),
        clip_end=float(data.clip_end),
    )


SMALLEST_FOCUS = 1e-5


def add_lens(camera: Camera, data: bpy.types.Camera, depsgraph: bpy.types.Depsgraph) -> None:
    """Blender's depth of field: half the lens over the f-stop; an orthographic lens has one metre."""
    dof = data.dof
    lens = 1.0 if data.type == "ORTHO" else data.lens * 1e-3
    if dof.aperture_fstop <= 0.0:
        return
    camera.aperture = 0.5 * lens / dof.aperture_fstop
    camera.focus = max(_focus_depth(camera, dof, depsgraph), SMALLEST_FOCUS)
    camera.blades = dof.aperture_blades
    camera.blade_turn = dof.aperture_rotation
    camera.squeeze = 1.0 / dof.aperture_ratio if dof.aperture_ratio > 0.0 else 1.0


def _focus_depth(
    camera: Camera, dof: bpy.types.CameraDOFSettings, depsgraph: bpy.types.Depsgraph
) -> float:
    """Depth of the focus object (or its bone) along the view, else the distance given."""
    if dof.focus_object is None:
        return float(dof.focus_distance)
    target = dof.focus_object.evaluated_get(depsgraph)
    matrix = target.matrix_world
    bone = target.pose.bones.get(dof.focus_subtarget) if target.type == "ARMATURE" and target.pose else None
    if bone is not None:
        matrix = matrix @ bone.matrix
    offset = np.array(matrix.translation, dtype=np.float64) - camera.matrix[:, 3]
    return float(abs(offset @ camera.matrix[:, 2]))


def _rigid_matrix(matrix: Matrix, name: str) -> np.ndarray:
    """Camera to world without scale, as Blender renders a scaled camera."""
    unscaled = np.array(matrix.normalized(), dtype=np.float64)[:3]
    if not np.isfinite(unscaled).all() or abs(np.linalg.det(unscaled[:, :3])) < 1e-6:
        raise SceneError(f"the transform of camera {name!r} is not usable (zero scale or not finite)")
    return unscaled


def window_of(projection: Matrix, orthographic: bool) -> tuple[float, float, float, float]:
    """(left, right, bottom, top): the picture's edges are where clip x or y is -1 and 1."""
    edges = []
    for row in (0, 1):
        scale = projection[row][row]
        shift = -projection[row][3] if orthographic else projection[row][2]
        edges += [(-1.0 + shift) / scale, (1.0 + shift) / scale]
    return (edges[0], edges[1], edges[2], edges[3])

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
    if data.type not in ("PERSP", "ORTHO"):
        warnings.append(f"camera {owner.name!r}: type {data.type} is rendered as perspective")
    if data.dof.use_dof:
        warnings.append(f"camera {owner.name!r}: depth of field is not rendered")
    orthographic = data.type == "ORTHO"
    projection = owner.calc_matrix_camera(
        depsgraph,
        x=size[0],
        y=size[1],
        scale_x=scene.render.pixel_aspect_x,
        scale_y=scene.render.pixel_aspect_y,
    )
    return Camera(
        CAMERA_KINDS.index("orthographic" if orthographic else "perspective"),
        _rigid_matrix(owner.matrix_world, owner.name),
        _window(projection, orthographic),
        clip_start=float(data.clip_start),
        clip_end=float(data.clip_end),
    )


def _rigid_matrix(matrix: Matrix, name: str) -> np.ndarray:
    """Camera to world without scale, as Blender renders a scaled camera."""
    unscaled = np.array(matrix.normalized(), dtype=np.float64)[:3]
    if not np.isfinite(unscaled).all() or abs(np.linalg.det(unscaled[:, :3])) < 1e-6:
        raise SceneError(f"the transform of camera {name!r} is not usable (zero scale or not finite)")
    return unscaled


def _window(projection: Matrix, orthographic: bool) -> tuple[float, float, float, float]:
    """(left, right, bottom, top): the picture's edges are where clip x or y is -1 and 1."""
    edges = []
    for row in (0, 1):
        scale = projection[row][row]
        shift = -projection[row][3] if orthographic else projection[row][2]
        edges += [(-1.0 + shift) / scale, (1.0 + shift) / scale]
    return (edges[0], edges[1], edges[2], edges[3])

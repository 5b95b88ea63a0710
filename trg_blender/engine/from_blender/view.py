"""A 3D viewport -> whence it looks, through Blender's own matrices, so that lens, shift and zoom agree."""

from __future__ import annotations

import bpy
import numpy as np
from mathutils import Matrix

from ..scene_arrays import CAMERA_KINDS, Camera, Float64
from ..viewport_tracer import Rect, View
from .camera import add_lens, window_of

SIDES = ("min_x", "min_y", "max_x", "max_y")


def read_view(
    region: bpy.types.Region,
    view: bpy.types.RegionView3D,
    space: bpy.types.SpaceView3D,
    depsgraph: bpy.types.Depsgraph,
) -> View | None:
    """How `region` sees the scene; None where that is impossible: no size, or a camera squashed flat."""
    matrix = np.array(view.view_matrix.inverted_safe(), dtype=np.float64)[:3]
    usable = np.isfinite(matrix).all() and abs(np.linalg.det(matrix[:, :3])) > 1e-6
    if region.width < 1 or region.height < 1 or not usable:
        return None
    camera = _camera(matrix, view, space)
    through = camera_of(view, space)
    if through is not None:
        data = through.data
        camera.clip_start, camera.clip_end = float(data.clip_start), float(data.clip_end)
        if data.dof.use_dof:
            add_lens(camera, data, depsgraph)
    return View(camera, region.width, region.height, _border(region, view, space, depsgraph.scene))


def camera_of(view: bpy.types.RegionView3D, space: bpy.types.SpaceView3D) -> bpy.types.Object | None:
    """The camera that the viewport looks through; None for a free view."""
    owner = space.camera if view.view_perspective == "CAMERA" else None
    return owner if owner is not None and owner.type == "CAMERA" else None


def _camera(matrix: Float64, view: bpy.types.RegionView3D, space: bpy.types.SpaceView3D) -> Camera:
    orthographic = not view.is_perspective
    camera = Camera(
        CAMERA_KINDS.index("orthographic" if orthographic else "perspective"),
        matrix,
        window_of(view.window_matrix, orthographic),
        clip_start=float(space.clip_start),
        clip_end=float(space.clip_end),
    )
    if orthographic and camera_of(view, space) is None:
        # A free view without perspective sees as far behind its place as before it.
        camera.matrix = matrix.copy()
        camera.matrix[:, 3] += matrix[:, 2] * (0.5 * camera.clip_end)
        camera.clip_start = 1e-6
    return camera


def _border(
    region: bpy.types.Region,
    view: bpy.types.RegionView3D,
    space: bpy.types.SpaceView3D,
    scene: bpy.types.Scene,
) -> Rect | None:
    """The render border in pixels of the region, as Blender draws it; None where there is none."""
    through = camera_of(view, space)
    size = (region.width, region.height)
    if through is not None:
        if not scene.render.use_border:
            return None
        low, high = _frame(through, scene, view.perspective_matrix, size)
        part = [float(getattr(scene.render, f"border_{name}")) for name in SIDES]
    elif space.use_render_border:
        low, high = np.zeros(2), np.array(size, dtype=np.float64)
        part = [float(getattr(space, f"render_border_{name}")) for name in SIDES]
    else:
        return None
    first, last = low + part[:2] * (high - low), low + part[2:] * (high - low)
    sides = np.rint([*first, *last]).astype(int)
    x_min, y_min = (min(max(int(sides[k]), 0), size[k] - 1) for k in (0, 1))
    x_max, y_max = (min(max(int(sides[k + 2]), 1), size[k]) for k in (0, 1))
    return (x_min, y_min, max(x_max, x_min + 1), max(y_max, y_min + 1))


def _frame(
    owner: bpy.types.Object, scene: bpy.types.Scene, projection: Matrix, size: tuple[int, int]
) -> tuple[Float64, Float64]:
    """Lower left and upper right corner of the camera's picture, in pixels of the region."""
    place = owner.matrix_world.normalized()
    corners = []
    for corner in owner.data.view_frame(scene=scene):
        seen = projection @ (place @ corner).to_4d()
        corners.append([(seen[k] / seen[3] * 0.5 + 0.5) * size[k] for k in (0, 1)])
    return np.min(corners, axis=0), np.max(corners, axis=0)

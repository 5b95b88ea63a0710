"""Camera rays of the reference renderer."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .reference_math import normalize
from .reference_scene import FAR, Rays
from .scene_arrays import CAMERA_KINDS, Camera, Float64


@dataclass(frozen=True, slots=True)
class CameraRays:
    rays: Rays
    near: Float64
    """(n,) how far the rays' origins were moved on, so that nothing nearer than clip_start is seen"""
    depth_per_length: Float64
    """(n,) distance along -Z over distance along the ray"""


def build_camera_rays(camera: Camera, picture: tuple[int, int], x: Float64, y: Float64) -> CameraRays:
    """Rays through the places (x, y), in pixels from the bottom left of a `picture` (width, height)."""
    left, right, bottom, top = camera.window
    plane_x = left + (right - left) * x / picture[0]
    plane_y = bottom + (top - bottom) * y / picture[1]
    matrix = np.asarray(camera.matrix, dtype=np.float64)
    down = -np.ones_like(plane_x)
    if CAMERA_KINDS[camera.kind] == "perspective":
        local = np.stack([plane_x, plane_y, down], axis=1)
        origin = np.zeros_like(local)
    else:
        local = np.stack([0.0 * down, 0.0 * down, down], axis=1)
        origin = np.stack([plane_x, plane_y, 0.0 * down], axis=1)
    depth_per_length = 1.0 / np.linalg.norm(local, axis=1)
    direction = normalize(local @ matrix[:, :3].T)
    near = camera.clip_start / depth_per_length
    far = np.minimum((camera.clip_end - camera.clip_start) / depth_per_length, FAR)
    start = origin @ matrix[:, :3].T + matrix[:, 3] + near[:, None] * direction
    return CameraRays(Rays(start, direction, far), near, depth_per_length)

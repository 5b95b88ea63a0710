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


def build_camera_rays(
    camera: Camera, picture: tuple[int, int], x: Float64, y: Float64, lens: Float64 | None = None
) -> CameraRays:
    """Rays through the places (x, y), in pixels from the bottom left of a `picture` (width, height).

    `lens` (n, 2) are even numbers that place each ray on the aperture; None is its middle.
    """
    left, right, bottom, top = camera.window
    plane_x = left + (right - left) * x / picture[0]
    plane_y = bottom + (top - bottom) * y / picture[1]
    matrix = np.asarray(camera.matrix, dtype=np.float64)
    down = -np.ones_like(plane_x)
    kind = CAMERA_KINDS[camera.kind]
    if kind == "perspective":
        local = np.stack([plane_x, plane_y, down], axis=1)
        origin = np.zeros_like(local)
    elif kind == "orthographic":
        local = np.stack([0.0 * down, 0.0 * down, down], axis=1)
        origin = np.stack([plane_x, plane_y, 0.0 * down], axis=1)
    else:
        rim = np.cos(plane_y)
        local = np.stack([rim * np.sin(plane_x), np.sin(plane_y), -rim * np.cos(plane_x)], axis=1)
        origin = np.zeros_like(local)
    if lens is not None and camera.aperture > 0.0 and kind != "panorama":
        off = place_on_lens(camera, lens)
        origin, local = origin + off, local - off / camera.focus
    depth_per_length = 1.0 / np.linalg.norm(local, axis=1)
    direction = normalize(local @ matrix[:, :3].T)
    near = camera.clip_start / depth_per_length
    far = np.minimum((camera.clip_end - camera.clip_start) / depth_per_length, FAR)
    start = origin @ matrix[:, :3].T + matrix[:, 3] + near[:, None] * direction
    return CameraRays(Rays(start, direction, far), near, depth_per_length)


def place_on_lens(camera: Camera, lens: Float64) -> Float64:
    """(n, 3) local points of the aperture, spread evenly by area."""
    first, second = lens.T
    if camera.blades < 3:
        radius, angle = np.sqrt(first), 2.0 * np.pi * second
        x, y = radius * np.cos(angle), radius * np.sin(angle)
    else:
        # A triangle from the middle to one side, picked by the first number, turned into its place.
        side = np.minimum(np.floor(first * camera.blades), camera.blades - 1)
        reach = np.sqrt(first * camera.blades - side)
        half = np.pi / camera.blades
        corners = [
            reach * np.exp(1j * (camera.blade_turn + half * (2.0 * side + sign))) for sign in (-1, 1)
        ]
        point = corners[0] * (1.0 - second) + corners[1] * second
        x, y = point.real, point.imag
    return camera.aperture * np.stack([x * camera.squeeze, y, np.zeros_like(x)], axis=1)


FILTER_STEPS = 4096


def filter_offsets(name: str, width: float, even: Float64) -> Float64:
    """Offsets from the pixel's centre with the density of the filter, from numbers even in [0, 1)."""
    if name == "box":
        return (even - 0.5) * width
    reach = 1.5 * width if name == "gaussian" else width
    x = np.linspace(-reach, reach, FILTER_STEPS + 1)
    if name == "gaussian":
        height = np.exp(-8.0 * (x / width) ** 2)
    else:
        phase = np.pi * (x / reach + 1.0)
        terms = (0.35875, -0.48829, 0.14128, -0.01168)
        height = sum(term * np.cos(k * phase) for k, term in enumerate(terms))
    rising = np.concatenate([[0.0], np.cumsum(0.5 * (height[1:] + height[:-1]))])
    return np.interp(even, rising / rising[-1], x)

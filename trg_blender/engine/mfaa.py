"""Antialiasing over frames: patterns alternate, and the frame before is carried over by reprojection.

Each frame samples one colour of a chessboard of places in every pixel (`native/kernel/antialiasing.h`).
The frame before has the other colour: its picture is moved by the depth of what is seen now and by both
cameras, held within what is near it now, and both count half. After NVIDIA's MFAA (2014); moving and
clamping as in Karis 2014, "High-Quality Temporal Supersampling".
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .scene_arrays import CAMERA_KINDS, Camera, Float32, Float64


@dataclass(frozen=True, slots=True)
class SampledFrame:
    """One frame as its own samples show it; row 0 is the bottom row."""

    pixels: Float32
    """(h, w, 4)"""
    depth: Float32
    """(h, w) along the camera's -Z, 1e10 for a miss"""
    camera: Camera
    number: int


def blend_frames(now: SampledFrame, before: SampledFrame | None) -> tuple[Float32, int]:
    """The picture (h, w, 4) of both frames, and how many pixels have a share of the one before.

    What cannot be carried over is left out: another size, kind of camera or distance in time than one
    frame, and places that the camera did not see.
    """
    if before is None or not can_follow(now, before):
        return now.pixels, 0
    x, y, seen = places_before(now, before)
    carried = sample_bicubic(before.pixels, x, y)
    low, high = near_range(now.pixels)
    carried = np.clip(carried, low, high)
    mean = 0.5 * (now.pixels + carried)
    return np.where(seen[..., None], mean, now.pixels).astype(np.float32), int(seen.sum())


def can_follow(now: SampledFrame, before: SampledFrame) -> bool:
    flat = CAMERA_KINDS[now.camera.kind] in ("perspective", "orthographic")
    same = now.pixels.shape == before.pixels.shape and now.camera.kind == before.camera.kind
    return flat and same and abs(now.number - before.number) == 1


def places_before(now: SampledFrame, before: SampledFrame) -> tuple[Float64, Float64, NDArray[np.bool_]]:
    """Where the centre of each pixel was in the frame before, in pixels, and whether inside it."""
    height, width = now.depth.shape
    rows, columns = np.mgrid[0:height, 0:width]
    left, right, bottom, top = now.camera.window
    sx = left + (right - left) * (columns + 0.5) / width
    sy = bottom + (top - bottom) * (rows + 0.5) / height
    depth = nearest_around(now.depth).astype(np.float64)
    perspective = CAMERA_KINDS[now.camera.kind] == "perspective"
    spread = depth if perspective else np.ones_like(depth)
    matrix, old = np.asarray(now.camera.matrix, np.float64), np.asarray(before.camera.matrix, np.float64)
    world = np.stack([sx * spread, sy * spread, -depth], axis=-1) @ matrix[:, :3].T + matrix[:, 3]
    local = (world - old[:, 3]) @ old[:, :3]
    ahead = -local[..., 2]
    scale = np.where(ahead > 0.0, ahead, np.inf) if perspective else np.ones_like(depth)
    left, right, bottom, top = before.camera.window
    x = (local[..., 0] / scale - left) / (right - left) * width
    y = (local[..., 1] / scale - bottom) / (top - bottom) * height
    inside = (x >= 0.5) & (x <= width - 0.5) & (y >= 0.5) & (y <= height - 0.5) & (ahead > 0.0)
    return x, y, inside


def shifted(values: NDArray[np.float32]) -> list[NDArray[np.float32]]:
    """The nine neighbours of each pixel, edges repeated."""
    border = [(1, 1), (1, 1)] + [(0, 0)] * (values.ndim - 2)
    wide = np.pad(values, border, mode="edge")
    height, width = values.shape[:2]
    return [wide[row : row + height, column : column + width] for row in range(3) for column in range(3)]


def nearest_around(depth: Float32) -> Float32:
    """Edges move with what is in front."""
    nearest: Float32 = np.min(shifted(depth), axis=0)
    return nearest


def near_range(pixels: Float32) -> tuple[Float32, Float32]:
    """Least and largest value of the three by three around each pixel."""
    around = shifted(pixels)
    return np.min(around, axis=0), np.max(around, axis=0)


def cubic_weights(t: Float64) -> list[Float64]:
    """Catmull and Rom's spline at -1, 0, 1, 2 for t in [0, 1)."""
    return [
        ((-0.5 * t + 1.0) * t - 0.5) * t,
        (1.5 * t - 2.5) * t * t + 1.0,
        ((-1.5 * t + 2.0) * t + 0.5) * t,
        (0.5 * t - 0.5) * t * t,
    ]


def sample_bicubic(pixels: Float32, x: Float64, y: Float64) -> Float64:
    """Values (h, w, 4) at the places x, y, in pixels from the bottom left; edges are repeated."""
    height, width = pixels.shape[:2]
    column, row = np.floor(np.nan_to_num(x) - 0.5), np.floor(np.nan_to_num(y) - 0.5)
    across, up = cubic_weights(x - 0.5 - column), cubic_weights(y - 0.5 - row)
    column, row = np.clip(column, -2, width + 1), np.clip(row, -2, height + 1)
    total = np.zeros((*x.shape, pixels.shape[2]))
    for j in range(4):
        rows = np.clip(row + j - 1, 0, height - 1).astype(np.int64)
        for i in range(4):
            columns = np.clip(column + i - 1, 0, width - 1).astype(np.int64)
            total += (across[i] * up[j])[..., None] * pixels[rows, columns]
    return total

"""Matrices as location, rotation and scale, the way an object of Blender keeps them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Float64 = NDArray[np.float64]

SHEAR_TOLERANCE = 1e-5
"""Largest cosine between two axes of a matrix that still counts as a right angle."""


@dataclass(frozen=True, slots=True)
class Decomposition:
    """Location (n, 3), unit quaternion w x y z (n, 4) and scale (n, 3) of n matrices."""

    locations: Float64
    rotations: Float64
    scales: Float64
    exact: NDArray[np.bool_]
    """(n,) False where the matrix is sheared or singular: the three parts do not give it back"""


def matrix_of_rows(rows: Sequence[float]) -> Float64:
    """4 x 4 matrix of twelve numbers, three rows of four."""
    matrix = np.eye(4)
    matrix[:3] = np.reshape(rows, (3, 4))
    return matrix


def placing(position: Sequence[float], scale: Sequence[float] = (1.0, 1.0, 1.0)) -> Float64:
    """4 x 4 matrix that scales along the axes and then moves the origin to `position`."""
    x, y, z = position
    a, b, c = scale
    return np.array(((a, 0.0, 0.0, x), (0.0, b, 0.0, y), (0.0, 0.0, c, z), (0.0, 0.0, 0.0, 1.0)))


def decompose(matrices: Float64) -> Decomposition:
    """Parts of the matrices (n, 4, 4). A mirrored one has all three scales negative, as in Blender."""
    linear = matrices[:, :3, :3]
    lengths = np.linalg.norm(linear, axis=1)
    safe = np.where(lengths > 0.0, lengths, 1.0)
    axes = linear / safe[:, None, :]
    cosines = np.abs(np.einsum("nki,nkj->nij", axes, axes) - np.eye(3)).max(axis=(1, 2))
    exact = (cosines <= SHEAR_TOLERANCE) & (lengths.min(axis=1) > 0.0)
    sign = np.where(np.linalg.det(axes) < 0.0, -1.0, 1.0)
    rotations = quaternions_of(axes * sign[:, None, None])
    return Decomposition(matrices[:, :3, 3].copy(), rotations, lengths * sign[:, None], exact)


def quaternions_of(rotations: Float64) -> Float64:
    """Unit quaternions (n, 4), w x y z, of rotation matrices (n, 3, 3).

    The component of the largest absolute value is taken from the diagonal first (Shepperd 1978), so
    that no difference of nearly equal numbers is divided by.
    """
    m = rotations
    trace = np.trace(m, axis1=1, axis2=2)
    squares = np.stack((trace, m[:, 0, 0], m[:, 1, 1], m[:, 2, 2]), axis=1)
    largest = squares.argmax(axis=1)
    w_x, w_y, w_z = m[:, 2, 1] - m[:, 1, 2], m[:, 0, 2] - m[:, 2, 0], m[:, 1, 0] - m[:, 0, 1]
    x_y, y_z, z_x = m[:, 1, 0] + m[:, 0, 1], m[:, 2, 1] + m[:, 1, 2], m[:, 0, 2] + m[:, 2, 0]
    candidates = np.stack(
        (
            np.stack((1.0 + trace, w_x, w_y, w_z), axis=1),
            np.stack((w_x, 1.0 + 2.0 * m[:, 0, 0] - trace, x_y, z_x), axis=1),
            np.stack((w_y, x_y, 1.0 + 2.0 * m[:, 1, 1] - trace, y_z), axis=1),
            np.stack((w_z, z_x, y_z, 1.0 + 2.0 * m[:, 2, 2] - trace), axis=1),
        ),
        axis=1,
    )
    chosen = candidates[np.arange(len(m)), largest]
    return chosen / np.linalg.norm(chosen, axis=1, keepdims=True)


def frame_of_direction(forward: Float64, up: Float64) -> Float64:
    """Rotation (3, 3) whose third column is -`forward` and whose second leans to `up`.

    Both are vectors of one space; where they are parallel another up is taken.
    """
    back = -np.asarray(forward, dtype=np.float64)
    back = back / np.linalg.norm(back)
    right = np.cross(up, back)
    if np.linalg.norm(right) <= 1e-9 * max(float(np.linalg.norm(up)), 1e-300):
        right = np.cross((0.0, 0.0, 1.0) if abs(back[2]) < 0.9 else (0.0, 1.0, 0.0), back)
    right = right / np.linalg.norm(right)
    return np.stack((right, np.cross(back, right), back), axis=1)

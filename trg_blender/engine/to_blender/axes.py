"""The one conversion between TRG's space (right-handed, Y up) and Blender's (right-handed, Z up).

(x, y, z) of TRG is (x, -z, y) of Blender: a rotation by 90 degrees about X, so that lengths, angles,
windings and handedness stay as they are. Nothing else in the package swaps axes.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Float64 = NDArray[np.float64]

TRG_TO_BLENDER: Float64 = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])


def vector_to_blender(vector: Sequence[float]) -> tuple[float, float, float]:
    """A point or a vector of TRG in Blender's axes."""
    x, y, z = vector
    return (x, -z, y)


def vector_to_trg(vector: Sequence[float]) -> tuple[float, float, float]:
    """The inverse of `vector_to_blender`."""
    x, y, z = vector
    return (x, z, -y)


def points_to_blender(points: NDArray) -> NDArray:
    """Points, vectors or normals (..., 3) of TRG in Blender's axes; the type of the array stays."""
    return np.stack((points[..., 0], -points[..., 2], points[..., 1]), axis=-1)


def points_to_trg(points: NDArray) -> NDArray:
    """The inverse of `points_to_blender`."""
    return np.stack((points[..., 0], points[..., 2], -points[..., 1]), axis=-1)


def transforms_to_blender(matrices: Float64) -> Float64:
    """Object-to-world matrices (..., 4, 4) of TRG as ones between Blender's object and world space."""
    turn = np.eye(4)
    turn[:3, :3] = TRG_TO_BLENDER
    return turn @ matrices @ turn.T

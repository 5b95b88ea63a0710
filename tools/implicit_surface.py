"""Triangles of an implicit solid: naive surface nets on a regular grid, moved onto the surface.

Method: S. F. F. Gibson, "Constrained elastic surface nets", MICCAI 1998, in the simple form where a cell's
vertex is the mean of its edge crossings; each vertex then takes a few Newton steps along the gradient.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
Field = Callable[[Points], NDArray[np.float64]]
"""Signed distance-like values (n,) of points (n, 3), negative inside."""

CELL_CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
CELL_EDGES = [(a, b) for a in range(8) for b in range(a + 1, 8) if bin(a ^ b).count("1") == 1]
NEWTON_STEPS = 4
GRADIENT_STEP = 1e-3


@dataclass(frozen=True, slots=True)
class Grid:
    low: tuple[float, float, float]
    cell: float
    counts: tuple[int, int, int]
    """cells along x, y, z"""

    def points(self) -> Points:
        """Grid points (x, y, z, 3)."""
        axes = [low + self.cell * np.arange(n + 1) for low, n in zip(self.low, self.counts, strict=True)]
        return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)


def extract_surface(solid: Field, grid: Grid) -> tuple[Points, NDArray[np.int32]]:
    """Vertices (n, 3) and quads (m, 4), counter-clockwise seen from outside. The solid lies in the grid."""
    points = grid.points()
    values = solid(points.reshape(-1, 3)).reshape(points.shape[:3])
    cells, vertices = _cell_vertices(values, grid)
    numbers = np.full(grid.counts, -1, dtype=np.int32)
    numbers[tuple(cells.T)] = np.arange(len(cells), dtype=np.int32)
    quads = np.concatenate([_quads_along(values < 0.0, numbers, axis) for axis in range(3)])
    return _project(solid, vertices, grid.cell), quads


def _cell_vertices(values: np.ndarray, grid: Grid) -> tuple[np.ndarray, Points]:
    """Cells (n, 3) that the surface crosses and the mean of each one's edge crossings."""
    x, y, z = grid.counts
    corners = np.stack([values[i : i + x, j : j + y, k : k + z] for i, j, k in CELL_CORNERS], axis=-1)
    inside = corners < 0.0
    cells = np.argwhere(inside.any(axis=-1) & ~inside.all(axis=-1))
    at_corner = corners[tuple(cells.T)]
    total = np.zeros((len(cells), 3))
    crossings = np.zeros(len(cells))
    for a, b in CELL_EDGES:
        crossed = (at_corner[:, a] < 0.0) != (at_corner[:, b] < 0.0)
        span = np.where(crossed, at_corner[:, a] - at_corner[:, b], 1.0)
        share = (at_corner[:, a] / span)[:, None]
        where = CELL_CORNERS[a] + share * (CELL_CORNERS[b] - CELL_CORNERS[a])
        total += np.where(crossed[:, None], where, 0.0)
        crossings += crossed
    return cells, np.array(grid.low) + grid.cell * (cells + total / crossings[:, None])


def _quads_along(inside: np.ndarray, numbers: np.ndarray, axis: int) -> np.ndarray:
    """One quad for each grid edge along `axis` that the surface crosses."""
    inside = np.moveaxis(inside, axis, 0)
    numbers = np.moveaxis(numbers, axis, 0)
    start, end = inside[:-1, 1:-1, 1:-1], inside[1:, 1:-1, 1:-1]
    i, j, k = np.argwhere(start != end).T
    around = [numbers[i, j + dj, k + dk] for dj, dk in ((0, 0), (1, 0), (1, 1), (0, 1))]
    quads = np.stack(around, axis=1)
    # Moving the axis to the front mirrors the frame for y only.
    outward = start[i, j, k] ^ (axis == 1)
    return np.where(outward[:, None], quads, quads[:, ::-1])


def gradient(solid: Field, points: Points) -> Points:
    """Central differences (n, 3)."""
    steps = np.eye(3) * GRADIENT_STEP
    sides = [solid(points + step) - solid(points - step) for step in steps]
    return np.stack(sides, axis=-1) / (2.0 * GRADIENT_STEP)


def _project(solid: Field, points: Points, cell: float) -> Points:
    for _ in range(NEWTON_STEPS):
        slope = gradient(solid, points)
        square = np.maximum((slope**2).sum(axis=1), 1e-6)
        reach = np.clip(solid(points) / square, -0.25 * cell, 0.25 * cell)
        points = points - reach[:, None] * slope
    return points


def ellipsoid(points: Points, centre: Points, radii: Points) -> np.ndarray:
    """First-order distance to an axis-aligned ellipsoid."""
    offset = (points - centre) / radii
    length = np.sqrt((offset**2).sum(axis=1))
    slope = np.sqrt(((offset / radii) ** 2).sum(axis=1))
    return length * (length - 1.0) / np.maximum(slope, 1e-9)


def tapered_capsule(points: Points, ends: Points, radii: tuple[float, float]) -> np.ndarray:
    """Distance-like value of a capsule from ends[0] to ends[1] whose radius runs from one to the other."""
    axis = ends[1] - ends[0]
    offset = points - ends[0]
    share = np.clip(offset @ axis / (axis @ axis), 0.0, 1.0)
    distance = np.sqrt(((offset - share[:, None] * axis) ** 2).sum(axis=1))
    return distance - (radii[0] + share * (radii[1] - radii[0]))


def smooth_union(left: np.ndarray, right: np.ndarray, width: float) -> np.ndarray:
    """Minimum with a rounded seam about `width` wide."""
    overlap = np.maximum(width - np.abs(left - right), 0.0) / width
    return np.minimum(left, right) - overlap**2 * width / 4.0

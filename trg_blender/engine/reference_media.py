"""What surfaces enclose, in the reference renderer: it absorbs by Beer's law. Media that overlap add up."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .reference_surface import MaterialTable, Surface
from .scene_arrays import Float64

MOST_MEDIA = 4
"""Media that a path is told to be in at once."""
Stack = NDArray[np.int64]
"""(n, MOST_MEDIA) material rows, -1 where there is none"""


def no_media(count: int) -> Stack:
    return np.full((count, MOST_MEDIA), -1, dtype=np.int64)


def row_absorption(table: MaterialTable) -> Float64:
    """(rows, 3) per metre."""
    return np.stack([table.columns[f"absorption_{channel}"] for channel in "rgb"], axis=1)


def absorption_of(table: MaterialTable, media: Stack) -> Float64:
    """(n, 3) per metre, of all that each path is in."""
    per_row = np.vstack([row_absorption(table), np.zeros(3)])
    total: Float64 = per_row[media].sum(axis=1)
    return total


def light_left(absorption: Float64, way: Float64) -> Float64:
    """(n, 3) share of light left after `way` (n,), which may be infinite."""
    depth = np.where(absorption > 0.0, absorption, 0.0) * np.clip(way, 0.0, 1e30)[:, None]
    return np.exp(-depth)


def cross_surface(
    table: MaterialTable, media: Stack, row: NDArray[np.int64], enters: NDArray[np.bool_]
) -> Stack:
    """The stack beyond a surface of material `row` (n,), gone through to its inside or out of it."""
    after = media.copy()
    absorbs = np.any(row_absorption(table)[row] > 0.0, axis=1)
    waiting, leaving = absorbs & enters, absorbs & ~enters
    for place in range(MOST_MEDIA):
        free = waiting & (after[:, place] < 0)
        after[free, place] = row[free]
        waiting &= ~free
        gone = leaving & (after[:, place] == row)
        after[gone, place] = -1
        leaving &= ~gone
    return after


def find_beginnings(table: MaterialTable, media: Stack, surface: Surface) -> Stack:
    """Paths that met the inside of a medium which they never entered began there."""
    unknown = ~surface.outside & ~np.any(media == surface.row[:, None], axis=1)
    return np.where(unknown[:, None], cross_surface(table, media, surface.row, unknown), media)

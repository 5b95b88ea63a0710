"""What surfaces enclose, in the reference renderer: it absorbs by Beer's law.

Of media with priorities that overlap one rules (reference_nested.py), the others add up.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .reference_surface import MaterialTable, Surface
from .scene_arrays import Float64

MOST_MEDIA = 8
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
    plain = np.append(table.columns["priority"] <= 0.0, True)
    total: Float64 = (per_row * plain[:, None])[media].sum(axis=1)
    return total + (per_row * ~plain[:, None])[ruling_media(table, media)]


def ruling_media(table: MaterialTable, media: Stack) -> NDArray[np.int64]:
    """(n,) row of the medium that rules: of those with priorities the highest, of equal ones the last that
    was entered; -1 where none has one."""
    priority = np.append(table.columns["priority"], 0.0)[media]
    ruler, most = np.full(len(media), -1, dtype=np.int64), np.zeros(len(media))
    for place in range(media.shape[1]):
        better = (priority[:, place] > 0.0) & (priority[:, place] >= most)
        ruler = np.where(better, media[:, place], ruler)
        most = np.where(better, priority[:, place], most)
    return ruler


def light_left(absorption: Float64, way: Float64) -> Float64:
    """(n, 3) share of light left after `way` (n,), which may be infinite."""
    depth = np.where(absorption > 0.0, absorption, 0.0) * np.clip(way, 0.0, 1e30)[:, None]
    return np.exp(-depth)


def cross_surface(
    table: MaterialTable, media: Stack, row: NDArray[np.int64], enters: NDArray[np.bool_]
) -> Stack:
    """The stack beyond a surface of material `row` (n,), gone through to its inside or out of it."""
    after = media.copy()
    told = np.any(row_absorption(table)[row] > 0.0, axis=1) | (table.columns["priority"][row] > 0.0)
    count = (media >= 0).sum(axis=1)
    entered = np.flatnonzero(told & enters & (count < MOST_MEDIA))
    after[entered, count[entered]] = row[entered]
    # The last of its kind is left; those entered after it move up.
    same = (media == row[:, None]) & (told & ~enters)[:, None]
    left = np.flatnonzero(same.any(axis=1))
    after[left, MOST_MEDIA - 1 - np.argmax(same[left, ::-1], axis=1)] = -1
    order = np.argsort(after < 0, axis=1, kind="stable")
    return np.take_along_axis(after, order, axis=1)


def find_beginnings(table: MaterialTable, media: Stack, surface: Surface) -> Stack:
    """Paths that met the inside of a medium which they never entered began there."""
    unknown = ~surface.outside & ~np.any(media == surface.row[:, None], axis=1)
    return np.where(unknown[:, None], cross_surface(table, media, surface.row, unknown), media)

"""Surfaces that are only partly there, in the reference renderer: rays go straight on through the rest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .reference_scene import MISS, Hits, Rays, TracedScene, look_beyond
from .reference_surface import MaterialTable, build_surface
from .scene_arrays import Float64

MOST_SHEETS = 4096
"""After so many surfaces the next one counts as solid."""


def has_sheets(table: MaterialTable) -> bool:
    """Whether any material lets light straight through."""
    return bool(np.any((table.columns["alpha"] < 1.0) | (table.columns["alpha_texture"] >= 0)))


def sheet_values(table: MaterialTable, hits: Hits, direction: Float64) -> tuple[Float64, Float64]:
    """At hits that are no misses: how much is there (n,), and the colour (n, 3) of what passes."""
    material = build_surface(table, hits, -direction).material
    return material.column["present"], material.color("through")


@dataclass(frozen=True, slots=True)
class Straight:
    """Rays that may go straight through so many surfaces; the next counts as solid."""

    rays: Rays
    left: NDArray[np.int64]
    """(n,)"""


def straight(rays: Rays, left: NDArray[np.int64] | None) -> Straight:
    """`left` None: through as many as there are."""
    return Straight(rays, np.full(len(rays.far), MOST_SHEETS) if left is None else left)


def pass_sheets(
    traced: TracedScene, table: MaterialTable, way: Straight, hits: Hits, rng: np.random.Generator
) -> tuple[Hits, Float64, NDArray[np.int64]]:
    """Where rays are stopped in the end, by chance at each sheet, the colour (n, 3) they take on, and
    how many sheets (n,) they passed."""
    rays = way.rays
    tint, passed = np.ones((len(hits.t), 3)), np.zeros(len(hits.t), np.int64)
    open_rows = np.flatnonzero((hits.triangle != MISS) & (way.left > 0))
    for _ in range(MOST_SHEETS):
        if len(open_rows) == 0:
            break
        here = pick(hits, open_rows)
        alpha, through = sheet_values(table, here, rays.direction[open_rows])
        passes = rng.random(len(open_rows)) >= alpha
        open_rows = open_rows[passes]
        tint[open_rows] *= through[passes]
        passed[open_rows] += 1
        hits = look_beyond(traced.intersect, rays, hits, open_rows)
        stops = (hits.triangle[open_rows] == MISS) | (passed[open_rows] >= way.left[open_rows])
        open_rows = open_rows[~stops]
    return hits, tint, passed


def transmittance(traced: TracedScene, table: MaterialTable, way: Straight) -> Float64:
    """(n, 3) of the light along rays from start to far end; 0 behind something solid."""
    rays = way.rays
    light = np.ones((len(rays.far), 3))
    hits = traced.intersect(rays)
    rows = np.flatnonzero(hits.triangle != MISS)
    for sheet in range(MOST_SHEETS):
        spent = way.left[rows] <= sheet
        light[rows[spent]] = 0.0
        rows = rows[~spent]
        if len(rows) == 0:
            return light
        alpha, through = sheet_values(table, pick(hits, rows), rays.direction[rows])
        light[rows] *= (1.0 - alpha)[:, None] * through
        rows = rows[np.any(light[rows] > 0.0, axis=1)]
        hits = look_beyond(traced.intersect, rays, hits, rows)
        rows = rows[hits.triangle[rows] != MISS]
    light[rows] = 0.0
    return light


def pick(hits: Hits, rows: NDArray[np.int64]) -> Hits:
    return Hits(hits.triangle[rows], hits.t[rows], hits.u[rows], hits.v[rows])


def beyond(traced: TracedScene, rays: Rays, hits: Hits, rows: NDArray[np.int64]) -> Hits:
    """`hits` with those of `rows` replaced by what lies behind them; distances are from the rays' start."""
    return look_beyond(traced.intersect, rays, hits, rows)

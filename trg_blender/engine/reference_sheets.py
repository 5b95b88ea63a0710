"""Surfaces that are only partly there, in the reference renderer: rays go straight on through the rest."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .reference_scene import MISS, Hits, Rays, TracedScene
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


def pass_sheets(
    traced: TracedScene, table: MaterialTable, rays: Rays, hits: Hits, rng: np.random.Generator
) -> tuple[Hits, Float64]:
    """Where rays are stopped in the end, by chance at each sheet, and the colour (n, 3) they take on."""
    tint = np.ones((len(hits.t), 3))
    open_rows = np.flatnonzero(hits.triangle != MISS)
    for _ in range(MOST_SHEETS):
        if len(open_rows) == 0:
            break
        here = pick(hits, open_rows)
        alpha, through = sheet_values(table, here, rays.direction[open_rows])
        passes = rng.random(len(open_rows)) >= alpha
        open_rows = open_rows[passes]
        tint[open_rows] *= through[passes]
        hits = beyond(traced, rays, hits, open_rows)
        open_rows = open_rows[hits.triangle[open_rows] != MISS]
    return hits, tint


def transmittance(traced: TracedScene, table: MaterialTable, rays: Rays) -> Float64:
    """(n, 3) of the light along rays from start to far end; 0 behind something solid."""
    light = np.ones((len(rays.far), 3))
    hits = traced.intersect(rays)
    rows = np.flatnonzero(hits.triangle != MISS)
    for _ in range(MOST_SHEETS):
        if len(rows) == 0:
            return light
        alpha, through = sheet_values(table, pick(hits, rows), rays.direction[rows])
        light[rows] *= (1.0 - alpha)[:, None] * through
        rows = rows[np.any(light[rows] > 0.0, axis=1)]
        hits = beyond(traced, rays, hits, rows)
        rows = rows[hits.triangle[rows] != MISS]
    light[rows] = 0.0
    return light


def pick(hits: Hits, rows: NDArray[np.int64]) -> Hits:
    return Hits(hits.triangle[rows], hits.t[rows], hits.u[rows], hits.v[rows])


def beyond(traced: TracedScene, rays: Rays, hits: Hits, rows: NDArray[np.int64]) -> Hits:
    """`hits` with those of `rows` replaced by what lies behind them; distances are from the rays' start."""
    origin, direction = rays.origin[rows], rays.direction[rows]
    place = origin + hits.t[rows, None] * direction
    step = hits.t[rows] + 1e-6 + 4e-6 * np.abs(place).max(axis=1, initial=0.0)
    left = np.maximum(rays.far[rows] - step, 0.0)
    found = traced.intersect(Rays(origin + step[:, None] * direction, direction, left))
    parts = [part.copy() for part in (hits.triangle, hits.t, hits.u, hits.v)]
    for part, new in zip(parts, (found.triangle, found.t + step, found.u, found.v), strict=True):
        part[rows] = new
    return Hits(*parts)

"""Mixtures in the reference renderer: at every hit one row of the material scatters, by chance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .reference_points import Points
from .reference_surface import Material, MaterialTable, Surface, bent_normals, evaluate_material, textured
from .scene_arrays import Float64


def choose_closures(
    surface: Surface, table: MaterialTable, rng: np.random.Generator
) -> tuple[Surface, Float64]:
    """`surface` with one row of each mixture, drawn by its weight, in the place of the mixture, whose
    emission stays; and (n,) weight over the chance of that row, given that the surface is there."""
    whole = surface.material
    count = whole.column["mix_count"].astype(int)
    scale = np.ones(len(count))
    if not np.any(count > 0):
        return surface, scale
    chosen = surface.row.copy()
    for number in np.unique(surface.row[count > 0]):
        here = np.flatnonzero(surface.row == number)
        first = int(table.columns["mix_first"][number])
        rows = np.arange(first, first + int(table.columns["mix_count"][number]))
        weights = np.stack([row_weights(table, row, surface.points.take(here)) for row in rows], axis=1)
        total = weights.sum(axis=1)
        limits = np.cumsum(weights, axis=1)
        drawn = (rng.random(len(here))[:, None] * total[:, None] >= limits).sum(axis=1)
        chosen[here] = rows[np.minimum(drawn, len(rows) - 1)] if len(rows) else number
        present = whole.column["present"][here]
        scale[here] = total / np.where(present > 0.0, present, np.inf)
    material: Material = replace(evaluate_material(table, surface.points, chosen), emission=whole.emission)
    return replace(surface, material=material, ns=bent_normals(table, surface.points, chosen)), scale


def row_weights(table: MaterialTable, row: NDArray[np.int64], points: Points) -> Float64:
    """(n,) weight of one row at the points."""
    plain = np.full((len(points.b1), 3), table.columns["weight"][row])
    texture = np.full(len(points.b1), table.columns["weight_texture"][row])
    return np.maximum(textured(table, texture, points, plain)[:, 0], 0.0)

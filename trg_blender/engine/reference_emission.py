"""Glowing triangles as one light of the reference renderer: picked by area times emission."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .reference_lights import LightSample
from .reference_math import dot
from .reference_scene import Hits, Triangles
from .reference_surface import MaterialTable, build_points, evaluate_material, interpolate
from .scene_arrays import Float64


@dataclass(frozen=True, slots=True)
class Glow:
    """The triangles whose material has an emission colour."""

    index: NDArray[np.int64]
    """(k,) into Triangles"""
    cumulative: Float64
    """(k,) rising to 1"""
    density: Float64
    """(all triangles,) chance of picking a point of it, per square metre"""


def build_glow(triangles: Triangles, table: MaterialTable) -> Glow | None:
    """None when nothing glows."""
    column = table.columns
    power = (column["emission_r"] + column["emission_g"] + column["emission_b"])[
        triangles.material
    ] * triangles.area
    total = power.sum()
    if not total > 0.0:
        return None
    index = np.flatnonzero(power > 0.0)
    cumulative = np.cumsum(power[index]) / total
    return Glow(index, cumulative, power / total / np.maximum(triangles.area, 1e-300))


def sample_glow(
    glow: Glow, triangles: Triangles, table: MaterialTable, points: Float64, rng: np.random.Generator
) -> LightSample:
    """One point of a glowing triangle from each of `points`; both its sides shine."""
    count = len(points)
    pick = np.minimum(np.searchsorted(glow.cumulative, rng.random(count), side="right"), len(glow.index) - 1)
    index = glow.index[pick]
    root, second = np.sqrt(rng.random(count)), rng.random(count)
    u, v = root * (1.0 - second), root * second
    offset = interpolate(triangles.corners[index], u, v) - points
    distance = np.linalg.norm(offset, axis=1)
    wi = offset / np.maximum(distance, 1e-300)[:, None]
    pdf = pdf_glow(glow, triangles, index, wi, distance)
    hits = Hits(index, distance, u, v)
    material = evaluate_material(table, build_points(triangles, hits, -wi))
    shown = material.emission * material.column["present"][:, None]
    radiance = shown / np.where(pdf > 0.0, pdf, np.inf)[:, None]
    return LightSample(wi, distance, radiance, pdf, triangles.copy[index])


def pdf_glow(
    glow: Glow, triangles: Triangles, index: NDArray[np.int64], direction: Float64, distance: Float64
) -> Float64:
    """Density per steradian of the point of triangle `index` at `distance` along `direction`."""
    cosine = np.abs(dot(triangles.outside[index], direction))
    density = glow.density[index] * distance * distance
    return density / np.where(cosine > 1e-12, cosine, np.inf)

"""Directional albedo of GGX facets in the reference renderer, and how facets are scaled by it.

Single scattering loses the light that facets throw at each other. Each lobe is scaled so that nothing is
lost (Turquin 2019), coloured by the further meetings (Kulla and Conty 2017, section 3).
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .reference_fresnel import fresnel_dielectric
from .reference_ggx import IDEAL_ALPHA, smith_lambda, smith_shadowing, visible_normal
from .reference_math import dot
from .scene_arrays import Float64

NODES = np.linspace(0.0, 1.0, 64) ** 4
"""Cosines of the tables, dense where light grazes."""
ROOTS = np.linspace(0.0, 1.0, 64)
FINEST_STEP = 1.0 / 32.0
"""Roughness steps of tables for surfaces whose roughness varies."""
FEW = 12
"""Up to so many roughnesses are tabulated as they are."""


@dataclass(slots=True)
class EnergyTables:
    """Albedo by kind (facets, gloss, glass), index and roughness, made when first asked for."""

    _rows: dict[tuple[str, float, float], Float64] = field(default_factory=dict)

    def albedo(self, kind: str, eta: Float64, roughness: Float64, cosine: Float64) -> tuple[Float64, Float64]:
        """(n,) albedo at `cosine`, and its mean over the hemisphere weighted by the cosine.

        `facets` reflect everything, `gloss` by Fresnel's law, `glass` reflects and refracts.
        """
        at, mean = np.ones(len(cosine)), np.ones(len(cosine))
        for index in np.unique(eta):
            rows = eta == index
            values = np.unique(roughness[rows])
            if len(values) > FEW:
                low = np.floor(roughness[rows] / FINEST_STEP) * FINEST_STEP
                share = (roughness[rows] - low) / FINEST_STEP
                parts = [self._exact(kind, index, low + s * FINEST_STEP, cosine[rows]) for s in (0, 1)]
                at[rows], mean[rows] = (
                    one * (1.0 - share) + two * share for one, two in zip(*parts, strict=True)
                )
            else:
                at[rows], mean[rows] = self._exact(kind, index, roughness[rows], cosine[rows])
        return at, mean

    def _exact(self, kind: str, eta: float, roughness: Float64, cosine: Float64) -> tuple[Float64, Float64]:
        at, mean = np.ones(len(cosine)), np.ones(len(cosine))
        rounded = np.round(np.minimum(roughness, 1.0), 9)
        for value in np.unique(rounded):
            rows = rounded == value
            table = self._row(kind, float(eta), float(value))
            at[rows] = np.interp(cosine[rows] ** 0.25, ROOTS, table)
            # The mean of what is linear in the fourth root t of the cosine: weight 8 t^7.
            t = (np.arange(4000) + 0.5) / 4000.0
            mean[rows] = np.mean(8.0 * t**7 * np.interp(t, ROOTS, table))
        return at, mean

    def _row(self, kind: str, eta: float, roughness: float) -> Float64:
        key = (kind, eta, roughness)
        if key not in self._rows:
            self._rows[key] = tabulate(kind, eta, roughness * roughness)
        return self._rows[key]


def tabulate(kind: str, eta: float, alpha: float) -> Float64:
    """(len(NODES),) by Gauss and Legendre over the normals that are visible at each cosine."""
    cosine = np.maximum(NODES, 1e-6)
    if alpha < IDEAL_ALPHA:
        return fresnel_dielectric(cosine, np.asarray(eta)) if kind == "gloss" else np.ones(len(cosine))
    x, x_weight = (0.5 * part for part in np.polynomial.legendre.leggauss(28))
    y, y_weight = (0.5 * part for part in np.polynomial.legendre.leggauss(20))
    x, y = x + 0.5, y + 0.5
    # Short steps towards the rim, where facets turn away; the other half of the disc mirrors this one.
    square, turn = np.meshgrid(1.0 - x**3, 0.5 * y - 0.25, indexing="ij")
    weight = (3.0 * x**2 * x_weight)[:, None] * y_weight
    count = weight.size
    wo = np.stack([np.sqrt(1.0 - cosine**2), np.zeros(len(cosine)), cosine], axis=1).repeat(count, axis=0)
    facets = np.full(len(wo), alpha)
    m = visible_normal(wo, facets, np.tile(square.ravel(), len(cosine)), np.tile(turn.ravel(), len(cosine)))
    given = facet_albedo(kind, eta, wo, m, facets).reshape(len(cosine), count)
    return given @ weight.ravel()


def facet_albedo(kind: str, eta: float, wo: Float64, m: Float64, alpha: Float64) -> Float64:
    """(n,) share of the light on the facets `m` that leaves the surface."""
    c = np.clip(dot(wo, m), 0.0, 1.0)
    reflected = np.ones(len(c)) if kind == "facets" else fresnel_dielectric(c, np.asarray(eta))
    up = 2.0 * c[:, None] * m - wo
    seen = 1.0 + smith_lambda(wo, alpha)
    sum_ = np.where(up[:, 2] > 0.0, reflected * seen * smith_shadowing(wo, up, alpha), 0.0)
    if kind != "glass":
        return sum_
    bend = np.sqrt(np.maximum(0.0, 1.0 - (1.0 - c * c) / eta**2))
    down = -wo / eta + (c / eta - bend)[:, None] * m
    passed = np.where(down[:, 2] < 0.0, (1.0 - reflected) * seen * smith_shadowing(wo, down, alpha), 0.0)
    return sum_ + passed


def energy_factor(at: Float64, mean: Float64, reflectance: Float64) -> Float64:
    """(n, 3) scale of facets whose mean reflectance is `reflectance` (n, 3), held to 1."""
    lost = ((1.0 - at) / at)[:, None]
    held = np.minimum(reflectance, 1.0)
    again = held * mean[:, None] / (1.0 - held * (1.0 - mean[:, None]))
    return 1.0 + lost * again

"""Fresnel factors of the reference renderer, exact for unpolarised light, and their hemispherical mean."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .scene_arrays import Float64


def fresnel_dielectric(cosine: Float64, eta: Float64) -> Float64:
    """Reflected share at the angle of `cosine` >= 0; `eta` is index behind over index before.

    1 at total internal reflection (Walter et al. 2007, equation 22).
    """
    c = np.clip(cosine, 0.0, 1.0)
    g_squared = eta * eta - 1.0 + c * c
    g = np.sqrt(np.maximum(g_squared, 0.0))
    total = np.where(g + c > 0.0, g + c, 1.0)
    ratio = (g - c) / total
    inner = (c * (g + c) - 1.0) / (c * (g - c) + 1.0)
    return np.where(g_squared < 0.0, 1.0, 0.5 * ratio * ratio * (1.0 + inner * inner))


def f0_of_ior(ior: Float64) -> Float64:
    """Reflectance at normal incidence."""
    return ((ior - 1.0) / (ior + 1.0)) ** 2


def scaled_ior(ior: Float64, scale: Float64) -> Float64:
    """The index whose reflectance at normal incidence is `scale` times that of `ior`, 0.99 at most."""
    root = np.sqrt(np.minimum(f0_of_ior(ior) * scale, 0.99))
    scaled = (1.0 + root) / (1.0 - root)
    return np.where(scale == 1.0, ior, np.where(ior < 1.0, 1.0 / scaled, scaled))


def fresnel_shift(ior: Float64, tint: Float64) -> Float64:
    """(n, 3) `s` of the reflectance F + s (1 - F), which is F's curve from f0 * tint up to 1."""
    f0 = f0_of_ior(ior)[:, None]
    return (np.minimum(f0 * tint, 1.0) - f0) / (1.0 - f0)


def shifted(fresnel: Float64, shift: Float64) -> Float64:
    """(n, 3) F + s (1 - F)."""
    return fresnel[:, None] + shift * (1.0 - fresnel)[:, None]


@dataclass(frozen=True, slots=True)
class MetalFresnel:
    """Schlick (1994) with a coloured dip: F82-tint of Kutz, Hasan and Edmondson 2021.

    The reflectance at the cosine 1/7 is Schlick's times a tint. `grazing` (n,) is 1 where metal is white
    at grazing angles, 0 where it has the colour `f0` everywhere.
    """

    f0: Float64
    dip: Float64
    grazing: Float64

    def at(self, cosine: Float64) -> Float64:
        """(n, 3)"""
        c = np.clip(cosine, 0.0, 1.0)[:, None]
        rise = (1.0 - self.f0) * self.grazing[:, None] * (1.0 - c) ** 5
        return self.f0 + rise - self.dip * c * (1.0 - c) ** 6

    def mean(self) -> Float64:
        """(n, 3) mean over the hemisphere, weighted by the cosine."""
        return self.f0 + (1.0 - self.f0) * self.grazing[:, None] / 21.0 - self.dip / 126.0


def build_metal_fresnel(f0: Float64, tint: Float64, grazing: Float64) -> MetalFresnel:
    """From the colour at normal incidence (n, 3) and the tint at 82 degrees (n, 3)."""
    schlick = f0 + (1.0 - f0) * grazing[:, None] * (6.0 / 7.0) ** 5
    return MetalFresnel(f0, schlick * (1.0 - np.minimum(tint, 1.0)) * 7.0 * (7.0 / 6.0) ** 6, grazing)


def fresnel_mean(eta: Float64) -> Float64:
    """Cosine-weighted hemispherical mean 2 * integral of F(mu) mu dmu, by Gauss and Legendre.

    Below eta = 1 the integrand has a kink at the critical angle; the two sides are summed apart.
    """
    nodes, weights = np.polynomial.legendre.leggauss(32)
    eta = np.asarray(eta, dtype=np.float64)
    kink = np.sqrt(np.maximum(0.0, 1.0 - eta * eta))[:, None]
    mu = kink + (1.0 - kink) * 0.5 * (nodes + 1.0)
    above = np.sum(fresnel_dielectric(mu, eta[:, None]) * mu * weights, axis=1) * (1.0 - kink[:, 0])
    return above + kink[:, 0] ** 2

"""Fresnel factors of the reference renderer, exact for unpolarised light, and their hemispherical mean."""

from __future__ import annotations

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


def fresnel_schlick(cosine: Float64, f0: Float64) -> Float64:
    """(n, 3) Schlick's approximation from the colour at normal incidence, `f0` (n, 3)."""
    return f0 + (1.0 - f0) * ((1.0 - np.clip(cosine, 0.0, 1.0)) ** 5)[:, None]


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

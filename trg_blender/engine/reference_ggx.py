"""GGX microfacets of the reference renderer, in the frame of the shading normal (z up), wo.z > 0.

Distribution: Walter et al. 2007. Masking: height-correlated Smith (Heitz 2014). Sampling: visible
normals (Heitz 2018).
"""

from __future__ import annotations

import numpy as np

from .reference_math import dot, normalize
from .scene_arrays import Float64

IDEAL_ALPHA = 1e-3
"""GGX below it is an ideal mirror."""


def ggx_distribution(m: Float64, alpha: Float64) -> Float64:
    """Density of microfacet normals per steradian and projected area; 0 below the surface."""
    tail = m[:, 2] * m[:, 2] * (alpha * alpha - 1.0) + 1.0
    return np.where(m[:, 2] > 0.0, alpha * alpha / (np.pi * tail * tail), 0.0)


def smith_lambda(w: Float64, alpha: Float64) -> Float64:
    """Smith's Lambda of GGX for directions above or below the surface."""
    cosine_squared = np.maximum(w[:, 2] * w[:, 2], 1e-300)
    tangent_squared = np.maximum(0.0, 1.0 - cosine_squared) / cosine_squared
    return 0.5 * (np.sqrt(1.0 + alpha * alpha * tangent_squared) - 1.0)


def smith_shadowing(wo: Float64, wi: Float64, alpha: Float64) -> Float64:
    """Height-correlated masking and shadowing."""
    return 1.0 / (1.0 + smith_lambda(wo, alpha) + smith_lambda(wi, alpha))


def pdf_visible_normal(wo: Float64, m: Float64, alpha: Float64) -> Float64:
    """Density with which `sample_visible_normal` gives `m`."""
    masking = 1.0 / (1.0 + smith_lambda(wo, alpha))
    return masking * np.maximum(0.0, dot(wo, m)) * ggx_distribution(m, alpha) / wo[:, 2]


def sample_visible_normal(rng: np.random.Generator, wo: Float64, alpha: Float64) -> Float64:
    """Microfacet normals in proportion to their area seen from `wo`."""
    return visible_normal(wo, alpha, rng.random(len(wo)), rng.random(len(wo)))


def visible_normal(wo: Float64, alpha: Float64, square: Float64, turn: Float64) -> Float64:
    """The normal for two numbers in [0, 1): squared radius and turn on the disc seen from `wo`."""
    count = len(wo)
    # Stretch the view until the surface is a hemisphere.
    stretched = normalize(np.stack([alpha * wo[:, 0], alpha * wo[:, 1], wo[:, 2]], axis=1))
    # Frame around the stretched view.
    flat = np.hypot(stretched[:, 0], stretched[:, 1])
    safe = np.where(flat > 0.0, flat, 1.0)
    t1 = np.where(
        (flat > 0.0)[:, None],
        np.stack([-stretched[:, 1] / safe, stretched[:, 0] / safe, np.zeros(count)], axis=1),
        [[1.0, 0.0, 0.0]],
    )
    t2 = np.cross(stretched, t1)
    # A point on the visible half of the disc, then up to the hemisphere.
    radius, phi = np.sqrt(square), 2.0 * np.pi * turn
    p1, p2 = radius * np.cos(phi), radius * np.sin(phi)
    share = 0.5 * (1.0 + stretched[:, 2])
    p2 = (1.0 - share) * np.sqrt(np.maximum(0.0, 1.0 - p1 * p1)) + share * p2
    p3 = np.sqrt(np.maximum(0.0, 1.0 - p1 * p1 - p2 * p2))
    normal = p1[:, None] * t1 + p2[:, None] * t2 + p3[:, None] * stretched
    # Undo the stretch.
    return normalize(
        np.stack([alpha * normal[:, 0], alpha * normal[:, 1], np.maximum(1e-12, normal[:, 2])], axis=1)
    )

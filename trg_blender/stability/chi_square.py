"""Whether drawn directions follow their density: bins of microfacets, and a chi-square score."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..engine.scene_arrays import Material
from .lobes import evaluate

Floats = NDArray[Any]
RINGS, SECTORS, FINE = 32, 16, 12
"""Bins of the facet's slope, by arctangent of the root of its length and by azimuth; points along a side."""


def facet_bins(wo: Floats, wi: Floats, eta: float, alpha: float) -> Floats:
    """Number of the bin of the facet that sends `wo` to each of `wi`: reflections first."""
    up = wi[:, 2] > 0.0
    h = np.where(up[:, None], wo + wi, wo + eta * wi)
    h = h * np.sign(h[:, 2:])
    slope = np.hypot(h[:, 0], h[:, 1]) / np.maximum(h[:, 2], 1e-300)
    ring = np.minimum((np.arctan(np.sqrt(slope / alpha)) / (0.5 * np.pi) * RINGS).astype(int), RINGS - 1)
    turn = np.arctan2(h[:, 1], h[:, 0]) / (2.0 * np.pi) % 1.0
    return (np.where(up, 0, RINGS) + ring) * SECTORS + np.minimum((turn * SECTORS).astype(int), SECTORS - 1)


def expected_shares(material: Material, wo: Floats, outside: bool, eta: float, alpha: float) -> Floats:
    """(bins,) integral of the density over each bin of `facet_bins`."""
    wo = wo.astype(np.float64)
    ring = (np.arange(RINGS * FINE) + 0.5) / (RINGS * FINE) * 0.5 * np.pi
    turn = (np.arange(SECTORS * FINE) + 0.5) / (SECTORS * FINE) * 2.0 * np.pi
    ring, turn = np.meshgrid(ring, turn, indexing="ij")
    slope = alpha * np.tan(ring) ** 2
    h = np.stack([slope * np.cos(turn), slope * np.sin(turn), np.ones_like(slope)], axis=-1)
    h = (h / np.sqrt(1.0 + slope * slope)[..., None]).reshape(-1, 3)
    # Solid angle of facets a grid cell, from the measure of slopes and of the rings.
    cell = (slope * alpha * 2.0 * np.tan(ring) / np.cos(ring) ** 2).ravel() * h[:, 2] ** 3
    cell *= 0.5 * np.pi / (RINGS * FINE) * 2.0 * np.pi / (SECTORS * FINE)
    c = h @ wo
    bend = np.sqrt(np.maximum(0.0, 1.0 - (1.0 - c * c) / eta**2))
    ways = [
        (2.0 * c[:, None] * h - wo, 1.0, 4.0 * np.abs(c)),
        (
            (c / eta - bend)[:, None] * h - wo / eta,
            -1.0,
            (c - eta * bend) ** 2 / (eta**2 * np.maximum(bend, 1e-9)),
        ),
    ]
    shares = []
    for wi, side, jacobian in ways:
        there = (c > 0.0) & (side * wi[:, 2] > 0.0) & ((side > 0.0) | (bend > 0.0))
        _, pdf = evaluate(material, wo, wi, outside)
        mass = np.where(there, pdf * jacobian * cell, 0.0).reshape(RINGS, FINE, SECTORS, FINE)
        shares.append(mass.sum(axis=(1, 3)).ravel())
    return np.concatenate(shares)


def chi_square_score(found: Floats, expected: Floats) -> float:
    """Standard normal score of a chi-square statistic (Wilson and Hilferty 1931), small bins pooled."""
    order = np.argsort(expected)
    cumulative = np.cumsum(expected[order])
    group = np.minimum((cumulative / 25.0).astype(int), 10**6)
    keys = np.unique(group, return_inverse=True)[1]
    e, o = np.bincount(keys, expected[order]), np.bincount(keys, found[order])
    kept = e > 5.0
    e, o = e[kept], o[kept]
    degrees = max(len(e) - 1, 1)
    ratio = float(((o - e) ** 2 / e).sum()) / degrees
    return (ratio ** (1 / 3) - (1 - 2 / (9 * degrees))) / np.sqrt(2 / (9 * degrees))

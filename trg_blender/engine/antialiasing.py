"""The paper's ways of choosing points of a pixel: names, how many samples they are, what they can tell."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .scene_arrays import Float64, RenderSettings

ANTIALIASINGS = ("sobol", "none", "supersampling", "jittering", "mfaa")
"""sobol: Owen-scrambled points through the reconstruction filter; the others are docs/decisions/classic.md"""
FINEST_GRID = 64
"""cells along a pixel's side, at most"""
NO_RANDOMNESS = "no randomness: the error of aliasing is not estimated"


def is_deterministic(settings: RenderSettings) -> bool:
    """Whether every replicate would draw the same, so that their spread tells nothing."""
    return settings.integrator == "classic" and settings.aa in ("none", "supersampling", "mfaa")


def pattern_size(settings: RenderSettings) -> int:
    """How many places of a pixel the method has in one frame; 0 where they are random."""
    side = settings.aa_side
    even = side + side % 2
    return {"none": 1, "supersampling": side * side, "mfaa": even * even // 2}.get(settings.aa, 0)


def with_pattern_samples(settings: RenderSettings) -> RenderSettings:
    """Where nothing is random, as many samples as the pattern has places; more would repeat them."""
    if not is_deterministic(settings):
        return settings
    return replace(settings, samples=pattern_size(settings), rmse=0.0, adaptive=False)


def pattern_places(settings: RenderSettings) -> Float64:
    """(n, 2) places in the unit square of the pixel, in the order of samples, of a deterministic method."""
    side = settings.aa_side
    if settings.aa == "none":
        return np.array([[0.5, 0.5]])
    if settings.aa == "supersampling":
        rows, columns = np.divmod(np.arange(side * side), side)
    else:
        side += side % 2
        rows, halves = np.divmod(np.arange(side * side // 2), side // 2)
        columns = 2 * halves + (rows + settings.frame) % 2
    places: Float64 = (np.stack([columns, rows], axis=1) + 0.5) / side
    return places


def random_places(settings: RenderSettings, count: int, rng: np.random.Generator) -> Float64:
    """(count, 2) places of samples that have random numbers of their own, evenly distributed."""
    even: Float64 = rng.random((count, 2))
    if settings.aa == "sobol":
        return even
    if settings.aa == "jittering":
        side = settings.aa_side
        cell = rng.integers(0, side * side, count)
        jittered: Float64 = (np.stack([cell % side, cell // side], axis=1) + even) / side
        return jittered
    places = pattern_places(settings)
    chosen: Float64 = places[rng.integers(0, len(places), count)]
    return chosen

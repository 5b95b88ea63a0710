"""The error measure: right on synthetic replicates, and its interval covers what it says."""

from __future__ import annotations

import math

import numpy as np
import pytest

from trg_blender.engine.image_error import estimate_error, measure_error, relmse, rmse
from trg_blender.engine.pixel_error import pooled

SIGMA = 0.5


def replicate_sums(rng: np.random.Generator, counts: np.ndarray, size: int) -> np.ndarray:
    """Sums of normal samples of mean 1 and spread SIGMA, pixel by pixel."""
    noise = rng.normal(size=(len(counts), size, size, 3))
    return counts[:, None, None, None] + SIGMA * np.sqrt(counts)[:, None, None, None] * noise


@pytest.mark.parametrize("size", [1, 4, 16])
def test_the_interval_covers_the_error_of_the_picture_95_times_in_a_hundred(size: int):
    """600 pictures; binomial spread is 0.9 %."""
    rng = np.random.default_rng(size)
    counts = np.full(8, 16)
    covered = 0
    for _ in range(600):
        sums = replicate_sums(rng, counts, size)
        low, high = estimate_error(measure_error(sums, counts)).ci95
        picture = sums.sum(axis=0) / counts.sum()
        covered += low <= rmse(picture, np.ones_like(picture)) <= high
    assert 0.93 <= covered / 600 <= 0.99


def test_the_mse_is_unbiased_for_uneven_replicates():
    rng = np.random.default_rng(7)
    counts = np.array([5, 5, 5, 4, 4, 4, 4, 4])
    found = [measure_error(replicate_sums(rng, counts, 8), counts)["mse"] for _ in range(200)]
    assert np.mean(found) == pytest.approx(SIGMA**2 / counts.sum(), rel=0.02)


def test_the_claimed_error_is_the_one_against_the_truth():
    rng = np.random.default_rng(8)
    counts = np.full(8, 4)
    sums = replicate_sums(rng, counts, 64)
    error = estimate_error(measure_error(sums, counts))
    picture = sums.sum(axis=0) / counts.sum()
    assert error.rmse == pytest.approx(rmse(picture, np.ones_like(picture)), rel=0.05)
    assert error.relmse == pytest.approx(relmse(picture, np.ones_like(picture)), rel=0.1)


@pytest.mark.parametrize(
    ("used", "has_rmse", "has_interval"),
    [(0, False, False), (1, False, False), (2, True, False), (3, True, True)],
)
def test_too_few_replicates_say_so(used: int, has_rmse: bool, has_interval: bool):
    counts = np.array([3] * used + [0] * (8 - used))
    sums = np.random.default_rng(1).random((8, 4, 4, 3)) * (counts > 0)[:, None, None, None]
    material = measure_error(sums, counts)
    error = estimate_error(material)
    assert material["replicates"] == used
    assert (error.rmse is not None) == has_rmse
    assert (error.ci95 is not None) == has_interval


def test_a_picture_without_noise_has_no_error():
    counts = np.full(8, 2)
    error = estimate_error(measure_error(np.full((8, 3, 3, 3), 2.0), counts))
    assert error.rmse == 0.0
    assert error.ci95 == (0.0, 0.0)


def test_noise_in_one_replicate_alone_gives_a_wide_interval():
    """A rare bright path: nobody knows how often it comes."""
    sums = np.ones((8, 4, 4, 3))
    sums[3, 2, 2] = 1000.0
    error = estimate_error(measure_error(sums, np.ones(8, dtype=int)))
    low, high = error.ci95
    assert low < 0.05 * error.rmse
    assert high > 20.0 * error.rmse
    assert math.isfinite(high)


@pytest.mark.parametrize("shape", [(1, 1), (2, 2), (1, 7), (3, 40)])
def test_pixels_are_pooled_within_any_film(shape: tuple[int, int]):
    values = np.arange(float(shape[0] * shape[1])).reshape(shape)
    found = pooled(values, 4)
    for y, x in np.ndindex(*shape):
        around = values[max(y - 4, 0) : y + 5, max(x - 4, 0) : x + 5]
        assert found[y, x] == pytest.approx(around.mean())

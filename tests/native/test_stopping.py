"""Stops by time and by error: met, honest, repeatable, and without bias."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from trg_blender.engine.image_error import estimate_error
from trg_blender.engine.pixel_error import measure_pixel_error

from .render_scenes import trg_native  # noqa: F401 (skips without the native core)
from .test_render_job import mixed_scene

WIDTH, HEIGHT = 40, 24
ENDLESS = 1 << 20


def run(
    scene: Any, seed: int, samples: int = ENDLESS, size: tuple[int, int] = (WIDTH, HEIGHT), **limits: Any
) -> Any:
    job = scene.start_render(*size, samples, seed, 4, limits.pop("threads", 2), (), None, **limits)
    while not job.poll(1.0)["done"]:
        pass
    return job


def picture_of(job: Any, size: tuple[int, int] = (WIDTH, HEIGHT)) -> np.ndarray:
    out = np.zeros((size[1], size[0], 4), np.float32)
    job.combined(out)
    return out[..., :3].astype(np.float64)


@pytest.fixture(scope="module")
def scene() -> Any:
    return mixed_scene()


@pytest.fixture(scope="module")
def truth(scene: Any) -> Any:
    return run(scene, 4242, 4096)


@pytest.mark.parametrize("adaptive", [False, True])
def test_the_error_asked_for_is_met(scene: Any, truth: Any, adaptive: bool) -> None:
    job = run(scene, 1, rmse=0.02, adaptive=adaptive)
    state, error = job.poll(0.0), estimate_error(job.error())
    assert state["stopped_by"] == "error"
    assert not state["cancelled"]
    # What is left of each half stands at the rule's own estimate from the other half: near the target.
    assert error.rmse == pytest.approx(0.02, rel=0.3)
    assert error.ci95 is not None
    assert error.ci95[0] < error.rmse < error.ci95[1]
    assert math.sqrt(np.mean((picture_of(job) - picture_of(truth)) ** 2)) == pytest.approx(
        error.rmse, rel=0.3
    )


def test_adaptive_sampling_needs_fewer_samples(scene: Any) -> None:
    even, uneven = (run(scene, 3, rmse=0.01, adaptive=adaptive).poll(0.0) for adaptive in (False, True))
    assert uneven["samples"] < 0.9 * even["samples"]


@pytest.mark.parametrize("adaptive", [False, True])
def test_any_number_of_threads_stops_at_the_same_bits(scene: Any, adaptive: bool) -> None:
    jobs = [run(scene, 5, rmse=0.03, adaptive=adaptive, threads=threads) for threads in (1, 3)]
    pictures = [picture_of(job) for job in jobs]
    assert np.array_equal(*pictures)


def test_samples_stop_first_when_they_are_fewer(scene: Any) -> None:
    job = run(scene, 1, 64, rmse=1e-6, adaptive=True)
    assert job.poll(0.0)["stopped_by"] == "samples"
    assert job.poll(0.0)["samples"] == 64


@pytest.mark.parametrize("adaptive", [False, True])
def test_time_stops_an_endless_render(scene: Any, adaptive: bool) -> None:
    state = run(scene, 1, seconds=0.2, adaptive=adaptive).poll(0.0)
    assert state["stopped_by"] == "time"
    assert state["samples"] >= 1


def test_a_picture_without_noise_is_not_believed_at_once() -> None:
    from .render_scenes import Camera, new_scene

    dark = new_scene([], world=0.5)
    Camera().apply(dark)
    dark.build(1)
    job = run(dark, 1, rmse=0.01, adaptive=True)
    assert job.poll(0.0)["stopped_by"] == "error"
    assert job.poll(0.0)["samples"] >= 512


@pytest.mark.parametrize("adaptive", [False, True])
def test_stopping_by_error_leaves_no_bias(scene: Any, adaptive: bool) -> None:
    """The mean of 500 renders that stop early, by tile and as a whole, is the picture."""
    size = (16, 12)
    truth_job = run(scene, 4242, 16384, size)
    truth = picture_of(truth_job, size)
    truth_rmse = estimate_error(truth_job.error()).rmse
    stopped = np.stack(
        [picture_of(run(scene, seed, size=size, rmse=0.12, adaptive=adaptive), size) for seed in range(500)]
    )
    means = stopped.mean(axis=(1, 2, 3))
    standard_error = means.std(ddof=1) / math.sqrt(len(means))
    assert abs(means.mean() - truth.mean()) < 3.0 * math.hypot(standard_error, truth_rmse / 24.0)
    z = (stopped.mean(axis=0) - truth) / np.hypot(stopped.std(axis=0, ddof=1) / math.sqrt(500), truth_rmse)
    assert np.mean(z**2) < 1.5


def test_pixel_errors_are_those_of_the_reference_formula(scene: Any) -> None:
    job = run(scene, 2, 64)
    sums, counts = np.zeros((8, HEIGHT, WIDTH, 3)), np.zeros(8, np.int64)
    job.replicates(sums, counts)
    found = np.zeros((HEIGHT, WIDTH), np.float32), np.zeros((HEIGHT, WIDTH), np.uint8)
    wanted = np.zeros((HEIGHT, WIDTH), np.float32), np.zeros((HEIGHT, WIDTH), np.uint8)
    evidence = job.pixel_error(*found)
    assert evidence == pytest.approx(measure_pixel_error(sums, counts, *wanted), rel=1e-9)
    assert found[0] == pytest.approx(wanted[0], rel=1e-5)
    assert np.array_equal(found[1], wanted[1])


def test_replicates_of_halves_give_the_picture(scene: Any) -> None:
    job = run(scene, 6, rmse=0.02, adaptive=True)
    sums, counts = np.zeros((8, HEIGHT, WIDTH, 3)), np.zeros(8, np.int64)
    job.replicates(sums, counts)
    assert (counts == counts[0]).all()
    assert sums.sum(axis=0) / counts.sum() == pytest.approx(picture_of(job), rel=1e-6)


@pytest.mark.parametrize(
    "limit", [{"seconds": -1.0}, {"seconds": math.nan}, {"rmse": -0.1}, {"rmse": math.inf}]
)
def test_impossible_limits_are_refused(scene: Any, limit: dict[str, float]) -> None:
    with pytest.raises(ValueError, match=next(iter(limit))):
        scene.start_render(8, 8, 8, **limit)

"""The paper's antialiasing: where samples lie, and what that does to edges."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from trg_blender.engine.image_error import rmse
from trg_blender.engine.mfaa import SampledFrame, blend_frames
from trg_blender.engine.scene_arrays import RenderSettings, SceneArrays
from trg_blender.engine.session import SceneError, render, start

from .arrays import look_at
from .classic_scenes import stripes

pytest.importorskip("trg_native", reason="the native core is not built here")

SIZE = 48
CLASSIC = RenderSettings(SIZE, SIZE, samples=1, integrator="classic", aa="supersampling", aa_side=24)


@pytest.fixture(scope="module")
def truth() -> np.ndarray:
    return render(stripes(), CLASSIC).pixels.astype(np.float64)


def error_of(truth: np.ndarray, **settings) -> float:
    return rmse(render(stripes(), replace(CLASSIC, **settings)).pixels, truth)


def test_a_finer_grid_has_less_error(truth: np.ndarray):
    one, two, four = (error_of(truth, aa_side=side) for side in (1, 2, 4))
    assert error_of(truth, aa="none") == one
    assert one > 1.5 * two > 2.0 * four


def test_jittering_puts_one_sample_into_each_cell(truth: np.ndarray):
    samples = 8 * 16
    strata = render(stripes(), replace(CLASSIC, aa="jittering", aa_side=4, samples=samples)).pixels[..., 0]
    covered = truth[..., 0]
    independent = np.sqrt(np.mean(covered * (1.0 - covered) / samples))
    assert rmse(strata, covered) < 0.7 * independent


def test_the_error_of_jittering_is_estimated_from_its_replicates(truth: np.ndarray):
    result = render(stripes(), replace(CLASSIC, aa="jittering", aa_side=2, samples=32))
    low, high = result.report["error"]["ci95"]
    assert low < rmse(result.pixels[..., :3], truth[..., :3]) < high
    means = result.replicate_sums / result.replicate_counts[:, None, None, None]
    assert all(np.any(means[0] != mean) for mean in means[1:])


@pytest.mark.parametrize("aa", ["none", "supersampling", "jittering", "mfaa", "sobol"])
def test_every_method_serves_the_path_integrator(aa: str, truth: np.ndarray):
    settings = replace(CLASSIC, integrator="path", aa=aa, aa_side=2, samples=64)
    result = render(stripes(), settings)
    assert result.report["samples"] == 64
    limit = 0.2 if aa == "none" else 0.12
    assert rmse(result.pixels, truth) < limit


def test_the_middle_of_the_pixel_alone_makes_stairs():
    pixels = render(stripes(), replace(CLASSIC, integrator="path", aa="none", samples=16)).pixels[..., 0]
    assert np.isin(pixels, [0.0, 1.0]).all()


def frame_of(scene: SceneArrays, number: int) -> SampledFrame:
    job = start(scene, replace(CLASSIC, aa="mfaa", aa_side=2, frame=number))
    job.result()
    frame = job.sampled_frame()
    assert frame is not None
    return frame


def seen_from(x: float) -> SceneArrays:
    scene = stripes()
    scene.camera = look_at((0.2 + x, -2.0, 4.0), (x, 0, 0), 0.5)
    return scene


def test_two_frames_of_a_camera_at_rest_make_the_whole_grid():
    both, reused = blend_frames(frame_of(stripes(), 8), frame_of(stripes(), 7))
    whole = render(stripes(), replace(CLASSIC, aa_side=2)).pixels
    assert reused > 0.9 * SIZE * SIZE
    # Where what is near has another range than the frame before, that one is held back.
    assert (np.abs(both - whole).max(axis=-1) < 1e-5).mean() > 0.8
    assert rmse(both, whole) < 0.5 * rmse(frame_of(stripes(), 8).pixels, whole)


@pytest.mark.parametrize("step", [0.013, 0.05, 0.11])
def test_a_moving_camera_gains_from_the_frame_before(step: float):
    now, before = frame_of(seen_from(step), 2), frame_of(seen_from(0.0), 1)
    both, _ = blend_frames(now, before)
    truth = render(seen_from(step), CLASSIC).pixels
    assert rmse(both, truth) < 0.9 * rmse(now.pixels, truth)


def test_a_frame_that_cannot_be_carried_over_is_left_out():
    now = frame_of(stripes(), 5)
    for other in (None, replace(now, number=9), replace(now, number=4, pixels=now.pixels[:8])):
        pixels, reused = blend_frames(now, other)
        assert reused == 0
        assert np.array_equal(pixels, now.pixels)


@pytest.mark.parametrize(("name", "value"), [("aa", "fxaa"), ("aa_side", 0), ("aa_side", 65)])
def test_what_is_no_antialiasing_is_refused(name: str, value: object):
    with pytest.raises(SceneError):
        render(stripes(), replace(CLASSIC, **{name: value}))

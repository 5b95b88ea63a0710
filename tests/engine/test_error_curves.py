"""Error curves: fits of known laws, and points measured against a reference."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from trg_blender.engine.devices import find_device
from trg_blender.engine.error_curves import (
    CurvePoint,
    Variant,
    fit_curve,
    held_share,
    make_reference,
    measure_curve,
)
from trg_blender.engine.scene_arrays import Material, RenderSettings

from .arrays import floor_scene, light

SETTINGS = RenderSettings(16, 12, samples=1 << 20, max_bounces=2)


def point(seconds: float, measured: float, low: float | None = None, high: float | None = None) -> CurvePoint:
    return CurvePoint(Variant(), 1, seconds, 1.0, measured, measured, low, high)


def test_a_power_law_is_found() -> None:
    fit = fit_curve([point(t, 0.3 * t**-0.5) for t in (0.5, 1.0, 2.0, 4.0)])
    assert fit is not None
    assert fit.slope == pytest.approx(-0.5)
    assert fit.slope_error == pytest.approx(0.0, abs=1e-9)
    assert fit.at_one == pytest.approx(0.3)
    assert fit.seconds_to(0.03) == pytest.approx(100.0)


def test_the_slope_s_interval_holds_the_law_nineteen_times_in_twenty() -> None:
    rng = np.random.default_rng(4)
    held = 0
    for _ in range(400):
        noise = np.exp(0.1 * rng.normal(size=5))
        fit = fit_curve([point(2.0**k, 2.0 ** (-0.5 * k) * noise[k]) for k in range(5)])
        assert fit is not None
        held += abs(fit.slope + 0.5) <= fit.slope_error
    assert 0.92 <= held / 400 <= 0.98


def test_an_error_that_does_not_fall_never_gets_there() -> None:
    fit = fit_curve([point(t, 0.1) for t in (1.0, 2.0, 4.0)])
    assert fit is not None
    assert fit.seconds_to(0.01) == math.inf


@pytest.mark.parametrize("points", [[], [point(1, 1), point(2, 1)], [point(1, 0.0)] * 5, [point(1, 1)] * 5])
def test_too_few_points_have_no_fit(points: list[CurvePoint]) -> None:
    assert fit_curve(points) is None


def test_the_share_of_intervals_that_hold() -> None:
    assert held_share([point(1, 1.0)]) is None
    assert held_share([point(1, 1.0, 0.9, 1.1), point(1, 1.0, 1.1, 1.2), point(1, 1.0)]) == 0.5


def test_points_come_at_their_times_with_the_error_they_have() -> None:
    if find_device("cpu").reason is not None:
        pytest.skip(find_device("cpu").reason)
    scene = floor_scene(
        Material(0.6, 0.6, 0.6),
        light(
            "area_rectangle",
            (5, 5, 5),
            (0, 0, 1),
            direction=(0, 0, -1),
            axis_u=(0.5, 0, 0),
            axis_v=(0, 0.5, 0),
        ),
    )
    truth = make_reference(scene, SETTINGS, 4096)
    times = [0.05, 0.1, 0.2]
    points = list(measure_curve(scene, SETTINGS, times, truth, Variant(accel="grid")))
    assert [p.seconds > t for p, t in zip(points, times, strict=True)] == [True] * 3
    assert points[-1].samples > points[0].samples
    assert all(p.stated is not None and p.measured == pytest.approx(p.stated, rel=0.5) for p in points[1:])
    short = list(measure_curve(scene, replace(SETTINGS, samples=8), [5.0, 10.0], truth, Variant()))
    assert len(short) == 1
    assert short[0].samples == 8

"""The picture of error against time that the Render panel draws."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from trg_blender.engine.curve_picture import BAND, GLYPHS, LINE, SIDE, TARGET, Axis, draw_curve


def look(seconds: float, rmse: float | None, width: float = 1.2) -> dict[str, Any]:
    interval = None if rmse is None else [rmse / width, rmse * width]
    return {"samples": 8.0, "seconds": seconds, "rmse": rmse, "ci95": interval}


HISTORY = [look(0.1 * 2**k, 0.2 / 2 ** (0.5 * k)) for k in range(8)]


def places_of(picture: Any, color: tuple[float, ...]) -> Any:
    """(n, 2) rows and columns of the pixels of that colour."""
    return np.argwhere(np.all(picture == np.array(color, np.float32), axis=-1))


def test_an_error_that_falls_with_the_root_of_time_is_a_straight_falling_line() -> None:
    picture = draw_curve(HISTORY, None)
    assert picture is not None
    assert picture.shape == (SIDE, SIDE, 4)
    rows, columns = places_of(picture, LINE).T
    slope, start = np.polyfit(columns, rows, 1)
    assert slope < 0.0
    assert np.abs(rows - (slope * columns + start)).max() < 5.0


def test_the_band_lies_around_the_line_and_widens_with_the_interval() -> None:
    narrow = draw_curve([look(0.1, 0.2, 1.05), look(1.0, 0.02, 1.05)], None)
    wide = draw_curve([look(0.1, 0.2, 2.0), look(1.0, 0.02, 2.0)], None)
    assert narrow is not None
    assert wide is not None
    assert len(places_of(wide, BAND)) > 2 * len(places_of(narrow, BAND)) > 0


def test_the_target_is_a_dashed_line_at_its_height() -> None:
    picture = draw_curve(HISTORY, 0.01)
    assert picture is not None
    dashes, line = places_of(picture, TARGET), places_of(picture, LINE)
    assert len(np.unique(dashes[:, 0])) <= 2
    assert dashes[:, 0].max() < line[:, 0].min()
    assert len(places_of(draw_curve(HISTORY, None), TARGET)) == 0


@pytest.mark.parametrize(
    "history",
    [
        [look(0.1, 0.3)],
        [look(0.1, 0.3), look(0.1, 0.3)],
        [look(1e-4, 1e-9), look(3e5, 1e-9)],
        [look(0.1, 1e9, 1e6), look(0.2, 1e-11, 1e6)],
        [look(0.1, None), look(0.2, 0.5)],
        [{**look(0.1, 0.3), "ci95": None}],
    ],
)
def test_odd_histories_are_drawn(history: list[dict[str, Any]]) -> None:
    picture = draw_curve(history, 1e-6)
    assert picture is not None
    assert np.isfinite(picture).all()
    assert len(places_of(picture, LINE)) > 0


@pytest.mark.parametrize("history", [[], [look(0.1, None)], [look(0.1, 0.0)], [look(0.0, 0.1)]])
def test_without_a_known_error_there_is_no_curve(history: list[dict[str, Any]]) -> None:
    assert draw_curve(history, 0.1) is None


@pytest.mark.parametrize(
    ("low", "high"), [(1e-7, 1e7), (0.25, 0.375), (0.031, 0.039), (1.1, 1.8), (0.99, 1.01)]
)
def test_axes_have_figures_that_can_be_written(low: float, high: float) -> None:
    ticks = Axis(low, high, 0, 100).ticks()
    assert ticks
    assert all(low <= tick <= high for tick in ticks)
    assert all(letter in GLYPHS for tick in ticks for letter in f"{tick:g}s")

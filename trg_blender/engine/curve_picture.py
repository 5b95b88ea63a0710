"""The last render's error against its seconds as a picture: both axes logarithmic, drawn with numpy alone."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .scene_arrays import Float32, Float64

SIDE = 320
LEFT, BOTTOM, EDGE = 52, 22, 8
"""pixels beside the plot: for labels, and at the other sides"""
GROUND, GRID, INK = (0.04, 0.04, 0.05, 1.0), (0.16, 0.16, 0.18, 1.0), (0.75, 0.75, 0.75, 1.0)
BAND, LINE, TARGET = (0.10, 0.22, 0.38, 1.0), (0.35, 0.70, 1.0, 1.0), (1.0, 0.55, 0.15, 1.0)
LETTER_SCALE = 2
GLYPHS = {
    "0": "111101101101111",
    "1": "010110010010111",
    "2": "111001111100111",
    "3": "111001111001111",
    "4": "101101111001001",
    "5": "111100111001111",
    "6": "111100111101111",
    "7": "111001010010010",
    "8": "111101111101111",
    "9": "111101111001111",
    ".": "000000000000010",
    "-": "000000111000000",
    "+": "000010111010000",
    "e": "000111111100111",
    "s": "011100010001110",
}
"""three by five dots, from the top"""


@dataclass(frozen=True, slots=True)
class Looks:
    """The known errors of a render, (n,) each, seconds rising."""

    seconds: Float64
    rmse: Float64
    low: Float64
    high: Float64


@dataclass(frozen=True, slots=True)
class Axis:
    """Values from `low` to `high`, logarithmic, on pixels from `first` to `last`."""

    low: float
    high: float
    first: int
    last: int

    def place(self, values: Any) -> Any:
        share = (np.log(values) - math.log(self.low)) / (math.log(self.high) - math.log(self.low))
        return self.first + share * (self.last - self.first)

    def ticks(self) -> list[float]:
        """Powers of ten; where there are less than two, their double and fivefold too, or all multiples."""
        powers = range(math.floor(math.log10(self.low)), math.ceil(math.log10(self.high)) + 1)
        tens = [10.0**power for power in powers if self.low <= 10.0**power <= self.high]
        if len(tens) >= 2:
            return tens
        for digits in ((1, 2, 5), range(1, 10)):
            steps = [digit * 10.0**power for power in powers for digit in digits]
            found = [step for step in steps if self.low <= step <= self.high]
            if found:
                return found
        return [float(f"{math.sqrt(self.low * self.high):.2g}")]


def draw_curve(history: Sequence[dict[str, Any]], target: float | None) -> Float32 | None:
    """(320, 320, 4) sRGB with alpha, row 0 at the bottom: a line through the errors of a report's `history`,
    their 95 % intervals as a band, the target as a dashed line. None without a known error above 0.
    """
    looks = known_looks(history)
    if looks is None:
        return None
    values = np.concatenate([looks.low, looks.high, [target] if target else []])
    across = axis_of(looks.seconds, LEFT, SIDE - EDGE)
    up = axis_of(values, BOTTOM, SIDE - EDGE)
    picture = np.empty((SIDE, SIDE, 4), np.float32)
    picture[...] = GROUND
    draw_band(picture, looks, across, up)
    draw_grid(picture, across, up)
    if target:
        row = round(float(up.place(target)))
        picture[row - 1 : row + 1, [x for x in range(LEFT, SIDE - EDGE) if x % 10 < 6]] = TARGET
    draw_line(picture, looks, across, up)
    return picture


def known_looks(history: Sequence[dict[str, Any]]) -> Looks | None:
    rows = [
        (look["seconds"], look["rmse"], *(look["ci95"] or (look["rmse"], look["rmse"])))
        for look in history
        if look["rmse"] and look["seconds"] > 0.0
    ]
    if not rows:
        return None
    table = np.array(sorted(rows), dtype=np.float64)
    table[:, 1:] = np.maximum(table[:, 1:], 1e-12)
    return Looks(*table.T)


def axis_of(values: Float64, first: int, last: int) -> Axis:
    """Somewhat wider than the values, and never without width."""
    low, high = float(values.min()), float(values.max())
    margin = max((high / low) ** 0.05, 1.15)
    return Axis(low / margin, high * margin, first, last)


def columns_of(looks: Looks, across: Axis, values: Float64, up: Axis) -> tuple[Any, Float64]:
    """Columns between the first and the last look, and how high `values` stand there."""
    places = across.place(looks.seconds)
    columns = np.arange(math.floor(places[0]), math.ceil(places[-1]) + 1)
    return columns, np.interp(columns, places, up.place(values))


def draw_band(picture: Float32, looks: Looks, across: Axis, up: Axis) -> None:
    columns, low = columns_of(looks, across, looks.low, up)
    _, high = columns_of(looks, across, looks.high, up)
    rows = np.arange(SIDE)[:, None]
    inside = (rows >= np.floor(low)) & (rows <= np.ceil(high))
    part = picture[:, columns]
    part[inside] = BAND
    picture[:, columns] = part


def draw_line(picture: Float32, looks: Looks, across: Axis, up: Axis) -> None:
    """Two pixels thick, with a dot at each look."""
    columns, height = columns_of(looks, across, looks.rmse, up)
    before = np.concatenate([height[:1], 0.5 * (height[1:] + height[:-1])])
    after = np.concatenate([0.5 * (height[1:] + height[:-1]), height[-1:]])
    for column, one, other in zip(columns, before, after, strict=True):
        low, high = sorted((one, other))
        picture[math.floor(low) : math.floor(high) + 2, column] = LINE
    for x, y in zip(across.place(looks.seconds), up.place(looks.rmse), strict=True):
        picture[round(y) - 2 : round(y) + 3, round(x) - 2 : round(x) + 3] = LINE


def draw_grid(picture: Float32, across: Axis, up: Axis) -> None:
    """Lines and figures; a figure that would cover the one before is left out."""
    free = 0
    for value in across.ticks():
        column, text = round(float(across.place(value))), f"{value:g}s"
        picture[BOTTOM : SIDE - EDGE, column] = GRID
        left = min(column - text_width(text) // 2, SIDE - text_width(text))
        if left >= free:
            write(picture, text, left, 6)
            free = left + text_width(text) + 6
    free = 0
    for value in up.ticks():
        row, text = round(float(up.place(value))), f"{value:g}"
        picture[row, LEFT : SIDE - EDGE] = GRID
        if row >= free:
            write(picture, text, max(LEFT - 5 - text_width(text), 0), row - 5)
            free = row + 14
    picture[BOTTOM, LEFT : SIDE - EDGE] = picture[BOTTOM : SIDE - EDGE, LEFT] = INK


def text_width(text: str) -> int:
    return 4 * LETTER_SCALE * len(text)


def write(picture: Float32, text: str, left: int, low: int) -> None:
    """`text` with its lower left corner at (left, low); what leaves the picture is cut."""
    for number, letter in enumerate(text):
        dots = np.array([int(dot) for dot in GLYPHS[letter]], dtype=bool).reshape(5, 3)[::-1]
        dots = dots.repeat(LETTER_SCALE, axis=0).repeat(LETTER_SCALE, axis=1)
        x, y = left + 4 * LETTER_SCALE * number, max(low, 0)
        part = picture[y : y + dots.shape[0], x : x + dots.shape[1]]
        part[dots[: part.shape[0], : part.shape[1]]] = INK

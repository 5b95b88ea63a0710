"""Texture programs of the reference renderer: the instructions of texture_ops.py over arrays of points."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .reference_colors import COLOR_OPS, Operands
from .reference_numbers import NUMBER_OPS
from .reference_patterns import (
    Fractal,
    eval_brick,
    eval_checker,
    eval_gradient,
    eval_noise_texture,
    eval_wave,
)
from .scene_arrays import Float64
from .texture_ops import (
    NOISE_COLORED,
    NOISE_KIND_SHIFT,
    NOISE_NORMALIZE,
    NOISES,
    REGISTERS,
    TEXTURE_OPS,
    ProgramArrays,
)

if TYPE_CHECKING:
    from .program_builder import Step


def _checker(o: Operands) -> Float64:
    first = eval_checker(o.vector(0) * o.number(3)[:, None])
    color = np.where(first[:, None] == 1.0, o.vector(1), o.vector(2))
    return np.column_stack([color, first])


def _noise(o: Operands) -> Float64:
    scale = o.number(2)
    place = np.column_stack([o.vector(0), o.number(1)]) * scale[:, None]
    dimensions = (o.mode & 3) + 1
    place = place[:, 3:] if dimensions == 1 else place[:, :dimensions]
    fractal = Fractal(
        NOISES[(o.mode >> NOISE_KIND_SHIFT) & 7],
        bool(o.mode & NOISE_NORMALIZE),
        np.clip(o.number(3), 0.0, 15.0),
        np.maximum(o.number(4), 0.0),
        o.number(5),
        o.number(6),
        o.number(7),
    )
    return eval_noise_texture(place, fractal, o.number(8), bool(o.mode & NOISE_COLORED))


def _brick(o: Operands) -> Float64:
    numbers = [o.number(k) for k in range(5, 10)]
    tint, mortar = eval_brick(o.vector(0) * o.number(4)[:, None], numbers, o.table(10, 4)[0])
    brick = o.vector(1) * (1.0 - tint[:, None]) + o.vector(2) * tint[:, None]
    color = brick * (1.0 - mortar[:, None]) + o.vector(3) * mortar[:, None]
    return np.column_stack([color, mortar])


def _wave(o: Operands) -> Float64:
    value = eval_wave(o.vector(0) * o.number(1)[:, None], o.mode, [o.number(k) for k in range(2, 7)])
    return np.repeat(value[:, None], 3, axis=1)


def _gradient(o: Operands) -> Float64:
    return np.repeat(eval_gradient(o.vector(0), o.mode)[:, None], 3, axis=1)


PURE_OPS: dict[str, Callable[[Operands], Float64]] = {
    **COLOR_OPS,
    **NUMBER_OPS,
    "checker": _checker,
    "noise": _noise,
    "brick": _brick,
    "wave": _wave,
    "gradient": _gradient,
}
"""instructions that rest on their operands alone"""

PointOp = Callable[[Operands], Float64]


@dataclass(frozen=True, slots=True)
class Programs:
    """The programs of a scene, ready to run."""

    arrays: ProgramArrays

    def run(self, number: int, count: int, point_ops: dict[str, PointOp]) -> Float64:
        """(count, 3) values of program `number`; `point_ops` do the instructions that ask the point.

        Null where a channel is not finite.
        """
        first, steps, result = (int(x) for x in self.arrays.programs[number])
        constants = self.arrays.constants.astype(np.float64)
        registers = np.zeros((count, REGISTERS))
        ops = {**PURE_OPS, **point_ops}
        with np.errstate(all="ignore"):
            for row in self.arrays.ops[first : first + steps]:
                operands = Operands(registers, constants, int(row[1]), tuple(int(x) for x in row[3:]))
                values = ops[TEXTURE_OPS[row[0]]](operands)
                out = int(row[2])
                registers[:, out : out + values.shape[1]] = values
        if result < 0:
            value = np.repeat(constants[None, -1 - result : 2 - result], count, axis=0)
        else:
            value = registers[:, result : result + 3]
        return np.where(np.isfinite(value), value, 0.0)


def run_constant_step(step: Step) -> tuple[float, ...] | None:
    """Result of a step whose operands are all constants, as native code would have it; None where it
    would not be finite."""
    constants: list[float] = []
    places = []
    for value in step.operands:
        places.append(-1 - len(constants))
        constants += [*(value.constant or ()), 0.0, 0.0, 0.0]
    places += [-1] * (13 - len(places))
    row = Operands(np.zeros((1, 1)), np.array(constants), step.mode, tuple(places))
    with np.errstate(all="ignore"):
        result = PURE_OPS[step.op](row)[0].astype(np.float32)
    return tuple(float(x) for x in result) if np.isfinite(result).all() else None

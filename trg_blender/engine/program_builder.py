"""Builds texture programs: instructions with values that are named once, registers that are shared."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .texture_ops import OPERANDS, REGISTERS, TEXTURE_OPS, ProgramArrays

SLOTS = REGISTERS // 4
"""Every value takes four registers."""
PADDING = 16
"""Zeros behind the constants: a short constant may be read as a vector."""


class ProgramTooLargeError(Exception):
    """A program needs more values at once than there are registers."""


@dataclass(frozen=True, slots=True)
class Value:
    """What a node's output is: a constant, or `channel` and on of the result of an instruction."""

    constant: tuple[float, ...] | None = None
    step: int = -1
    channel: int = 0

    def part(self, channel: int) -> Value:
        """The value from its channel number `channel` on."""
        if self.constant is not None:
            return Value(self.constant[channel:])
        return Value(None, self.step, self.channel + channel)


@dataclass(frozen=True, slots=True)
class Step:
    op: str
    mode: int
    operands: tuple[Value, ...]


@dataclass(slots=True)
class ProgramPool:
    """All programs of a scene, and their constants, each kept once."""

    rows: list[list[int]] = field(default_factory=list)
    programs: list[tuple[int, int, int]] = field(default_factory=list)
    constants: list[float] = field(default_factory=lambda: [0.0] * 4)
    _places: dict[tuple[float, ...], int] = field(default_factory=lambda: {(0.0,): 0})
    _known: dict[tuple[tuple[Step, ...], Value], int] = field(default_factory=dict)

    def place(self, numbers: tuple[float, ...]) -> int:
        """Where `numbers` begin among the constants."""
        key = numbers if len(numbers) < 3 else (*numbers, np.inf)
        if key not in self._places:
            self._places[key] = len(self.constants)
            self.constants.extend(numbers)
        return self._places[key]

    def add(self, steps: list[Step], result: Value) -> int:
        """Number of the program that does `steps` and gives `result`. Raises ProgramTooLargeError."""
        key = (tuple(steps), result)
        if key not in self._known:
            slots = _share_registers(steps, result)
            first = len(self.rows)
            for step, slot in zip(steps, slots, strict=True):
                self.rows.append(self._row(step, slot, slots))
            self._known[key] = len(self.programs)
            self.programs.append((first, len(steps), self._operand(result, slots)))
        return self._known[key]

    def _operand(self, value: Value, slots: list[int]) -> int:
        if value.constant is not None:
            return -1 - self.place(value.constant)
        return 4 * slots[value.step] + value.channel

    def _row(self, step: Step, slot: int, slots: list[int]) -> list[int]:
        operands = [self._operand(value, slots) for value in step.operands]
        operands += [-1] * (OPERANDS - len(operands))
        return [TEXTURE_OPS.index(step.op), step.mode, 4 * slot, *operands]

    def arrays(self) -> ProgramArrays:
        return ProgramArrays(
            np.array(self.rows, np.int32).reshape(-1, 3 + OPERANDS),
            np.array(self.constants + [0.0] * PADDING, np.float32),
            np.array(self.programs, np.int32).reshape(-1, 3),
        )


def _share_registers(steps: list[Step], result: Value) -> list[int]:
    """A slot for the result of each step, free again after its last reader."""
    last = list(range(len(steps)))
    for number, step in enumerate(steps):
        for value in step.operands:
            if value.constant is None:
                last[value.step] = number
    if result.constant is None:
        last[result.step] = len(steps)
    free, slots = list(range(SLOTS)), [0] * len(steps)
    ends: dict[int, list[int]] = {}
    for number in range(len(steps)):
        if not free:
            raise ProgramTooLargeError
        slots[number] = free.pop(0)
        ends.setdefault(last[number], []).append(slots[number])
        free.extend(ends.pop(number, []))
        free.sort()
    return slots


@dataclass(slots=True)
class ProgramBuilder:
    """Collects the steps of one program; equal steps are done once."""

    steps: list[Step] = field(default_factory=list)
    _known: dict[tuple[Step, int], int] = field(default_factory=dict)
    place: int = 0
    """0 at the point itself, 1 and 2 while a bump looks beside it"""

    def emit(self, op: str, *operands: Value, mode: int = 0) -> Value:
        """The result of an instruction; what rests on constants alone is worked out now."""
        step = Step(op, mode, operands)
        if operands and all(value.constant is not None for value in operands):
            folded = _fold(step)
            if folded is not None:
                return Value(folded)
        key = (step, self.place)
        if op == "shift" or key not in self._known:
            self._known[key] = len(self.steps)
            self.steps.append(step)
        return Value(None, self._known[key])


NOT_FOLDED = frozenset({
    "attribute", "generated", "object", "position", "normal", "info", "shift", "image", "box", "bump",
    "fresnel", "layer_weight", "normal_map",
})  # fmt: skip


def _fold(step: Step) -> tuple[float, ...] | None:
    if step.op in NOT_FOLDED:
        return None
    from .reference_programs import run_constant_step  # builds a pool of its own, from this module

    return run_constant_step(step)

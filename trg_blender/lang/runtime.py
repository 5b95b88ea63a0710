"""The state of one run: budget, memory accounts, output, places, and the calls of overloads."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain
from types import CodeType, FrameType, GeneratorType
from typing import TYPE_CHECKING

from .diagnostics import DiagnosticBag, Notice
from .limits import MAX_CALL_DEPTH, MAX_OPERATOR_DEPTH, HostOptions
from .memory import resident_bytes
from .scene import RenderModes
from .source import Span
from .texts import SHORT_TEXT, TextBuffer
from .values import COMPARISON, Str, TrgError, Undef, overload_of, trg_frame

if TYPE_CHECKING:
    from .library.mth import Pcg32
    from .library.scene_methods import SceneObject
    from .program import Program

SLICE = 10_000
_STEPS = [True] * SLICE  # an iterator over a list is the quickest that CPython has
BLOCKS_OF_THING = 16
BYTES_OF_THING = 1024
"""What a shape or light may take, its records included."""
_HOLDS_SOMETHING = 2_000
_TEXT_WORK_CHECK = 16 * 1024 * 1024


@dataclass(slots=True, eq=False)
class Site:
    """A place of the program: its operator if it is one, and the spans of operands or arguments.

    Not frozen, which would make it four times as slow to construct: a long program has a hundred thousand.
    """

    span: Span
    op: str = ""
    operands: tuple[Span, ...] = ()
    names: tuple[str, ...] = ()
    """Names of operands that are variables or fields, else ""."""


class Place:
    """A place of the program that makes things of a kind, and how many it has made."""

    __slots__ = ("kind", "made", "prefix", "rt", "span")

    def __init__(self, rt: Runtime, kind: str, span: Span) -> None:
        file = "" if span.file == rt.program.main else f"{span.file}:"
        self.rt = rt
        self.kind = kind
        self.span = span
        self.prefix = f"{kind}@{file}{span.line}:{span.col}#"
        self.made = 0


class Runtime:
    """Everything that built-ins and operators need to know while a program runs."""

    scene: SceneObject
    random: Pcg32

    def __init__(self, program: Program, options: HostOptions) -> None:
        self.program = program
        self.options = options
        self.limits = options.limits
        self.bag = DiagnosticBag(options.language)
        self.output: list[str] = []
        self.globals: dict[str, object] = {}
        self.undef = Undef(self)
        self.live_text = 0
        self.live_elements = 0
        self.counts_in_advance = True
        """Whether lists may count elements that they will get, see lists.List.reserve."""
        self.frame = 0
        self.modes = RenderModes()
        self._made_at: dict[tuple[Site | None, str], Place] = {}
        self.things = 0
        self.cancelled = False
        self._steps = 0
        self._slice = SLICE
        self._text_work = 0
        self._seconds_start = time.thread_time()
        self._blocks_start = sys.getallocatedblocks()
        self._resident_start = resident_bytes()
        self._operator_depth = 0
        self._lines_this_frame = 0
        self._output_cut = False
        self._sites: dict[tuple[int, int], Site] = {}

    # Budget.

    def take_step(self) -> None:
        """One step where code found its slice used up: another loop may have begun a new one since.

        Raises TrgError at a limit.
        """
        scope = self.globals
        if next(scope["S_"], self) is self:  # type: ignore[call-overload]
            scope["S_"] = self.next_slice()

    def ticks(self) -> Iterator[bool]:
        """The iterator that every loop of plain functions runs over; raises at a limit."""
        return chain.from_iterable(self._slices())

    def _slices(self) -> Iterator[Iterator[bool]]:
        while True:
            yield self.next_slice()

    def next_slice(self) -> Iterator[bool]:
        """Account for a slice of steps, check every limit, and hand out the next slice."""
        self.check_limits()
        left = self.limits.max_steps - self._steps
        if left <= 0:
            raise TrgError("E601", "raise_limit", option="max_steps", limit=self.limits.max_steps)
        self._slice = min(SLICE, left)
        self._steps += self._slice
        return iter(_STEPS[: self._slice])

    def check_limits(self) -> None:
        """Raise TrgError when time or memory is used up or the host has cancelled."""
        if self.cancelled:
            raise TrgError("E609")
        self.check_time()
        self._check_memory()

    def _check_memory(self) -> None:
        """Blocks count what is small; what is large shows in the resident size of the process.

        Shapes and lights have a limit of their own and are allowed for. The process may grow for
        reasons that are not the program's: its size counts only when the program holds something.
        """
        limits = self.limits
        blocks = sys.getallocatedblocks() - self._blocks_start - BLOCKS_OF_THING * self.things
        if blocks > limits.max_blocks:
            raise TrgError("E613", "raise_other", option="max_blocks", limit=limits.max_blocks)
        if blocks > _HOLDS_SOMETHING:
            grown = resident_bytes() - self._resident_start - BYTES_OF_THING * self.things
            if grown > limits.max_bytes:
                megabytes = limits.max_bytes // 1048576
                raise TrgError("E604", "raise_other", option="max_bytes", limit=megabytes)

    def check_time(self) -> None:
        if time.thread_time() - self._seconds_start > self.limits.max_seconds:
            raise TrgError("E602", "raise_limit", option="max_seconds", limit=self.limits.max_seconds)

    def begin_frame(self) -> None:
        """Start the budget of the next frame."""
        self._steps = 0
        self._text_work = 0
        self._lines_this_frame = 0
        self._seconds_start = time.thread_time()

    def hold_text(self, length: int, size: int) -> None:
        """Count `size` more bytes for a string of `length`; raises TrgError above a limit."""
        limits = self.limits
        if length > limits.max_string:
            raise TrgError("E605", "raise_other", option="max_string", limit=limits.max_string)
        if self.live_text + size > limits.max_text_bytes:
            megabytes = limits.max_text_bytes // 1048576
            raise TrgError("E606", "raise_other", option="max_text_bytes", limit=megabytes)
        self.live_text += size
        self.work_on_text(size)

    def work_on_text(self, size: int) -> None:
        """Long texts and copies cost time and memory that steps do not see: check now and then."""
        self._text_work += size
        if self._text_work > _TEXT_WORK_CHECK:
            self._text_work = 0
            self.check_limits()

    # Places.

    def site(self) -> Site | None:
        """The place of translated code that is being run."""
        frame = trg_frame(self.globals)
        return None if frame is None else self.site_at(frame.f_code, frame.f_lasti)

    def site_at(self, code: CodeType, last_instruction: int) -> Site:
        """The place of an instruction, from the code object's position table."""
        key = (id(code), last_instruction)  # the program keeps its code objects alive
        site = self._sites.get(key)
        if site is None:
            site = self._sites[key] = self._find_site(code, last_instruction)
        return site

    def _find_site(self, code: CodeType, last_instruction: int) -> Site:
        positions = list(code.co_positions())
        line, end_line, col, end_col = positions[max(0, last_instruction) // 2]
        first = line or 1
        span = Span(code.co_filename, first, (col or 0) + 1, end_line or first, (end_col or 0) + 1)
        return self.program.sites.get(span) or Site(span)

    def place(self, kind: str) -> Place:
        """The running call as a place that makes things of a kind."""
        site = self.site()
        place = self._made_at.get((site, kind))
        if place is None:
            span = site.span if site is not None else self.program.start
            place = self._made_at[site, kind] = Place(self, kind, span)
        return place

    def make_key(self, kind: str) -> tuple[str, Span]:
        """The key of a thing that the running call makes, and the place of the call.

        The k-th thing of a kind made at a place has number k: the same in every run.
        """
        place = self.place(kind)
        place.made += 1
        return f"{place.prefix}{place.made}", place.span

    # Diagnostics and output.

    def warn(self, code: str, span: Span, hint: str | None = None, **values: object) -> None:
        """One warning for each place."""
        self.bag.add(Notice(code, span, values, hint), "warning")

    def warn_undefined(self, operand: int | None) -> None:
        """Warn that an operand without a value counted as 0, at the operand.

        None: it is not known which one; the first that is a variable is taken.
        """
        site = self.site()
        if site is None:
            return
        if operand is None:
            operand = next((n for n, name in enumerate(site.names) if name), 0)
        span = site.operands[operand] if operand < len(site.operands) else site.span
        self.warn("W701", span)

    @property
    def output_is_cut(self) -> bool:
        """Whether nothing more will be shown of this frame: what is printed need not be put into words."""
        return self._output_cut or self._lines_this_frame > self.limits.output_lines_frame

    def write_line(self, text: str) -> None:
        """Add a line to the output, within the limits; the first line too many says so."""
        limits = self.limits
        self.work_on_text(len(text))
        if len(text) > limits.output_columns:
            text = text[: limits.output_columns] + " ..."
        if self.output_is_cut:
            return
        self._lines_this_frame += 1
        over = self._lines_this_frame > limits.output_lines_frame
        self._output_cut = len(self.output) >= limits.output_lines
        self.output.append("output cut" if over or self._output_cut else text)

    # Values and calls.

    def count_thing(self) -> None:
        """Count a shape or light; raises TrgError above the limit."""
        self.things += 1
        if self.things > self.limits.max_shapes:
            raise self.too_many_things()

    def too_many_things(self) -> TrgError:
        return TrgError("E610", "raise_other", option="max_shapes", limit=self.limits.max_shapes)

    def text(self, text: str) -> Str:
        """A string value. Raises TrgError above the limits."""
        length = len(text)
        if length > SHORT_TEXT:
            return Str(self, TextBuffer(self, text), length)
        if length > self.limits.max_string:
            self.hold_text(length, 0)
        return Str(self, text, length)

    def step_operator(self) -> str:
        """`++` or `--` when that is the operator being run, else an empty string."""
        site = self.site()
        return site.op if site is not None and site.op in ("++", "--") else ""

    def call_overload(self, function: object, *operands: object) -> object:
        """Call an operator field with its operands; it can neither suspend nor nest too deeply."""
        if not callable(function):
            raise TrgError("E416")
        if self._operator_depth >= MAX_OPERATOR_DEPTH:
            raise TrgError("E608", "fixed_limit", limit=MAX_OPERATOR_DEPTH)
        frame = trg_frame(self.globals)
        self._operator_depth += 1
        try:
            result = function(_levels_of(frame), *operands)
        finally:
            self._operator_depth -= 1
        if type(result) is GeneratorType:
            result.close()
            raise TrgError("E415")
        return result

    def compare(self, op: str, left: object, right: object) -> object:
        """A comparison in a program that overloads comparisons."""
        overload = overload_of(left, op) or overload_of(right, op)
        if overload is not None:
            return self.call_overload(overload, left, right)
        if op == "!=":
            equal = overload_of(left, "==") or overload_of(right, "==")
            if equal is not None:
                return not self.call_overload(equal, left, right)
        return COMPARISON[op](left, right)

    def logical_not(self, value: object) -> object:
        """`!value` in a program that overloads it."""
        overload = overload_of(value, "!")
        if overload is None:
            return 0.0 if value else 1.0
        return self.call_overload(overload, value)


def _call_levels(depth: int) -> tuple[object, ...]:
    levels: tuple[object, ...] = ()
    for _ in range(depth):
        levels = (levels,)
    return levels


CALL_LEVELS = _call_levels(MAX_CALL_DEPTH)
"""What the hidden first argument `d_` of a call holds: as many tuples, each in the next, as calls may
still be nested. Every function begins with `d_ = d_[0]`, which fails when none is left."""


def _levels_of(frame: FrameType | None) -> tuple[object, ...]:
    if frame is None:
        return CALL_LEVELS
    levels = frame.f_locals.get("d_", CALL_LEVELS)
    return levels if type(levels) is tuple else ()

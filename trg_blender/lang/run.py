"""A session: one run of a program, handed out frame by frame."""

from __future__ import annotations

import time
from collections.abc import Generator
from dataclasses import dataclass

from .diagnostics import Diagnostic
from .faults import FaultReader
from .helpers import PAUSE, Helpers
from .library.mth import Pcg32
from .library.scene_methods import SceneObject
from .limits import HostOptions
from .memory import collecting_seldom
from .parameters import wrong_parameters
from .program import Program
from .runtime import CALL_LEVELS, Runtime
from .scene import SceneDescription
from .values import TrgError

_COLLECT_AFTER = 10_000


@dataclass(frozen=True, slots=True)
class FrameEvent:
    """The program called Scene.Render()."""

    scene: SceneDescription


@dataclass(frozen=True, slots=True)
class PauseEvent:
    """`max_seconds` are over; the program goes on at the next call."""


@dataclass(frozen=True, slots=True)
class EndEvent:
    """The program is over. `error` is what ended it, None when it came to its end."""

    error: Diagnostic | None = None

    @property
    def out_of_budget(self) -> bool:
        """Whether a limit on steps, time or memory, or the host's cancel, ended it."""
        return self.error is not None and self.error.code.startswith("E6")


class Session:
    """Runs a program. After an EndEvent it only ever returns that event.

    Parameters of `options` that the program does not export or that do not fit end it at once.
    """

    def __init__(self, program: Program, options: HostOptions | None = None) -> None:
        self.program = program
        options = options or HostOptions()
        self._rt = Runtime(program, options)
        self._rt.scene = SceneObject(self._rt)
        self._rt.random = Pcg32(0)
        wrong = wrong_parameters(program, options)
        self._rt.bag.items += wrong
        self._end = EndEvent(wrong[0]) if wrong else None
        self._main: Generator[object, None, object] | None = None

    @property
    def output(self) -> list[str]:
        """The lines printed so far."""
        return self._rt.output

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """Warnings and the error, in the order in which they came up."""
        return tuple(self._rt.bag.items)

    def cancel(self) -> None:
        """Let the program end at the next slice. May be called from another thread."""
        self._rt.cancelled = True

    def next_frame(self, max_seconds: float | None = None) -> FrameEvent | PauseEvent | EndEvent:
        """Run to the next Scene.Render() or the end.

        With `max_seconds` control comes back after about that time (one slice is the grain: well
        below a millisecond in the main program, longer while a function that cannot suspend runs).
        No exception of the program gets out: an error is a Diagnostic in the EndEvent.
        """
        if self._end is not None:
            return self._end
        until = None if max_seconds is None else time.perf_counter() + max_seconds
        try:
            with collecting_seldom(_COLLECT_AFTER):
                return self._advance(until)
        except StopIteration:
            self._end = EndEvent()
        except Exception as error:  # the border: every fault of a program becomes a diagnostic
            self._end = EndEvent(self._report(error))
        return self._end

    def _advance(self, until: float | None) -> FrameEvent | PauseEvent:
        if self._main is None:
            self._main = self._start()
        main, scope = self._main, self._rt.globals
        while True:
            event = next(main)
            if event is not PAUSE:
                self._rt.frame += 1
                self._rt.begin_frame()
                return FrameEvent(event)  # type: ignore[arg-type]
            if next(scope["S_"], PAUSE) is PAUSE:  # type: ignore[call-overload]
                try:
                    scope["S_"] = self._rt.next_slice()
                except TrgError as error:  # a limit: let it surface at the loop that is running
                    main.throw(error)
            if until is not None and time.perf_counter() >= until:
                return PauseEvent()

    def _start(self) -> Generator[object, None, object]:
        scope = self._rt.globals
        scope.update(Helpers(self._rt).table())
        for code in self.program.codes:
            exec(code, scope)  # noqa: S102 - translated and checked by check.check_tree
        return scope["m_0"](CALL_LEVELS)  # type: ignore[operator,no-any-return]

    def _report(self, error: Exception) -> Diagnostic:
        found = FaultReader(self._rt).read(error)
        self._rt.bag.items.append(found)
        self._rt.globals.clear()
        self._main = None
        return found

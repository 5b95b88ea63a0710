"""Running little programs in tests."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import pytest

from trg_blender.lang import (
    Diagnostic,
    FrameEvent,
    HostOptions,
    Limits,
    ProgramError,
    SceneDescription,
    Session,
    compile_source,
)

MAX_FRAMES = 20


@dataclass
class Outcome:
    """What came of a program."""

    output: list[str] = field(default_factory=list)
    diagnostics: list[Diagnostic] = field(default_factory=list)
    frames: list[SceneDescription] = field(default_factory=list)

    @property
    def error(self) -> tuple[str, str] | None:
        """(code, line:col) of the first error."""
        for d in self.diagnostics:
            if d.severity == "error":
                return d.code, f"{d.span.line}:{d.span.col}"
        return None

    @property
    def warnings(self) -> list[tuple[str, str]]:
        found = [d for d in self.diagnostics if d.severity == "warning"]
        return [(d.code, f"{d.span.line}:{d.span.col}") for d in found]


def run_program(text: str, *, limits: Limits | None = None, resolver=None, **options) -> Outcome:
    """Compile and run `text` to its end or MAX_FRAMES frames."""
    try:
        program = compile_source(text, "main.trg", resolver)
    except ProgramError as error:
        return Outcome(diagnostics=list(error.diagnostics))
    session = Session(program, HostOptions(limits=limits or Limits(), **options))
    frames = []
    while len(frames) < MAX_FRAMES and isinstance(event := session.next_frame(), FrameEvent):
        frames.append(event.scene)
    return Outcome(session.output, [*program.diagnostics, *session.diagnostics], frames)


@pytest.fixture
def run() -> Callable[..., Outcome]:
    return run_program

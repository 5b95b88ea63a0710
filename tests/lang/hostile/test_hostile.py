"""The hostile programs end with a diagnostic, whatever the machine does beside them.

What they cost is measured by benchmarks/hostile.py; here the bounds are far.
"""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from trg_blender.lang import FrameEvent, HostOptions, Limits, ProgramError, Session, compile_source

sys.path.insert(0, str(Path(__file__).resolve().parent))
from hostile_programs import ENDLESS, TEXTS  # noqa: E402
from hostile_runner import run_child  # noqa: E402

STEPS = 50_000
FAR_SECONDS = 60.0
FAR_MEGABYTES = 700.0
HUNGRY = ("copies of large objects", "objects with many fields", "many strings", "a list that doubles")


def _codes(text: str) -> list[str]:
    """The codes of the errors that end a program."""
    limits = Limits(max_steps=STEPS, max_seconds=FAR_SECONDS)
    try:
        session = Session(compile_source(text, "main.trg"), HostOptions(limits=limits))
    except ProgramError as error:
        return [d.code for d in error.diagnostics]
    for _ in range(3):
        if not isinstance(session.next_frame(), FrameEvent):
            break
    return [d.code for d in session.diagnostics if d.severity == "error"]


def test_there_are_many() -> None:
    assert len(ENDLESS) + len(TEXTS) >= 80


@pytest.mark.parametrize("name", ENDLESS)
def test_a_program_that_wants_too_much_meets_a_limit(name) -> None:
    codes = _codes(ENDLESS[name])
    assert len(codes) == 1 and codes[0].startswith("E6"), codes


@pytest.mark.parametrize("name", TEXTS)
def test_a_strange_text_is_run_or_refused(name) -> None:
    assert "E900" not in _codes(TEXTS[name])


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no limits of a process's memory")
@pytest.mark.parametrize("name", HUNGRY)
def test_a_hungry_program_stays_small(name) -> None:
    row = run_child(name)
    assert "error" not in row, row
    assert str(row["codes"][0]).startswith("E6")
    assert row["megabytes"] < FAR_MEGABYTES

"""Runs the conformance programs of the shared data: `python -m tests.lang.conformance`.

Prints one line a failure and at the end `N passed, N failed`; the exit status is 1 when one failed
or when there are no programs. Needs the standard library only.
"""

from __future__ import annotations

import json
import os
import platform
import sys
from pathlib import Path

from trg_blender.lang import (
    Diagnostic,
    DiskFiles,
    FrameEvent,
    HostOptions,
    Limits,
    ProgramError,
    Session,
    compile_source,
)  # fmt: skip

ROOT = Path(__file__).resolve().parents[2]
SHARED = Path(os.environ.get("TRG_SHARED", ROOT.parent / "shared"))
FOLDER = SHARED / "data" / "conformance"
MAX_FRAMES = 50


def entries() -> list[dict]:
    """What `index.json` says of every program: its name and what is expected of it."""
    index = FOLDER / "index.json"
    return json.loads(index.read_text(encoding="utf-8")) if index.is_file() else []


def _run(entry: dict) -> tuple[str, list[Diagnostic], int]:
    """(output, diagnostics, frames) of one program."""
    name = entry["name"]
    text = (FOLDER / f"{name}.trg").read_bytes().decode("utf-8")
    resolver = DiskFiles(FOLDER / f"{name}.files")
    limits = Limits(max_steps=entry.get("max_steps", Limits().max_steps))
    try:
        program = compile_source(text, "main.trg", resolver)
    except ProgramError as error:
        return "", list(error.diagnostics), 0
    session = Session(program, HostOptions(limits=limits))
    frames = 0
    while isinstance(session.next_frame(), FrameEvent) and frames < MAX_FRAMES:
        frames += 1
    return "\n".join(session.output), list(session.diagnostics), frames


def failure_of(entry: dict) -> str:
    """What is wrong with a program, in one line; an empty text when it does what is expected."""
    output, diagnostics, frames = _run(entry)
    errors = [d for d in diagnostics if d.severity == "error"]
    if "error_at" in entry:
        return _compare_error(entry, errors)
    warned = [f"{d.span.line}:{d.span.col}" for d in diagnostics if d.severity == "warning"]
    found = (errors, output, warned, frames)
    expected = ([], entry["output"], entry.get("warnings_at", []), entry.get("frames", frames))
    return "" if found == expected else f"{found}, expected {expected}"


def _compare_error(entry: dict, errors: list[Diagnostic]) -> str:
    if not errors:
        return f"no error, expected one at {entry['error_at']}"
    span = errors[0].span
    place = f"{span.line}:{span.col}"
    if entry["error_at"].count(":") == 2:
        place = f"{span.file}:{place}"
    right = place == entry["error_at"] and entry["error_has"] in errors[0].message
    return "" if right else f"{errors[0]}, expected {entry['error_at']} {entry['error_has']}"


def main() -> int:
    """Run all programs."""
    reasons = {entry["name"]: failure_of(entry) for entry in entries()}
    failed = {name: reason for name, reason in reasons.items() if reason}
    for name, reason in failed.items():
        sys.stdout.write(f"{name}: {reason}\n")
    sys.stdout.write(f"Python {platform.python_version()}\n")
    sys.stdout.write(f"{len(reasons) - len(failed)} passed, {len(failed)} failed\n")
    return 1 if failed or not reasons else 0


if __name__ == "__main__":
    sys.exit(main())

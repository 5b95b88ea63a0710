"""The conformance programs of the shared data, one test each."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from trg_blender.lang import (
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


def _entries() -> list[dict]:
    index = FOLDER / "index.json"
    return json.loads(index.read_text(encoding="utf-8")) if index.is_file() else []


def _run(entry: dict) -> tuple[str, list, int]:
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


@pytest.mark.skipif(not _entries(), reason="the shared conformance programs are not here")
@pytest.mark.parametrize("entry", _entries(), ids=lambda e: e["name"])
def test_conformance(entry: dict) -> None:
    output, diagnostics, frames = _run(entry)
    errors = [d for d in diagnostics if d.severity == "error"]
    if "error_at" in entry:
        place = f"{errors[0].span.line}:{errors[0].span.col}"
        if entry["error_at"].count(":") == 2:
            place = f"{errors[0].span.file}:{place}"
        assert (place, True) == (entry["error_at"], entry["error_has"] in errors[0].message), errors
        return
    assert errors == []
    assert output == entry["output"]
    warned = [f"{d.span.line}:{d.span.col}" for d in diagnostics if d.severity == "warning"]
    assert warned == entry.get("warnings_at", [])
    if "frames" in entry:
        assert frames == entry["frames"]

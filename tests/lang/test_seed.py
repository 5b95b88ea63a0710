"""The paper's program: as printed, and mended; and the commands that show it."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from trg_blender.cli import main
from trg_blender.lang import DiskFiles, ProgramError, compile_source

ROOT = Path(__file__).resolve().parents[2]
SHARED = Path(os.environ.get("TRG_SHARED", ROOT.parent / "shared"))
SEED = SHARED / "design" / "seed_sample.trg"
needs_seed = pytest.mark.skipif(not SEED.is_file(), reason="the paper's program is not here")


def _mended() -> str:
    return SEED.read_text(encoding="utf-8").replace('cow.g3dm"),', 'cow.g3dm",')


@needs_seed
def test_the_printed_program_has_one_error_with_the_place_of_the_early_bracket(tmp_path) -> None:
    with pytest.raises(ProgramError) as caught:
        compile_source(SEED.read_text(encoding="utf-8"), "scene.trg", DiskFiles(tmp_path))
    (found,) = caught.value.diagnostics
    assert (found.span.line, found.span.col, found.code) == (27, 85, "E202")
    assert "27:40" in (found.hint or "")


@needs_seed
def test_the_mended_program_renders_and_warns_once_a_place(tmp_path, run) -> None:
    outcome = run(_mended(), resolver=DiskFiles(tmp_path))
    assert outcome.error is None and len(outcome.frames) == 20
    assert outcome.warnings == [("W702", "21:5"), ("W702", "27:11"), ("W701", "36:57"), ("W701", "39:5")]
    kinds = [s.kind for s in outcome.frames[0].shapes]
    assert kinds == ["tor", "fence", *["conus"] * 6, "model", "plane"]
    assert outcome.frames[0].camera.location != outcome.frames[1].camera.location


@needs_seed
def test_check_prints_the_place_and_the_hint(tmp_path, capsys) -> None:
    file = tmp_path / "seed.trg"
    file.write_text(SEED.read_text(encoding="utf-8"), encoding="utf-8")
    assert main(["check", str(file)]) == 1
    shown = capsys.readouterr().out
    assert shown.startswith("seed.trg:27:85: error: ')' has no matching '('\n")
    assert "27:40" in shown


def test_run_prints_json(tmp_path, capsys) -> None:
    file = tmp_path / "a.trg"
    file.write_text("Scene = scene(); while (1) { print(i); Scene.Render(); i++; }", encoding="utf-8")
    assert main(["run", str(file), "--frames", "3", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["output"], found["frames"]) == (["undef", "1", "2"], 3)
    assert {"severity", "code", "file", "line", "col", "end_line", "end_col", "message", "hint"} == set(
        found["diagnostics"][0]
    )


@pytest.mark.parametrize(
    ("text", "code"),
    [("print(1);", 0), ("x = 1 / 0;", 1), ("x = ;", 1), ("for (;;) { }", 3),
     ("Scene = scene(); while (1) Scene.Render();", 0)],
)  # fmt: skip
def test_exit_codes_of_run(text, code, tmp_path, capsys) -> None:
    file = tmp_path / "a.trg"
    file.write_text(text, encoding="utf-8")
    assert main(["run", str(file)]) == code
    assert ("Traceback" in capsys.readouterr().err) is False


def test_a_budget_error_names_its_line(tmp_path, capsys) -> None:
    file = tmp_path / "a.trg"
    file.write_text("x = 1;\nwhile (1) { }", encoding="utf-8")
    assert main(["run", str(file), "--max-steps", "1000"]) == 3
    assert capsys.readouterr().err.startswith("a.trg:2:1: error:")

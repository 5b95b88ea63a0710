"""Blender's window under a virtual X server: F12, an animation, Esc; and no crash."""

from __future__ import annotations

import json
from pathlib import Path

from .real_blender_tool import INSIDE, RealBlender
from .rendered_files import FENCE, GOOD_PROGRAM, write_program


def drive(blender: RealBlender, mode: str, blend: Path) -> dict[str, object]:
    """Opens `blend` in the window, does what `mode` says, and returns the facts that were noted."""
    facts = blend.with_name(f"{mode}.json")
    done = blender.run(
        "--window-geometry",
        "0",
        "0",
        "1600",
        "900",
        blend,
        "--python",
        INSIDE / "gui.py",
        "--",
        mode,
        facts,
        gui=True,
    )
    assert done.status == 0, done.text
    assert "Traceback" not in done.text, done.text
    noted: dict[str, object] = json.loads(facts.read_text(encoding="utf-8"))
    assert not noted["timed_out"], (noted, done.text)
    return noted


def make_blend(blender: RealBlender, directory: Path, program: Path, samples: int, percent: int) -> Path:
    """A .blend with a program, ready for TRG."""
    blend = directory / "scene.blend"
    done = blender.script("make_blend.py", blend, program, str(samples), str(percent))
    assert done.status == 0, done.text
    return blend


def test_f12_renders_the_papers_program(blender: RealBlender, tmp_path: Path) -> None:
    noted = drive(blender, "still", make_blend(blender, tmp_path, FENCE, 8, 25))
    assert noted["completed"] and not noted["cancelled"]
    assert noted["frames"] == 1
    assert (tmp_path / "still.png").stat().st_size > 10_000


def test_animation_survives_a_moving_viewport(blender: RealBlender, tmp_path: Path) -> None:
    program = write_program(tmp_path, "scene.trg", GOOD_PROGRAM)
    blend = make_blend(blender, tmp_path, program, 8, 100)
    noted = drive(blender, "animation", blend)
    assert noted["completed"] and not noted["cancelled"]
    assert noted["frames"] == 10
    assert noted["draws"] > 10
    assert len(list(tmp_path.glob("frame_*.png"))) == 10


def test_escape_cancels_at_once(blender: RealBlender, tmp_path: Path) -> None:
    program = write_program(tmp_path, "scene.trg", GOOD_PROGRAM)
    noted = drive(blender, "cancel", make_blend(blender, tmp_path, program, 100_000, 100))
    assert noted["running_before_escape"]
    assert noted["cancelled"] and not noted["completed"]
    assert noted["break_to_end_s"] < 0.2, noted
    assert noted["escape_to_end_s"] < 5.0, noted

"""The text editor in Blender's window: mistakes, running by keys, fixes, comments; with screenshots."""

from __future__ import annotations

import json
from pathlib import Path

from .real_blender_tool import INSIDE, ROOT, RealBlender

PICTURES = ROOT / "build" / "screenshots"


def test_a_program_is_written_and_run(blender: RealBlender, tmp_path: Path) -> None:
    pictures = PICTURES / blender.version
    pictures.mkdir(parents=True, exist_ok=True)
    facts = tmp_path / "facts.json"
    done = blender.run(
        "--window-geometry", "0", "0", "1600", "900",
        "--python", INSIDE / "text_editor.py", "--", pictures, facts, gui=True,
    )  # fmt: skip
    assert done.status == 0, done.text
    assert "Traceback" not in done.text, done.text
    noted = json.loads(facts.read_text(encoding="utf-8"))
    assert noted["before"] == [["error", 7, 15]]
    assert "ring.trg:7:15: error" in noted["error"]
    assert noted["cursor_after_wrong_run"] == [6, 14]
    assert noted["fix"] == ["FINISHED"]
    assert noted["after"] == []
    assert (noted["program"], noted["meshes"], noted["parameters"]) == ("ring.trg", 7, ["count"])
    assert noted["commented"] == "// Scene = scene();"
    assert noted["after_undo"] == "Scene = scene();"
    for name in ("text_editor_mistake", "text_editor", "text_editor_completion"):
        assert (pictures / f"{name}.png").stat().st_size > 10_000

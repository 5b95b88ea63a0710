"""The text editor in Blender's window: mistakes, running by keys, fixes, comments; with screenshots."""

from __future__ import annotations

from pathlib import Path

from .real_blender_tool import RealBlender, drive_window, pictures_of


def test_a_program_is_written_and_run(blender: RealBlender, tmp_path: Path) -> None:
    pictures = pictures_of(blender)
    noted = drive_window(blender, "text_editor.py", pictures, tmp_path / "facts.json")
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

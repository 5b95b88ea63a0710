"""The image editor in Blender's window: a pixel looked behind, two slots compared; with screenshots."""

from __future__ import annotations

from pathlib import Path

from .real_blender_tool import RealBlender, drive_window, pictures_of


def test_pixels_are_inspected_and_slots_compared(blender: RealBlender, tmp_path: Path) -> None:
    pictures = pictures_of(blender)
    noted = drive_window(blender, "image_editor.py", pictures, tmp_path / "facts.json")
    assert noted["inspect"] == ["RUNNING_MODAL"]
    assert abs(noted["pixel"][0] - 80) <= 3 and abs(noted["pixel"][1] - 45) <= 3  # as the mouse is placed
    assert noted["names"] == ["Cube", "Material"]
    assert noted["standard_error"] > 0.0
    assert noted["slots"] == [0, 1]
    assert noted["compare"] == ["FINISHED"]
    assert 0.0 < noted["rmse"] < 0.1 and 0.0 < noted["flip"] < 0.2
    assert noted["shown"] == "TRG Difference"
    assert (pictures / "image_editor.png").stat().st_size > 10_000

"""The image editor in Blender's window: a pixel looked behind, two slots compared; with screenshots."""

from __future__ import annotations

import json
from pathlib import Path

from .real_blender_tool import INSIDE, ROOT, RealBlender

PICTURES = ROOT / "build" / "screenshots"


def test_pixels_are_inspected_and_slots_compared(blender: RealBlender, tmp_path: Path) -> None:
    pictures = PICTURES / blender.version
    pictures.mkdir(parents=True, exist_ok=True)
    facts = tmp_path / "facts.json"
    done = blender.run(
        "--window-geometry", "0", "0", "1600", "900",
        "--python", INSIDE / "image_editor.py", "--", pictures, facts, gui=True,
    )  # fmt: skip
    assert done.status == 0, done.text
    assert "Traceback" not in done.text, done.text
    noted = json.loads(facts.read_text(encoding="utf-8"))
    assert noted["inspect"] == ["RUNNING_MODAL"]
    assert abs(noted["pixel"][0] - 80) <= 3 and abs(noted["pixel"][1] - 45) <= 3  # as the mouse is placed
    assert noted["names"] == ["Cube", "Material"]
    assert noted["standard_error"] > 0.0
    assert noted["slots"] == [0, 1]
    assert noted["compare"] == ["FINISHED"]
    assert 0.0 < noted["rmse"] < 0.1 and 0.0 < noted["flip"] < 0.2
    assert noted["shown"] == "TRG Difference"
    assert (pictures / "image_editor.png").stat().st_size > 10_000

"""Reading rendered files and the small programs that the tests render."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import OpenEXR

ROOT = Path(__file__).resolve().parents[2]
FENCE = ROOT / "examples" / "fence.trg"

GOOD_PROGRAM = """Scene = scene();
Scene.Add(plane(vec3(0, 1, 0), 0, material::silver()));
Scene.Add(tor(vec3(0, 1, 0), 0.4, 1.5, material::green_plastic()));
Scene.Add(dir_light(vec3(-7, 5, 8), vec3(1, 1, 1)));
i = 0;
while (1)
{
    Scene.CamSet(160, 90, vec3(6, 3, 6 * mth::sin(i / 180 * 3.14)), vec3(0, 1, 0), vec3(0, 1, 0));
    Scene.Render();
    i += 3;
}
"""

# The bracket of the second line is never closed.
FAULTY_PROGRAM = "a = 1;\nScene = scene(;\n"


def write_program(directory: Path, name: str, text: str) -> Path:
    """The path of a program written to `directory`."""
    path = directory / name
    path.write_text(text, encoding="utf-8")
    return path


def read_exr(path: Path) -> dict[str, np.ndarray]:
    """The channels of all parts of an EXR by their full names, float32 (height, width)."""
    channels: dict[str, np.ndarray] = {}
    with OpenEXR.File(str(path), separate_channels=True) as file:
        for part in file.parts:
            for name, channel in part.channels.items():
                channels[name] = np.asarray(channel.pixels, dtype=np.float32)
    return channels


def combined(channels: dict[str, np.ndarray]) -> np.ndarray:
    """Red, green and blue of the combined pass, (height, width, 3), however its layer is called."""

    def find(letter: str) -> np.ndarray:
        names = [name for name in channels if name == letter or name.endswith(f"Combined.{letter}")]
        return channels[names[0]]

    return np.stack([find(letter) for letter in "RGB"], axis=-1)

"""Renders the pictures of README.md and docs/examples.md from the examples.

Usage: python tools/make_pictures.py [NAME ...]      default: all, in docs/images/

Needs the built checkout and Pillow. A picture above 400 kB is stored with a palette of 256 colours.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
IMAGES = ROOT / "docs" / "images"
MAX_BYTES = 400_000
COLOURS = 256
GAP = 4


@dataclass(frozen=True, slots=True)
class Picture:
    """One file; several views make a contact sheet. A view is (example, frame)."""

    views: tuple[tuple[str, int], ...]
    size: tuple[int, int]
    samples: int
    columns: int = 1


def alone(example: str, size: tuple[int, int], samples: int) -> Picture:
    return Picture(((example, 1),), size, samples)


PICTURES = {
    "fence": alone("fence", (960, 540), 320),
    "hello": alone("hello", (640, 360), 384),
    "features": Picture(
        tuple((name, 1) for name in ("materials", "lights", "textures", "instances", "functions", "paper")),
        (360, 203), 128, 3,
    ),
    "stl_materials": alone("stl_materials", (720, 285), 256),
    "stl_stairs": alone("stl_stairs", (720, 405), 224),
    "stl_gears": alone("stl_gears", (720, 405), 224),
    "stl_springs": alone("stl_springs", (720, 405), 192),
    "stl_garden": alone("stl_garden", (720, 405), 224),
    "stl_arrangements": alone("stl_arrangements", (720, 405), 160),
    "stl_cameras": Picture(
        tuple(("stl_cameras", frame) for frame in (3, 19, 49, 96, 103, 134)), (360, 203), 144, 3
    ),
}  # fmt: skip


def render_view(example: str, frame: int, picture: Picture, folder: Path) -> Image.Image:
    """One view. RuntimeError when `trg render` fails."""
    target = folder / f"{example}_{frame}.png"
    width, height = picture.size
    command = [
        sys.executable, "-m", "trg_blender", "render", f"examples/{example}.trg", "-o", str(target),
        "--size", f"{width}x{height}", "--samples", str(picture.samples), "--frame", str(frame), "--quiet",
    ]  # fmt: skip
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{' '.join(command)} failed:\n{done.stdout}{done.stderr}")
    return Image.open(target).convert("RGB")


def contact_sheet(views: list[Image.Image], columns: int) -> Image.Image:
    """The views in rows with white gaps; a single one as it is."""
    if len(views) == 1:
        return views[0]
    width, height = views[0].size
    rows = -(-len(views) // columns)
    sheet = Image.new("RGB", (columns * (width + GAP) - GAP, rows * (height + GAP) - GAP), "white")
    for number, view in enumerate(views):
        row, column = divmod(number, columns)
        sheet.paste(view, (column * (width + GAP), row * (height + GAP)))
    return sheet


def save(picture: Image.Image, path: Path) -> None:
    """Write a PNG; with a palette where it would be too large."""
    picture.save(path, optimize=True)
    if path.stat().st_size > MAX_BYTES:
        palette = picture.quantize(COLOURS, kmeans=4, dither=Image.Dither.NONE)
        dithered = picture.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG)
        dithered.save(path, optimize=True)


def main(names: list[str]) -> int:
    """Make the pictures named; 2 for a name that is none."""
    unknown = [name for name in names if name not in PICTURES]
    if unknown:
        sys.stderr.write(f"no picture is called {', '.join(unknown)}; there are {', '.join(PICTURES)}\n")
        return 2
    IMAGES.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        for name in names or list(PICTURES):
            picture = PICTURES[name]
            views = [render_view(*view, picture, Path(folder)) for view in picture.views]
            save(contact_sheet(views, picture.columns), IMAGES / f"{name}.png")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

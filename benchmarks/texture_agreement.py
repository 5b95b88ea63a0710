"""Texture nodes by TRG and by Cycles in one Blender, square by square: do the values agree?

    .venv/3.13/bin/python -m benchmarks.texture_agreement [--sheet FILE.png] [NAME ...]

Method. A plane of 96 x 96 squares, each with one texture coordinate, glows with the node's output; one pixel
sees one square, so that both engines evaluate the node at the same coordinates and the pictures differ by
nothing but the evaluation. Given are the largest and the mean difference, the largest again without the
hundredth of the pixels that differ most (steps fall to either side by rounding), and the range of values.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path

import bpy
import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from benchmarks.texture_cases import CASES  # noqa: E402
from benchmarks.texture_scene import SIDE, build_stage, show  # noqa: E402
from trg_blender.engine import session  # noqa: E402
from trg_blender.engine.from_blender.sync import SceneReader  # noqa: E402
from trg_blender.engine.scene_arrays import RenderSettings  # noqa: E402

Picture = NDArray[np.float32]


def render_cycles(folder: Path) -> Picture:
    """(SIDE, SIDE, 3), bottom row first."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 4, False
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 0.5
    scene.view_settings.view_transform = "Raw"
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = str(folder / "cycles.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    flat = np.empty(SIDE * SIDE * image.channels, np.float32)
    image.pixels.foreach_get(flat)
    channels = image.channels
    bpy.data.images.remove(image)
    return flat.reshape(SIDE, SIDE, channels)[..., :3]


def render_trg(device: str = "cpu") -> tuple[Picture, list[str]]:
    depsgraph = bpy.context.evaluated_depsgraph_get()
    arrays = SceneReader().read(bpy.context.scene, depsgraph, (SIDE, SIDE))
    settings = RenderSettings(SIDE, SIDE, samples=8, max_bounces=0, device=device, threads=1)
    result = session.render(arrays, settings)
    return np.asarray(result.pixels)[..., :3], arrays.warnings


def compare(name: str, folder: Path) -> tuple[Picture, str]:
    case = CASES[name]
    show(build_stage(case.span, case.start), case.build)
    start = time.perf_counter()
    ours, warnings = render_trg()
    seconds = time.perf_counter() - start
    theirs = render_cycles(folder)
    difference = np.abs(ours.astype(np.float64) - theirs).max(axis=2)
    most = np.sort(difference.ravel())[: int(0.99 * difference.size)].max()
    figures = f"{difference.max():9.2e} {difference.mean():9.2e} {most:9.2e}"
    line = f"{name:28} {figures}   {theirs.min():7.3f} to {theirs.max():7.3f} {seconds:5.1f} s"
    return ours, "\n".join([line, *(f"    {warning}" for warning in warnings)])


def write_sheet(pictures: list[Picture], path: Path) -> None:
    """The pictures in rows of eight, as they look."""
    rows = -(-len(pictures) // 8)
    sheet = np.zeros((rows * (SIDE + 4), 8 * (SIDE + 4), 4), np.float32)
    for number, picture in enumerate(pictures):
        top, left = (rows - 1 - number // 8) * (SIDE + 4), (number % 8) * (SIDE + 4)
        shown = np.clip(picture, 0.0, 1.0)
        sheet[top : top + SIDE, left : left + SIDE, :3] = np.where(
            shown <= 0.0031308, shown * 12.92, 1.055 * shown ** (1 / 2.4) - 0.055
        )
    sheet[..., 3] = 1.0
    image = bpy.data.images.new("sheet", sheet.shape[1], sheet.shape[0])
    image.pixels.foreach_set(sheet.ravel())
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--sheet", type=Path)
    options = parser.parse_args()
    names = [name for name in CASES if not options.names or any(part in name for part in options.names)]
    pictures = []
    out = sys.stdout.write
    out(f"Blender {bpy.app.version_string}\n{'case':28} {'largest':>9} {'mean':>9} {'99 %':>9}   range\n")
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            picture, text = compare(name, Path(folder))
            pictures.append(picture)
            out(text + "\n")
    if options.sheet:
        write_sheet(pictures, options.sheet.resolve())


if __name__ == "__main__":
    main()

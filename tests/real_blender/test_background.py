"""`blender -b scene.blend -E TRG -o //out -f 1`: files, exit codes, pixels."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from .real_blender_tool import ROOT, RealBlender
from .rendered_files import FAULTY_PROGRAM, FENCE, GOOD_PROGRAM, combined, read_exr, write_program


def make_blend(blender: RealBlender, directory: Path, program: Path | None, percent: int = 100) -> Path:
    """A .blend of the default scene that TRG renders with 8 samples."""
    blend = directory / "scene.blend"
    done = blender.script("make_blend.py", blend, program or "-", "8", str(percent))
    assert done.status == 0, done.text
    return blend


def render(blender: RealBlender, blend: Path, kind: str, *extra: str) -> str:
    """Renders frame 1 to out_0001 beside the .blend; returns what Blender printed."""
    done = blender.run("-b", blend, "-E", "TRG", "-o", "//out_", "-F", kind, *extra, "-f", "1")
    assert done.status == 0, done.text
    return done.text


def test_program_renders_to_png(blender: RealBlender, tmp_path: Path) -> None:
    blend = make_blend(blender, tmp_path, write_program(tmp_path, "scene.trg", GOOD_PROGRAM))
    text = render(blender, blend, "PNG")
    png = tmp_path / "out_0001.png"
    assert png.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    assert int.from_bytes(png.read_bytes()[16:20], "big") == 160
    assert "Traceback" not in text


def test_exr_is_linear_and_holds_the_passes(blender: RealBlender, tmp_path: Path) -> None:
    blend = make_blend(blender, tmp_path, write_program(tmp_path, "scene.trg", GOOD_PROGRAM))
    render(blender, blend, "OPEN_EXR_MULTILAYER")
    channels = read_exr(tmp_path / "out_0001.exr")
    picture = combined(channels)
    assert picture.shape == (90, 160, 3)
    assert np.isfinite(picture).all()
    assert picture.max() > 0.05
    assert picture.std() > 0.01


def test_papers_program_renders(blender: RealBlender, tmp_path: Path) -> None:
    blend = make_blend(blender, tmp_path, FENCE, percent=10)
    render(blender, blend, "OPEN_EXR_MULTILAYER")
    picture = combined(read_exr(tmp_path / "out_0001.exr"))
    assert np.isfinite(picture).all()
    assert picture.std() > 0.01


def test_default_cube_renders_without_a_program(blender: RealBlender, tmp_path: Path) -> None:
    blend = make_blend(blender, tmp_path, None, percent=20)
    render(blender, blend, "OPEN_EXR_MULTILAYER")
    picture = combined(read_exr(tmp_path / "out_0001.exr"))
    height, width = picture.shape[:2]
    corner, middle = picture[2, 2], picture[height // 2, width // 2]
    assert np.abs(corner - middle).max() > 0.01


@pytest.mark.parametrize("frames", [("-f", "1"), ("-s", "1", "-e", "2", "-a")], ids=["still", "animation"])
def test_faulty_program_gives_status_1_and_no_file(
    blender: RealBlender, tmp_path: Path, frames: tuple[str, ...]
) -> None:
    blend = make_blend(blender, tmp_path, write_program(tmp_path, "scene.trg", FAULTY_PROGRAM))
    done = blender.run("-b", blend, "-E", "TRG", "-o", "//out_", "-F", "PNG", *frames)
    assert done.status == 1, done.text
    assert not list(tmp_path.glob("out_*"))
    assert "scene.trg:2:" in done.text
    assert "Traceback" not in done.text


def test_animation_moves_the_camera(blender: RealBlender, tmp_path: Path) -> None:
    blend = make_blend(blender, tmp_path, write_program(tmp_path, "scene.trg", GOOD_PROGRAM), percent=50)
    done = blender.run(
        "-b", blend, "-E", "TRG", "-o", "//out_", "-F", "OPEN_EXR_MULTILAYER", "-s", "1", "-e", "3", "-a"
    )
    assert done.status == 0, done.text
    pictures = [combined(read_exr(tmp_path / f"out_000{frame}.exr")) for frame in (1, 2, 3)]
    assert np.abs(pictures[0] - pictures[1]).max() > 0.01
    assert np.abs(pictures[1] - pictures[2]).max() > 0.01


def test_module_and_program_give_the_same_pixels(first_blender: RealBlender, tmp_path: Path) -> None:
    program = write_program(tmp_path, "scene.trg", GOOD_PROGRAM)
    blend = make_blend(first_blender, tmp_path, program)
    render(first_blender, blend, "OPEN_EXR_MULTILAYER")
    module_file = tmp_path / "module.exr"
    command = [
        sys.executable,
        "-m",
        "trg_blender",
        "render",
        str(program),
        "-o",
        str(module_file),
        "--samples",
        "8",
        "--quiet",
    ]
    environment = {name: value for name, value in os.environ.items() if name != "BLENDER_USER_RESOURCES"}
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    program_picture = combined(read_exr(tmp_path / "out_0001.exr"))
    module_picture = combined(read_exr(module_file))
    assert np.array_equal(program_picture, module_picture), np.abs(program_picture - module_picture).max()

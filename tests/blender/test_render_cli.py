"""`trg render` as its user sees it: files, words, exit codes. Each call is a process of its own."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("bpy")
pytest.importorskip("OpenEXR")

from .stage import read_exr  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]

PROGRAM = """Scene = scene();
Scene.Add(plane(vec3(0, 1, 0), 0, material::silver()));
Scene.Add(tor(vec3(0, 1, 0), 0.4, 1.5, material::green_plastic()));
Scene.Add(dir_light(vec3(-7, 5, 8), vec3(1, 1, 1)));
i = 0;
while (1)
{
    Scene.CamSet(64, 36, vec3(6 - i, 3, 6), vec3(0, 1, 0), vec3(0, 1, 0));
    Scene.Render();
    i += 3;
}
"""

MAKE_BLEND = """
import sys, bpy
sys.path.insert(0, {root!r})
from trg_blender.ui import registration
registration.register()
scene = bpy.context.scene
scene.render.engine = "TRG"
scene.render.resolution_x, scene.render.resolution_y = 64, 36
scene.trg.samples = 8
scene.frame_set(3)
{extra}
bpy.ops.wm.save_as_mainfile(filepath={path!r})
"""


def trg(*words, env=None, **options):
    """Runs `trg` and gives the finished process with its output as text."""
    command = [sys.executable, "-W", "ignore", "-m", "trg_blender", *map(str, words)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT), **(env or {})}
    return subprocess.run(
        command, capture_output=True, text=True, timeout=120, env=environment, check=False, **options
    )


def make_blend(path, extra=""):
    script = MAKE_BLEND.format(root=str(ROOT), path=str(path), extra=extra)
    subprocess.run([sys.executable, "-W", "ignore", "-c", script], check=True, capture_output=True)
    return path


@pytest.fixture(scope="module")
def cube(tmp_path_factory):
    """The default scene, 64 x 36, 8 samples, at frame 3."""
    return make_blend(tmp_path_factory.mktemp("blend") / "cube.blend")


@pytest.fixture
def program(tmp_path):
    path = tmp_path / "torus.trg"
    path.write_text(PROGRAM)
    return path


def test_a_blend_file_to_png_with_a_report(cube, tmp_path):
    """The folder is made, the current frame is rendered, the paragraph and the report say the same."""
    picture, report = tmp_path / "new" / "folder" / "cube.png", tmp_path / "reports" / "cube.json"
    done = trg("render", cube, "-o", picture, "--report", report, "--samples", 16, "--size", "32x20")
    assert done.returncode == 0, done.stderr
    data = picture.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    assert [int.from_bytes(data[at : at + 4], "big") for at in (16, 20)] == [32, 20]
    assert data[24] == 8, "bits a channel"
    facts = json.loads(report.read_text())
    assert facts["size"] == [32, 20] and facts["samples"] == 16 and facts["frame"] == 3
    assert facts["file"] == str(cube)
    assert "32 x 20, 16 samples a pixel" in done.stdout and "95 % interval" in done.stdout
    assert f"rmse {facts['error']['rmse']:.4g}" in done.stdout


def test_exr_is_float_and_same_as_blenders_own_render(cube, tmp_path):
    """bpy.ops.render.render in a process without the command gives the same pixels."""
    assert trg("render", cube, "-o", tmp_path / "cube.exr", "--quiet").returncode == 0
    ours, _ = read_exr(tmp_path / "cube.exr")
    other = tmp_path / "other.exr"
    make_blend(
        tmp_path / "again.blend",
        "image = scene.render.image_settings\n"
        "image.file_format, image.color_depth = 'OPEN_EXR', '32'\n"
        f"scene.render.filepath = {str(other)!r}\n"
        "bpy.ops.render.render(write_still=True)",
    )
    theirs, _ = read_exr(other)
    for name in "RGB":
        assert ours[name].dtype == np.float32 and ours[name].std() > 0.005
        np.testing.assert_array_equal(ours[name], theirs[name])


def test_frames_are_numbered(cube, tmp_path):
    reports = tmp_path / "all.json"
    done = trg("render", cube, "-o", tmp_path / "f.png", "--frames", "2-3", "--report", reports, "--quiet")
    assert done.returncode == 0 and done.stdout == "" and done.stderr == ""
    assert sorted(path.name for path in tmp_path.glob("*.png")) == ["f_0002.png", "f_0003.png"]
    assert [each["frame"] for each in json.loads(reports.read_text())] == [2, 3]
    assert trg("render", cube, "-o", tmp_path / "g##x.png", "--frame", 7, "--quiet").returncode == 0
    assert (tmp_path / "g07x.png").is_file()


def test_piped_progress_is_plain_lines(cube, tmp_path):
    done = trg("render", cube, "-o", tmp_path / "p.png", "--device", "embree", "--samples", 64)
    assert done.returncode == 0, done.stderr
    lines = done.stderr.splitlines()
    assert lines and all(line.startswith("frame 3: sample ") for line in lines)
    assert "\r" not in done.stderr and len(lines) <= 12


@pytest.mark.parametrize(
    "words",
    [
        ["scene.txt"],
        ["a.blend", "-o", "a.jpg"],
        ["a.blend", "--size", "0x5"],
        ["a.blend", "--size", "big"],
        ["a.blend", "--samples", "0"],
        ["a.blend", "--frames", "5-2"],
        ["a.blend", "--frame", "1", "--frames", "1-2"],
        ["a.blend", "--device", "toaster"],
    ],
)
def test_usage_errors_have_status_2(words):
    done = trg("render", *words)
    assert done.returncode == 2 and "usage:" in done.stderr


def test_what_is_wrong_with_the_scene_has_status_1(tmp_path):
    """No file, a file that is no .blend, no camera: a sentence each, and no picture."""
    picture = tmp_path / "x.png"
    done = trg("render", tmp_path / "none.blend", "-o", picture)
    assert done.returncode == 1 and "none.blend" in done.stderr
    (tmp_path / "noise.blend").write_bytes(b"not a blend file at all" * 10)
    done = trg("render", tmp_path / "noise.blend", "-o", picture)
    assert done.returncode == 1 and "noise.blend" in done.stderr
    blind = make_blend(tmp_path / "blind.blend", "scene.camera = None")
    done = trg("render", blind, "-o", picture)
    assert done.returncode == 1 and "camera" in done.stderr
    assert "Traceback" not in done.stderr and not picture.exists()


def test_missing_devices_and_modules_have_status_4(cube, tmp_path):
    done = trg("render", cube, "-o", tmp_path / "x.png", "--device", "cuda")
    assert done.returncode == 4 and "device cuda: not built yet" in done.stderr
    (tmp_path / "bpy.py").write_text("raise ImportError('no Blender here')")
    paths = os.pathsep.join([str(tmp_path), str(ROOT)])
    done = trg("render", cube, "-o", tmp_path / "x.png", env={"PYTHONPATH": paths})
    assert done.returncode == 4 and "bpy cannot be loaded" in done.stderr and "pip install" in done.stderr


def hear_interrupts() -> None:
    """For a child: tests started by a shell in the background ignore SIGINT, and children inherit that."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


def test_an_interrupt_has_status_3_and_leaves_no_file(cube, tmp_path):
    """^C while samples are traced."""
    picture = tmp_path / "long.png"
    command = [sys.executable, "-W", "ignore", "-m", "trg_blender", "render", str(cube), "-o", str(picture)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with subprocess.Popen(
        [*command, "--samples", "3000", "--device", "embree"],
        stderr=subprocess.PIPE, text=True, env=environment, preexec_fn=hear_interrupts,
    ) as process:  # fmt: skip
        assert "sample" in process.stderr.readline()
        process.send_signal(signal.SIGINT)
        rest = process.stderr.read()
        assert process.wait(timeout=20) == 3
    assert "cancelled" in rest and "Traceback" not in rest and not picture.exists()


def test_a_program_to_png_and_layered_exr(program, tmp_path):
    """Frame 2 of the program is its second Scene.Render(); the passes are layers."""
    report = tmp_path / "r.json"
    done = trg("render", program, "-o", tmp_path / "one.exr", "--samples", 8, "--report", report)
    assert done.returncode == 0, done.stderr
    channels, _ = read_exr(tmp_path / "one.exr")
    assert channels["ViewLayer.Combined.R"].shape == (36, 64)
    assert {"ViewLayer.Depth.Z", "ViewLayer.Normal.X"} <= set(channels)
    assert json.loads(report.read_text())["seconds"]["script"] > 0
    done = trg("render", program, "-o", tmp_path / "two.exr", "--samples", 8, "--frame", 2)
    assert done.returncode == 0, done.stderr
    second = read_exr(tmp_path / "two.exr")[0]["ViewLayer.Combined.R"]
    assert np.abs(second - channels["ViewLayer.Combined.R"]).mean() > 0.01
    assert trg("render", program, "-o", tmp_path / "p.png", "--size", "20x20", "--quiet").returncode == 0
    assert int.from_bytes((tmp_path / "p.png").read_bytes()[16:20], "big") == 20


def test_a_faulty_program_has_status_1_and_its_place(program, tmp_path):
    program.write_text("a = 1;\nScene = scene(;\n")
    done = trg("render", program, "-o", tmp_path / "x.png")
    assert done.returncode == 1 and "torus.trg:2:" in done.stderr
    assert "Traceback" not in done.stderr and not (tmp_path / "x.png").exists()


HOT_LAMP = """
bpy.data.objects["Light"].location = (0.5, 0.5, 1.00001)
lamp = bpy.data.objects["Light"].data
lamp.energy, lamp.shadow_soft_size = 1e38, 0
"""


def test_a_sample_that_is_no_number_is_named_and_can_be_repeated(tmp_path):
    make_blend(tmp_path / "hot.blend", HOT_LAMP)
    done = trg("render", "hot.blend", "-o", "whole.png", "--report", "whole.json", cwd=tmp_path)
    whole = json.loads((tmp_path / "whole.json").read_text())["numerics"]
    first = whole["rejected_places"][0]
    assert whole["rejected_samples"] > 0
    assert f"pixel {first['x']},{first['y']}, sample {first['sample']}" in done.stdout
    (repeat,) = [line for line in done.stdout.splitlines() if line.startswith("repeat: trg ")]
    words = repeat.removeprefix("repeat: trg ").split()
    again = trg(*words, "--report", "pixel.json", cwd=tmp_path)
    assert again.returncode == 0
    assert json.loads((tmp_path / "pixel.json").read_text())["numerics"]["rejected_places"] == [first]


def test_a_pixel_outside_the_picture_is_a_usage_error(cube, tmp_path):
    done = trg("render", cube, "-o", tmp_path / "a.png", "--pixel", "64,0")
    assert done.returncode == 2
    assert "the picture has 64 x 36" in done.stderr

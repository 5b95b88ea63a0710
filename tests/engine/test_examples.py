"""The example programs run to their first frames and ask for nothing that is not there."""

from __future__ import annotations

import pytest

from trg_blender.lang import FrameEvent, HostOptions, Session, compile_source
from trg_blender.lang.files import DiskFiles
from trg_blender.lang.scene import SceneDescription

from .samples import ROOT

FOLDER = ROOT / "examples"
EXAMPLES = sorted(path.name for path in FOLDER.glob("*.trg"))
COMPLETE = [name for name in EXAMPLES if name != "paper.trg"]


def start(name: str) -> Session:
    text = (FOLDER / name).read_text(encoding="utf-8")
    return Session(compile_source(text, name, DiskFiles(FOLDER)), HostOptions())


def first_scene(session: Session) -> SceneDescription:
    event = session.next_frame()
    assert isinstance(event, FrameEvent), session.diagnostics
    return event.scene


@pytest.mark.parametrize("name", COMPLETE)
def test_an_example_hands_over_a_whole_scene_without_a_complaint(name: str):
    session = start(name)
    scene = first_scene(session)
    assert scene.camera is not None and scene.shapes and scene.lights
    assert [diagnostic.message for diagnostic in session.diagnostics] == []


@pytest.mark.parametrize("name", COMPLETE)
def test_every_file_that_an_example_names_is_there(name: str):
    scene = first_scene(start(name))
    textures = [t for shape in scene.shapes if shape.material for _, t in shape.material.textures]
    assert all(texture.path for texture in textures)
    assert all(shape.path for shape in scene.shapes if shape.kind == "model")


def test_the_fence_has_its_cones_its_elephant_and_a_camera_that_moves():
    session = start("fence.trg")
    scene = first_scene(session)
    kinds = [shape.kind for shape in scene.shapes]
    assert [kinds.count(kind) for kind in ("fence", "conus", "tor", "model", "plane")] == [1, 6, 1, 1, 1]
    assert first_scene(session).camera != scene.camera


def test_the_printed_program_misses_its_cow_only_and_says_so_once():
    session = start("paper.trg")
    scene = first_scene(session)
    assert [shape.path for shape in scene.shapes if shape.kind == "model"] == [None]
    told = [diagnostic.message for diagnostic in session.diagnostics]
    assert sum("cow.g3dm" in line for line in told) == 1


def test_a_thousand_instances_share_one_mesh():
    scene = first_scene(start("instances.trg"))
    balls = [shape for shape in scene.shapes if shape.kind == "sphere"]
    assert len(balls) == 1000
    assert len({ball.mesh_key for ball in balls}) == 1

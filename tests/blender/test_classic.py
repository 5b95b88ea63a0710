"""What programs and users say of the classic integrator and antialiasing reaches the engine."""

from __future__ import annotations

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.engine.from_blender import SceneReader  # noqa: E402
from trg_blender.engine.render_engine import settings_of  # noqa: E402
from trg_blender.engine.result import records  # noqa: E402
from trg_blender.engine.to_blender import requested_modes  # noqa: E402
from trg_blender.engine.to_blender.program_runner import ProgramRunner  # noqa: E402
from trg_blender.ui import registration  # noqa: E402

PROGRAM = """
std::setaa("supersampling", 3);
Scene = scene();
Scene.Ambient(vec3(0.1, 0.2, 0.3));
ball = material::red_plastic();
ball.Reflect(0.25);
Scene.Add(sphere(vec3(0, 1, 0), 1, ball));
pane = material::green_plastic();
pane.Refract(0.5, 1.2);
Scene.Add(sphere(vec3(3, 1, 0), 1, pane));
Scene.Add(plane(vec3(0, 1, 0), 0, material::pbr(vec3(0.5))));
Scene.Add(dir_light(vec3(-7, 5, 8), vec3(1, 1, 1)));
x = 0;
while (1)
{
    Scene.CamSet(48, 32, vec3(6 + x, 3, 6), vec3(0, 1, 0), vec3(0, 1, 0));
    Scene.Render();
    x += 0.05;
}
"""


@pytest.fixture
def scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    registration.register()
    yield bpy.context.scene
    registration.unregister()


@pytest.fixture
def runner(scene):
    return ProgramRunner(), new_program(scene)


def new_program(scene):
    text = bpy.data.texts.new("classic.trg")
    text.write(PROGRAM)
    return text


def run(scene, runner, frame: int) -> None:
    outcome = runner[0].run(scene, runner[1], frame)
    assert outcome.failure is None, outcome.failure
    scene.frame_set(frame)


def settings(scene, warnings=None):
    layer = bpy.context.view_layer
    return settings_of(scene, layer, (48, 32), requested_modes(scene), [] if warnings is None else warnings)


def test_a_program_chooses_antialiasing_and_the_user_has_the_last_word(scene, runner):
    run(scene, runner, 2)
    assert (settings(scene).aa, settings(scene).aa_side, settings(scene).frame) == ("supersampling", 3, 2)
    scene.trg.aa, scene.trg.aa_side, scene.trg.integrator = "jittering", 5, "classic"
    assert (settings(scene).aa, settings(scene).aa_side) == ("jittering", 5)
    assert settings(scene).integrator == "classic"


def test_a_grid_too_fine_is_held_with_a_warning(scene, runner):
    runner[1].from_string(PROGRAM.replace('supersampling", 3', 'supersampling", 99'))
    run(scene, runner, 1)
    warnings: list[str] = []
    assert settings(scene, warnings).aa_side == 64
    assert any("99 x 99" in line for line in warnings)


def test_a_programs_constants_reach_the_classic_integrator(scene, runner):
    run(scene, runner, 1)
    arrays = SceneReader().read(scene, bpy.context.evaluated_depsgraph_get(), (48, 32))
    assert arrays.ambient == pytest.approx((0.1, 0.2, 0.3))
    rows = [row for row in arrays.classic if row is not None]
    assert len(rows) == 3
    (mirror,) = [row for row in rows if row.reflect_r > 0.0]
    assert (mirror.reflect_r, mirror.reflect_b) == pytest.approx((0.25, 0.25))
    (pane,) = [row for row in rows if row.refract_g > 0.0]
    assert pane.ior == pytest.approx(1.2)
    assert pane.refract_g == pytest.approx(0.5 * np.sqrt(0.35), rel=0.01)


def rendered(scene, runner, frame: int) -> int:
    run(scene, runner, frame)
    bpy.ops.render.render()
    report = records.report_of(scene.name)
    assert report["integrator"] == "classic"
    assert report["aa"] == "mfaa"
    return report["numerics"]["reprojected_pixels"]


def test_frames_in_a_row_are_blended_by_mfaa(scene, runner):
    run(scene, runner, 1)
    scene.render.engine = "TRG"
    scene.trg.integrator, scene.trg.aa, scene.trg.aa_side = "classic", "mfaa", 2
    assert rendered(scene, runner, 1) == 0
    assert rendered(scene, runner, 2) > 0.9 * 48 * 32
    assert rendered(scene, runner, 5) == 0

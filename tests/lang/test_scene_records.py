"""The records that Scene.Render() hands over."""

from __future__ import annotations

import math

import pytest

from trg_blender.lang.scene import IDENTITY, MediumRecord

SHAPES = {
    "sphere(vec3(1, 2, 3), 4, M)": ("sphere", ((1, 2, 3), 4)),
    "box(vec3(0), vec3(1, 2, 3), M)": ("box", ((0, 0, 0), (1, 2, 3))),
    "plane(vec3(0, 1, 0), 2, M)": ("plane", ((0, 1, 0), 2)),
    "tor(vec3(0, 1, 0), 1, 5, M)": ("tor", ((0, 1, 0), 1, 5)),
    "conus(vec3(0), 1, 3, M)": ("conus", ((0, 0, 0), 1, 3)),
    "cylinder(vec3(0), 1, 3, M)": ("cylinder", ((0, 0, 0), 1, 3)),
    "fence(vec3(0, 1, 0), 15, 2, 6, M)": ("fence", ((0, 1, 0), 15, 2, 6)),
    "triangle(vec3(0), vec3(1, 0, 0), vec3(0, 1, 0), M)": ("triangle", ((0, 0, 0), (1, 0, 0), (0, 1, 0))),
    'model("a.g3dm", E, M)': ("model", ("a.g3dm",)),
}  # fmt: skip
HEAD = "Scene = scene(); M = material::gold(); E = enviroment(0.5, 1.3);"


@pytest.mark.parametrize("call", SHAPES)
def test_a_shape_becomes_its_record(call, run) -> None:
    kind, parameters = SHAPES[call]
    outcome = run(f"{HEAD} Scene.Add({call}); Scene.Render();")
    assert outcome.error is None
    (shape,) = outcome.frames[0].shapes
    assert (shape.kind, shape.parameters) == (kind, parameters)
    assert shape.material is not None and shape.material.name == "gold"
    assert (shape.transform, shape.version, shape.mesh_key) == (IDENTITY, 1, shape.key)
    assert shape.origin is not None and shape.origin.col == len(HEAD) + 12
    assert shape.medium == (MediumRecord(0.5, 1.3) if kind == "model" else MediumRecord())


def test_material_and_medium_are_optional_and_come_in_either_order(run) -> None:
    looks = ["", ", M", ", E", ", M, E", ", E, M"]
    adds = "".join(f"Scene.Add(sphere(vec3(0), 1{look}));" for look in looks)
    shapes = run(f"{HEAD} {adds} Scene.Render();").frames[0].shapes
    assert [s.material is not None for s in shapes] == [False, True, False, True, True]
    assert [s.medium.decay for s in shapes] == [0, 0, 0.5, 0.5, 0.5]
    assert run(f"{HEAD} sphere(vec3(0), 1, M, M);").error[0] == "E508"


def test_lights_become_their_records(run) -> None:
    text = (
        "Scene = scene(); c = vec3(1, 2, 3);"
        "Scene.Add(dir_light(vec3(0, 1, 0), c)); Scene.Add(point_light(vec3(1), c, 1, 2, 3));"
        "Scene.Add(spot_light(vec3(1), vec3(0, -1, 0), 20, 30, c));"
        "Scene.Add(area_light(vec3(1), vec3(0, -1, 0), 2, 4, c)); Scene.Render();"
    )
    direct, point, spot, area = run(text).frames[0].lights
    assert [x.kind for x in (direct, point, spot, area)] == ["dir", "point", "spot", "area"]
    assert all(x.color == (1, 2, 3) for x in (direct, point, spot, area))
    assert direct.direction == (0, 1, 0)
    assert (point.position, point.falloff) == ((1, 1, 1), (1, 2, 3))
    assert (spot.direction, spot.angle_in, spot.angle_out) == ((0, -1, 0), 20, 30)
    assert (area.direction, area.size) == ((0, -1, 0), (2, 4))


def test_the_camera_background_ambient_and_modes_are_handed_over(run) -> None:
    text = (
        'Scene = scene(); std::setrndmode("embree"); std::setaccel("grid"); std::setaa("jittering", 4);'
        "Scene.CamSet(64, 32, vec3(5, 1, 0), vec3(0), vec3(0, 1, 0), 40);"
        "Scene.Background(vec3(1, 0, 0)); Scene.Ambient(vec3(0.1)); Scene.Render();"
    )
    (scene,) = run(text).frames
    assert scene.camera is not None
    assert (scene.camera.width, scene.camera.height, scene.camera.fov_degrees) == (64, 32, 40)
    assert (scene.camera.location, scene.camera.target, scene.camera.up) == ((5, 1, 0), (0, 0, 0), (0, 1, 0))
    assert (scene.background, scene.ambient) == ((1, 0, 0), (0.1, 0.1, 0.1))
    modes = scene.modes
    assert (modes.device, modes.accel, modes.antialiasing, modes.antialiasing_n) == (
        "embree", "grid", "jittering", 4,
    )  # fmt: skip


def test_an_unknown_mode_warns_and_leaves_it_to_the_host(run) -> None:
    outcome = run('Scene = scene(); std::setrndmode("abacus"); Scene.Render();')
    assert outcome.warnings == [("W703", "1:18")]
    assert outcome.frames[0].modes.device is None


LOOP = """Scene = scene();
for (i = 0; i < 3; i++) Scene.Add(sphere(vec3(i, 0, 0), 1));
s = Scene.Add(sphere(vec3(9, 0, 0), 1));
while (1) { Scene.Render(); s.Move(vec3(0, 1, 0)); }
"""


def test_keys_are_stable_from_frame_to_frame_and_run_to_run(run) -> None:
    first, second = run(LOOP), run(LOOP)
    keys = [[s.key for s in scene.shapes] for scene in first.frames]
    assert keys[0] == ["sphere@2:35#1", "sphere@2:35#2", "sphere@2:35#3", "sphere@3:15#1"]
    assert all(k == keys[0] for k in keys)
    assert first.frames == second.frames


def test_only_what_changed_gets_a_new_version_and_a_new_record(run) -> None:
    frames = run(LOOP).frames
    assert [s.version for s in frames[4].shapes] == [1, 1, 1, 5]
    for before, after in zip(frames, frames[1:], strict=False):
        assert all(a is b for a, b in zip(before.shapes[:3], after.shapes[:3], strict=True))


def test_a_frame_without_a_change_hands_out_the_same_tuple(run) -> None:
    frames = run("Scene = scene(); Scene.Add(sphere(vec3(0), 1)); while (1) Scene.Render();").frames
    assert all(scene.shapes is frames[0].shapes for scene in frames)
    assert [scene.frame for scene in frames] == list(range(1, len(frames) + 1))


def test_an_edited_material_changes_every_shape_that_wears_it(run) -> None:
    text = (
        "Scene = scene(); m = material::gold();"
        "Scene.Add(sphere(vec3(0), 1, m)); Scene.Add(sphere(vec3(0), 2, m)); Scene.Add(sphere(vec3(0), 3));"
        "Scene.Render(); m.Color(vec3(1, 0, 0)); Scene.Render(); m.Color(vec3(1, 0, 0)); Scene.Render();"
    )
    first, second, third = run(text).frames
    assert [s.version for s in second.shapes] == [2, 2, 1]
    assert second.shapes[0].material.version == 2
    assert second.shapes[0].material.key == first.shapes[0].material.key
    assert third.shapes == second.shapes


def test_remove_takes_out_and_add_puts_in_once(run) -> None:
    text = (
        "Scene = scene(); s = sphere(vec3(0), 1); Scene.Add(s); Scene.Add(s); Scene.Render();"
        "Scene.Remove(s); Scene.Remove(s); Scene.Render(); Scene.Add(s); Scene.Render();"
    )
    assert [len(scene.shapes) for scene in run(text).frames] == [1, 0, 1]


def test_copies_share_the_mesh_and_move_alone(run) -> None:
    text = (
        "Scene = scene(); s = Scene.Add(sphere(vec3(0), 1)); c = Scene.Add(s.Copy());"
        'c.Move(vec3(1, 2, 3)).Name("twin"); Scene.Render();'
    )
    first, second = run(text).frames[0].shapes
    assert first.key != second.key and first.mesh_key == second.mesh_key
    assert second.transform[3::4] == (1, 2, 3) and first.transform == IDENTITY
    assert (first.name, second.name) == ("", "twin")


def test_transforms_apply_in_the_order_written(run) -> None:
    text = (
        "Scene = scene(); s = Scene.Add(sphere(vec3(0), 1));"
        "s.Move(vec3(1, 0, 0)); s.Rotate(vec3(0, 0, 1), 90); s.Scale(vec3(1, 2, 1)); Scene.Render();"
    )
    t = run(text).frames[0].shapes[0].transform
    assert t[3::4] == pytest.approx((0, 2, 0), abs=1e-12)
    assert t[0] == pytest.approx(0, abs=1e-12) and t[4] == pytest.approx(2)


def test_a_metal_reflects_at_most_95_percent_and_a_plastic_has_its_diffuse_colour(run) -> None:
    text = (
        "Scene = scene(); Scene.Add(sphere(vec3(0), 1, material::gold()));"
        "Scene.Add(sphere(vec3(0), 1, material::blue_plastic())); Scene.Render();"
    )
    gold, plastic = (s.material for s in run(text).frames[0].shapes)
    assert gold.metallic == 1 and max(gold.base_color) == pytest.approx(0.95)
    assert gold.base_color[0] > gold.base_color[1] > gold.base_color[2]
    assert plastic.metallic == 0 and plastic.base_color == (0, 0, 0.5)
    assert plastic.roughness == pytest.approx(math.sqrt(2 / 34))


def test_textures_sit_in_their_slots_and_a_missing_file_is_one_warning(run) -> None:
    text = (
        'Scene = scene(); t = texture("no.g24", 2); m = material::white_plastic();\n'
        "m.SetTexture(t, 2); m.SetTexture(t, 0); Scene.Add(sphere(vec3(0), 1, m)); Scene.Render();"
    )
    outcome = run(text)
    assert outcome.warnings == [("W702", "1:22")]
    textures = outcome.frames[0].shapes[0].material.textures
    assert [slot for slot, _ in textures] == ["base_color", "roughness"]
    assert (textures[0][1].path, textures[0][1].tiles) == (None, 2)


def test_a_missing_file_is_an_error_when_the_host_is_strict(run) -> None:
    assert run('t = texture("no.g24");', strict_files=True).error == ("E511", "1:5")

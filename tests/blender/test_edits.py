"""Edits by hand beside a program: told of when they are overwritten, kept when they are detached."""

from __future__ import annotations

import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.engine import run_text  # noqa: E402
from trg_blender.engine.to_blender.tags import KEY, OWNER, SPHERE, collection_of  # noqa: E402
from trg_blender.ui import object_panel, registration  # noqa: E402

PROGRAM = """export height = 1 ~ "num" ~ range(0, 5);
Scene = scene();
red = material::red_plastic();
if (height > 3) red.Color(vec3(0, 0, 1));
for (i = 0; i < 3; i++) Scene.Add(sphere(vec3(i * 3, height, 0), 1, red));
Scene.Add(point_light(vec3(0, 5, 0), vec3(9)));
Scene.CamSet(64, 36, vec3(0, 1, 9), vec3(0, 1, 0), vec3(0, 1, 0));
Scene.Render();
"""


@pytest.fixture()
def scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    registration.register()
    scene = bpy.context.scene
    text = bpy.data.texts.new("balls.trg")
    text.from_string(PROGRAM)
    scene.trg.program = text
    assert bpy.ops.trg.build() == {"FINISHED"}
    yield scene
    registration.unregister()


def balls(scene):
    return [obj for obj in scene.objects if obj.type == "MESH"]


def select(*objects):
    for each in bpy.context.view_layer.objects:
        each.select_set(each in objects)


def build_at(scene, height: float) -> list[str]:
    """Runs the program with another height; gives what the log says new."""
    said = len(run_text.program_log(scene))
    scene.trg.parameters["height"] = height
    assert bpy.ops.trg.build() == {"FINISHED"}
    return run_text.program_log(scene)[said:]


def test_an_object_tells_the_line_that_made_it(scene):
    assert object_panel.place_of(balls(scene)[0]["trg_origin"])[:2] == ("balls.trg", 5)
    assert object_panel.place_of("") == ("", 1, 1)


def test_an_edit_stays_while_the_program_says_the_same(scene):
    ball = balls(scene)[1]
    ball.location.x = 50.0
    assert build_at(scene, 1.0) == []
    assert ball.location.x == 50.0


def test_an_edit_that_the_program_overwrites_is_told_of(scene):
    ball = balls(scene)[1]
    ball.location.x = 50.0
    said = build_at(scene, 2.0)
    assert len(said) == 1 and said[0].startswith(f"{ball.name}: was moved by hand")
    assert ball.location.x == pytest.approx(3.0)
    assert build_at(scene, 2.5) == []


def test_a_material_edited_by_hand_is_told_of(scene):
    material = balls(scene)[0].material_slots[0].material
    shader = next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    shader.inputs["Roughness"].default_value = 0.9
    assert build_at(scene, 2.0) == []  # the material's own record is the same
    assert shader.inputs["Roughness"].default_value == pytest.approx(0.9)
    (said,) = build_at(scene, 4.0)
    assert said.startswith(f"{material.name}: was edited by hand")


def test_a_detached_object_is_left_alone_and_not_made_again(scene):
    first, second, _ = balls(scene)
    select(second)
    assert bpy.ops.trg.detach() == {"FINISHED"}
    assert KEY not in second and SPHERE not in second
    assert second.data != first.data and OWNER not in second.material_slots[0].material
    build_at(scene, 2.0)
    assert second.location.z == pytest.approx(1.0) and first.location.z == pytest.approx(2.0)
    assert len(balls(scene)) == 3
    assert not bpy.ops.trg.detach.poll()
    assert bpy.ops.trg.attach_all() == {"FINISHED"}
    build_at(scene, 2.5)
    assert len(balls(scene)) == 4


def test_detached_objects_survive_another_program(scene):
    before = set(scene.objects.keys())
    collection = collection_of(scene)
    assert bpy.ops.trg.detach_all() == {"FINISHED"}
    assert scene.trg.program is None and collection_of(scene) is None
    assert not [name for name in collection.keys() if name.startswith("trg_")]  # noqa: SIM118
    text = bpy.data.texts.new("other.trg")
    text.from_string(PROGRAM.replace("i < 3", "i < 2"))
    scene.trg.program = text
    assert bpy.ops.trg.build() == {"FINISHED"}
    assert before <= set(scene.objects.keys())
    assert len(balls(scene)) == 5
    assert collection_of(scene) != collection


def test_copies_by_the_hundred_are_detached_with_their_source(scene):
    scene.trg.program.from_string(PROGRAM.replace("i < 3", "i < 300"))
    assert bpy.ops.trg.build() == {"FINISHED"}
    (copies,) = [obj for obj in scene.objects if obj.type == "MESH"]
    select(copies)
    assert bpy.ops.trg.detach() == {"FINISHED"}
    scene.trg.program.from_string(PROGRAM.replace("i < 3", "i < 0"))
    assert bpy.ops.trg.build() == {"FINISHED"}
    graph = bpy.context.evaluated_depsgraph_get()
    assert sum(each.is_instance for each in graph.object_instances) == 300

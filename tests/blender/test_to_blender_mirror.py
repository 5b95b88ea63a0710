"""The mirror: what it touches, what it shares, what it finds again, and what it refuses."""

from __future__ import annotations

import struct
from dataclasses import replace
from math import inf, nan

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.engine.to_blender import SceneError, SceneMirror, requested_modes  # noqa: E402
from trg_blender.engine.to_blender.tags import KEY, KIND, ORIGIN  # noqa: E402
from trg_blender.lang.scene import (  # noqa: E402
    CameraRecord,
    LightRecord,
    MaterialRecord,
    RenderModes,
    SceneDescription,
    ShapeRecord,
    TextureRecord,
)
from trg_blender.lang.source import Span  # noqa: E402

RED = MaterialRecord("material@1:1#1", 1, "red", base_color=(1.0, 0.0, 0.0))
CAMERA = CameraRecord(640, 480, (30.0, 10.0, 0.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0))
PLACE = Span("scene.trg", 12, 5, 12, 30)


def spheres(count: int, **more) -> tuple[ShapeRecord, ...]:
    return tuple(
        ShapeRecord(
            f"sphere@2:1#{i}",
            1,
            "sphere",
            ((float(i), 1.0, 2.0), 0.5),
            f"sphere@2:1#{i}",
            RED,
            origin=PLACE,
            **more,
        )
        for i in range(count)
    )


@pytest.fixture
def scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return bpy.context.scene


def by_key(scene) -> dict:
    return {obj[KEY]: obj for obj in scene.objects if KEY in obj}


def test_moving_one_of_fifty_shapes_touches_one_object(scene):
    mirror, shapes = SceneMirror(scene), spheres(50)
    mirror.apply(SceneDescription(1, shapes, camera=CAMERA))
    bpy.context.view_layer.update()
    touched = []

    def note(_, depsgraph):
        touched.extend(
            update.id.name for update in depsgraph.updates if isinstance(update.id, bpy.types.Object)
        )

    moved = replace(shapes[7], version=2, parameters=((7.0, 9.0, 2.0), 0.5))
    bpy.app.handlers.depsgraph_update_post.append(note)
    try:
        counts = mirror.apply(SceneDescription(2, (*shapes[:7], moved, *shapes[8:]), camera=CAMERA))
        bpy.context.view_layer.update()
    finally:
        bpy.app.handlers.depsgraph_update_post.remove(note)
    assert (counts.updated, counts.total) == (1, 1)
    assert set(touched) == {moved.key}
    assert tuple(by_key(scene)[moved.key].matrix_world.translation) == (7.0, -2.0, 9.0)


def test_an_equal_frame_touches_nothing_even_for_a_fresh_mirror(scene):
    light = LightRecord("light@1", 1, "dir", (1.0, 1.0, 1.0))
    frame = SceneDescription(1, spheres(3), (light,), CAMERA)
    assert SceneMirror(scene).apply(frame).made == 5
    fresh = SceneMirror(scene)
    assert fresh.apply(frame).total == 0
    assert fresh.apply(replace(frame, frame=2)).total == 0


def test_a_saved_file_is_updated_not_duplicated(scene, tmp_path):
    frame = SceneDescription(1, spheres(3), (LightRecord("light@1", 1, "point", (1.0, 1.0, 1.0)),), CAMERA)
    SceneMirror(scene).apply(frame)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "scene.blend"))
    scene = bpy.context.scene
    counts = SceneMirror(scene).apply(replace(frame, shapes=spheres(2)))
    assert (counts.made, counts.updated, counts.deleted, counts.total) == (0, 0, 1, 1)
    assert len(scene.objects) == 4
    assert len(bpy.data.collections) == 1


def test_objects_carry_key_kind_and_place(scene):
    SceneMirror(scene).apply(SceneDescription(1, spheres(1)))
    (obj,) = scene.objects
    assert (obj[KEY], obj[KIND], obj[ORIGIN]) == ("sphere@2:1#0", "sphere", "scene.trg:12:5")
    assert tuple(obj["trg_sphere"]) == (0.0, 0.0, 0.0, 1.0)
    assert tuple(obj.scale) == (0.5, 0.5, 0.5)


def test_equal_shapes_share_one_mesh_whatever_their_size_and_material(scene):
    shapes = spheres(2)
    blue = replace(RED, key="material@1:1#2", base_color=(0.0, 0.0, 1.0))
    shapes = (shapes[0], replace(shapes[1], parameters=((0.0, 0.0, 0.0), 2.0), material=blue))
    SceneMirror(scene).apply(SceneDescription(1, shapes))
    first, second = scene.objects
    assert first.data == second.data
    assert {obj.material_slots[0].material.name for obj in (first, second)} == {"red", "red.001"}


def test_equal_materials_become_one_and_part_when_one_changes(scene):
    twin = replace(RED, key="material@1:1#2")
    shapes = spheres(2)
    shapes = (shapes[0], replace(shapes[1], material=twin))
    mirror = SceneMirror(scene)
    assert mirror.apply(SceneDescription(1, shapes)).materials_made == 1
    green = replace(twin, version=2, base_color=(0.0, 1.0, 0.0))
    counts = mirror.apply(SceneDescription(2, (shapes[0], replace(shapes[1], version=2, material=green))))
    assert (counts.materials_made, counts.materials_updated, counts.updated) == (1, 0, 1)


def test_a_material_edit_touches_the_material_alone(scene):
    mirror, shapes = SceneMirror(scene), spheres(5)
    mirror.apply(SceneDescription(1, shapes))
    edited = replace(RED, version=2, roughness=0.1)
    counts = mirror.apply(SceneDescription(2, tuple(replace(s, material=edited) for s in shapes)))
    assert (counts.materials_updated, counts.total) == (1, 1)


def test_vanished_shapes_lights_and_their_data_are_removed_and_the_users_objects_stay(scene):
    own = bpy.data.objects.new("mine", bpy.data.meshes.new("mine"))
    scene.collection.objects.link(own)
    mirror = SceneMirror(scene)
    light = LightRecord("light@1", 1, "point", (1.0, 1.0, 1.0))
    mirror.apply(SceneDescription(1, spheres(250, name="s"), (light,)))
    counts = mirror.apply(SceneDescription(2))
    assert counts.deleted == 251
    assert [obj.name for obj in scene.objects] == ["mine"]
    assert len(bpy.data.lights) == 0
    assert [mesh.name for mesh in bpy.data.meshes] == ["mine"]
    assert len(bpy.data.materials) == 0


def test_a_shape_deleted_by_hand_comes_back(scene):
    mirror, frame = SceneMirror(scene), SceneDescription(1, spheres(3))
    mirror.apply(frame)
    bpy.data.objects.remove(by_key(scene)["sphere@2:1#1"])
    assert mirror.apply(frame).made == 1
    assert len(scene.objects) == 3


def test_a_collection_hidden_by_hand_stays_hidden_through_a_bulk_change(scene):
    mirror = SceneMirror(scene)
    mirror.apply(SceneDescription(1, spheres(3)))
    layer = bpy.context.view_layer.layer_collection.children["TRG"]
    layer.hide_viewport = True
    mirror.apply(SceneDescription(2, spheres(250, name="s")))
    assert bpy.context.view_layer.layer_collection.children["TRG"].hide_viewport


def copies(count: int) -> tuple[ShapeRecord, ...]:
    """Boxes of every size, turned about Y, some mirrored: none sheared."""
    shapes = []
    for i in range(count):
        c, s, mirror = np.cos(0.1 * i), np.sin(0.1 * i), (-1.0 if i % 3 == 0 else 1.0)
        rows = (c * mirror, 0.0, s, float(i), 0.0, 2.0, 0.0, 1.0, -s * mirror, 0.0, c, 0.5 * i)
        corners = ((-1.0, 0.0, -0.5), (1.0, 1.0 + i / 100, 0.5))
        shapes.append(ShapeRecord(f"box@3:1#{i}", 1, "box", corners, "box@3:1#0", RED, transform=rows))
    return tuple(shapes)


def instance_matrices() -> list[np.ndarray]:
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return [np.array(i.matrix_world) for i in depsgraph.object_instances if i.is_instance]


def test_five_hundred_copies_are_one_object_with_the_right_matrices(scene):
    shapes = copies(500)
    counts = SceneMirror(scene).apply(SceneDescription(1, shapes))
    assert counts.made == len(scene.objects) == 1
    found = instance_matrices()
    # Independent of the package: TRG matrix times centre and size, then (x, y, z) -> (x, -z, y).
    turn = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1.0]])
    corners = np.array([(x, y, z, 1.0) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
    assert len(found) == 500
    for shape, matrix in zip(shapes, found, strict=True):
        low, high = np.array(shape.parameters)
        local = np.diag((*(high - low), 1.0))
        local[:3, 3] = (low + high) / 2
        world = turn @ np.vstack((np.reshape(shape.transform, (3, 4)), (0, 0, 0, 1))) @ local
        np.testing.assert_allclose(
            sorted_points(corners @ (matrix @ turn).T), sorted_points(corners @ world.T), atol=1e-3
        )


def sorted_points(points: np.ndarray) -> np.ndarray:
    rounded = points.round(2)
    return points[np.lexsort(rounded.T)]


def test_instances_have_the_material_of_the_copies(scene):
    SceneMirror(scene).apply(SceneDescription(1, copies(300)))
    depsgraph = bpy.context.evaluated_depsgraph_get()
    names = {i.object.material_slots[0].material.name for i in depsgraph.object_instances if i.is_instance}
    assert names == {"red"}


def test_moving_one_copy_writes_the_instancer_and_equal_copies_nothing(scene):
    mirror, shapes = SceneMirror(scene), copies(300)
    mirror.apply(SceneDescription(1, shapes))
    assert mirror.apply(SceneDescription(2, shapes)).total == 0
    moved = replace(shapes[5], version=2, parameters=((50.0, 0.0, 0.0), (51.0, 1.0, 1.0)))
    counts = mirror.apply(SceneDescription(3, (*shapes[:5], moved, *shapes[6:])))
    assert (counts.updated, counts.total) == (1, 1)
    before = [m[:3, 3].copy() for m in instance_matrices()]
    assert max(np.abs(before[5])) > 40.0


def test_named_and_sheared_copies_stay_objects(scene):
    shapes = copies(300)
    named = replace(shapes[0], name="door")
    sheared = replace(shapes[1], transform=(1.0, 0.5, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0))
    SceneMirror(scene).apply(SceneDescription(1, (named, sheared, *shapes[2:])))
    assert {obj.name for obj in scene.objects if obj.get(KIND) == "box"} == {"door", sheared.key}
    assert len(instance_matrices()) == 298


def test_fewer_copies_become_objects_again_and_nothing_is_left_over(scene):
    mirror, shapes = SceneMirror(scene), copies(300)
    mirror.apply(SceneDescription(1, shapes))
    mirror.apply(SceneDescription(2, shapes[:10]))
    assert len(scene.objects) == len(bpy.data.objects) == 10
    assert len(bpy.data.node_groups) == 0
    assert len(bpy.data.meshes) == 1


def test_ten_thousand_copies_are_quick_the_second_time(scene):
    mirror, shapes = SceneMirror(scene), copies(10_000)
    mirror.apply(SceneDescription(1, shapes))
    assert mirror.apply(SceneDescription(2, shapes)).total == 0
    assert len(scene.objects) == 1


def test_camera_stands_looks_and_spans_what_the_program_says(scene):
    SceneMirror(scene).apply(SceneDescription(1, camera=CAMERA))
    bpy.context.view_layer.update()
    camera = scene.camera
    assert (scene.render.resolution_x, scene.render.resolution_y) == (640, 480)
    assert tuple(camera.matrix_world.translation) == pytest.approx((30.0, 0.0, 10.0))
    forward = camera.matrix_world.to_3x3() @ __import__("mathutils").Vector((0, 0, -1))
    expected = np.array((-30.0, 0.0, -10.0)) / np.sqrt(1000.0)
    np.testing.assert_allclose(forward, expected, atol=1e-6)
    corners = np.array([tuple(c) for c in camera.data.view_frame(scene=scene)])
    half_height = corners[:, 1].max() / -corners[0, 2]
    half_width = corners[:, 0].max() / -corners[0, 2]
    assert half_height == pytest.approx(0.5, rel=1e-5)
    assert half_width == pytest.approx(0.5 * 640 / 480, rel=1e-5)


def test_a_tall_picture_spans_the_field_of_view_across_its_width(scene):
    SceneMirror(scene).apply(SceneDescription(1, camera=replace(CAMERA, width=300, height=900)))
    corners = np.array([tuple(c) for c in scene.camera.data.view_frame(scene=scene)])
    assert corners[:, 0].max() / -corners[0, 2] == pytest.approx(0.5, rel=1e-5)


def test_a_camera_right_above_its_target_does_not_fail(scene):
    above = replace(CAMERA, location=(0.0, 10.0, 0.0))
    SceneMirror(scene).apply(SceneDescription(1, camera=above))
    bpy.context.view_layer.update()
    assert np.isfinite(np.array(scene.camera.matrix_world)).all()


def test_picture_size_of_a_scene_that_keeps_its_own(scene):
    scene["trg_keep_size"] = True
    SceneMirror(scene).apply(SceneDescription(1, camera=CAMERA))
    assert (scene.render.resolution_x, scene.render.resolution_y) == (1920, 1080)


def test_requested_modes_are_kept_until_the_program_drops_them(scene):
    mirror = SceneMirror(scene)
    mirror.apply(SceneDescription(1, modes=RenderModes(device="cuda")))
    assert requested_modes(scene) == {"device": "cuda"}
    mirror.apply(SceneDescription(2))
    assert requested_modes(scene) == {}


def test_background_is_the_world_colour(scene):
    SceneMirror(scene).apply(SceneDescription(1, background=(0.1, 0.2, 0.4)))
    shader = next(n for n in scene.world.node_tree.nodes if n.type == "BACKGROUND")
    assert tuple(shader.inputs["Color"].default_value) == pytest.approx((0.1, 0.2, 0.4, 1.0))
    assert shader.inputs["Strength"].default_value == 1.0


def test_two_scenes_with_one_program_do_not_disturb_each_other(scene):
    other = bpy.data.scenes.new("other")
    frame = SceneDescription(1, spheres(3))
    SceneMirror(scene).apply(frame)
    SceneMirror(other).apply(frame)
    edited = replace(RED, version=2, base_color=(0.0, 1.0, 0.0))
    SceneMirror(other).apply(SceneDescription(2, tuple(replace(s, material=edited) for s in spheres(2))))
    assert (len(scene.objects), len(other.objects)) == (3, 2)
    material = next(iter(scene.objects)).material_slots[0].material
    assert tuple(material.diffuse_color)[:3] == (1.0, 0.0, 0.0)


BAD = {
    "radius": replace(spheres(1)[0], parameters=((0.0, 0.0, 0.0), -1.0)),
    "nan": replace(spheres(1)[0], parameters=((0.0, nan, 0.0), 1.0)),
    "transform": replace(spheres(1)[0], transform=(inf,) * 12),
    "kind": replace(spheres(1)[0], kind="teapot"),
    "count": replace(spheres(1)[0], kind="fence", parameters=((0.0, 0.0, 0.0), 1.0, 1.0, 1e9)),
    "material": replace(spheres(1)[0], material=replace(RED, base_color=(nan, 0.0, 0.0))),
}


@pytest.mark.parametrize("case", BAD)
def test_an_impossible_record_names_its_place_and_leaves_the_scene_alone(scene, case):
    mirror = SceneMirror(scene)
    mirror.apply(SceneDescription(1, spheres(2)))
    bad = replace(BAD[case], key="bad")
    with pytest.raises(SceneError) as caught:
        mirror.apply(SceneDescription(2, (*spheres(5), bad)))
    if case != "material":
        assert str(caught.value).startswith("scene.trg:12:5: error: ")
    assert len(scene.objects) == 2


def test_the_camera_on_its_target_is_an_error(scene):
    with pytest.raises(SceneError, match="camera"):
        SceneMirror(scene).apply(SceneDescription(1, camera=replace(CAMERA, target=CAMERA.location)))


def test_a_damaged_model_names_file_and_offset_and_adds_nothing(scene, tmp_path):
    path = tmp_path / "broken.g3dm"
    path.write_bytes(b"G3DM" + struct.pack("<III", 1, 0, 0) + struct.pack("<IIi", 1000, 3, -1))
    model = ShapeRecord(
        "model@1", 1, "model", ("broken.g3dm",), "model@1", None, path=str(path), origin=PLACE
    )
    broken_image = tmp_path / "ok.g24"
    broken_image.write_bytes(struct.pack("<HH", 1, 1) + b"\x00\x00\xff")
    texture = TextureRecord("t", "ok.g24", str(broken_image))
    textured = replace(RED, key="m2", textures=(("base_color", texture),))
    shapes = (*(replace(s, material=textured) for s in spheres(3)), model)
    with pytest.raises(SceneError, match=r"broken\.g3dm.*byte"):
        SceneMirror(scene).apply(SceneDescription(1, shapes))
    assert len(scene.objects) == len(bpy.data.meshes) == len(bpy.data.images) == len(bpy.data.materials) == 0


def test_a_damaged_picture_rolls_back_the_pictures_before_it(scene, tmp_path):
    good, bad = tmp_path / "good.g24", tmp_path / "bad.png"
    good.write_bytes(struct.pack("<HH", 1, 1) + b"\x00\x00\xff")
    bad.write_bytes(b"not a picture")
    slots = (
        ("base_color", TextureRecord("a", "good.g24", str(good))),
        ("roughness", TextureRecord("b", "bad.png", str(bad))),
    )
    shape = replace(spheres(1)[0], material=replace(RED, textures=slots))
    with pytest.raises(SceneError, match=r"bad\.png"):
        SceneMirror(scene).apply(SceneDescription(1, (shape,)))
    assert len(bpy.data.images) == len(scene.objects) == 0


@pytest.mark.parametrize("material", [None, RED])
def test_a_missing_model_is_a_magenta_box_whatever_its_material(scene, material):
    model = ShapeRecord("model@1", 1, "model", ("nowhere.g3dm",), "model@1", material)
    SceneMirror(scene).apply(SceneDescription(1, (model,)))
    (obj,) = scene.objects
    assert tuple(obj.dimensions) == pytest.approx((1.0, 1.0, 1.0))
    assert tuple(obj.material_slots[0].material.diffuse_color)[:3] == (1.0, 0.0, 1.0)

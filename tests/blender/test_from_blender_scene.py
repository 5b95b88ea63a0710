"""What reaches the renderers from a Blender scene: meshes, instances, camera, world, odd cases."""

from __future__ import annotations

import math

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

from bpy_extras.object_utils import world_to_camera_view  # noqa: E402
from mathutils import Vector  # noqa: E402

from trg_blender.engine.errors import SceneError  # noqa: E402
from trg_blender.engine.from_blender import SceneReader  # noqa: E402
from trg_blender.engine.from_blender.meshes import MeshRequest, read_mesh, view_in_place  # noqa: E402
from trg_blender.engine.scene_arrays import CAMERA_KINDS  # noqa: E402


@pytest.fixture
def scene():
    """An empty scene with a camera that looks down from (0, 0, 10)."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = (0.0, 0.0, 10.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    return scene


def read(scene, size=(64, 48)):
    bpy.context.view_layer.update()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return SceneReader().read(depsgraph.scene_eval, depsgraph, size)


def add_mesh(name, points, faces):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    owner = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(owner)
    return owner


def test_both_ways_through_a_mesh_give_equal_arrays(scene):
    """The in-place way is allowed here and equals Blender's copies, normals and UVs included."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8)
    mesh = bpy.context.object.data
    mesh.calc_loop_triangles()
    assert view_in_place(mesh.loop_triangles, "loops", np.int32, 3) is not None
    assert view_in_place(mesh.attributes[".corner_vert"].data, "value", np.int32, 1) is not None
    assert view_in_place(mesh.vertex_normals, "vector", np.float32, 3) is not None
    for smooth in (False, True):
        mesh.polygons.foreach_set("use_smooth", [smooth] * len(mesh.polygons))
        mesh.update()
        fast, safe = (read_mesh(mesh, MeshRequest(1, True, "", way), []) for way in (True, False))
        for name in ("vertices", "triangles", "normals", "uvs"):
            a, b = getattr(fast, name), getattr(safe, name)
            assert (a is None) == (b is None) and (a is None or np.array_equal(a, b))
        assert (fast.normals is not None) == smooth
        expected = np.array([tuple(v.co) for v in mesh.vertices], np.float32)
        np.testing.assert_array_equal(fast.vertices, expected)


def test_winding_is_counter_clockwise_from_outside(scene):
    bpy.ops.mesh.primitive_cube_add()
    (mesh,) = read(scene).meshes
    p = mesh.vertices[mesh.triangles]
    normals = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    assert ((normals * p.mean(axis=1)).sum(axis=1) > 0).all()


def test_sharp_edges_keep_corner_normals(scene):
    """A cube that is smooth but for sharp edges has flat-looking corner normals."""
    bpy.ops.mesh.primitive_cube_add()
    mesh = bpy.context.object.data
    mesh.polygons.foreach_set("use_smooth", [True] * 6)
    for edge in mesh.edges:
        edge.use_edge_sharp = edge.index % 2 == 0
    mesh.update()
    (arrays,) = read(scene).meshes
    expected = np.empty(len(mesh.loops) * 3, np.float32)
    mesh.corner_normals.foreach_get("vector", expected)
    corners = np.array([tuple(t.loops) for t in mesh.loop_triangles])
    np.testing.assert_allclose(arrays.normals, expected.reshape(-1, 3)[corners], atol=1e-6)


def test_linked_objects_become_one_group(scene):
    """Three copies of a mesh, one mirrored, one with an object-linked material of its own."""
    owner = add_mesh("tri", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    red, blue = bpy.data.materials.new("red"), bpy.data.materials.new("blue")
    owner.data.materials.append(red)
    copies = [owner, owner.copy(), owner.copy()]
    for copy in copies[1:]:
        scene.collection.objects.link(copy)
    copies[1].scale, copies[1].location = (-1, 2, 1), (3, 0, 0)
    copies[2].material_slots[0].link, copies[2].material_slots[0].material = "OBJECT", blue
    arrays = read(scene)
    assert len(arrays.meshes) == 1 and len(arrays.materials) == 2
    by_count = {len(each.transforms): each for each in arrays.instances}
    assert set(by_count) == {1, 2}
    assert by_count[1].slot_materials.tolist() != by_count[2].slot_materials.tolist()
    expected = np.array([[-1, 0, 0, 3], [0, 2, 0, 0], [0, 0, 1, 0]], np.float32)
    assert any(np.array_equal(each, expected) for each in by_count[2].transforms)


def test_material_slots_of_faces(scene):
    owner = add_mesh("two", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)])
    for name in ("a", "b"):
        owner.data.materials.append(bpy.data.materials.new(name))
    owner.data.polygons[1].material_index = 1
    arrays = read(scene)
    assert arrays.meshes[0].slots.tolist() == [0, 1]
    assert len(arrays.instances[0].slot_materials) == 2


def test_text_curves_and_balls_have_surfaces_and_volumes_a_warning(scene):
    bpy.ops.object.text_add()
    bpy.ops.curve.primitive_bezier_circle_add()
    bpy.context.object.data.bevel_depth = 0.1
    bpy.ops.object.metaball_add()
    bpy.ops.surface.primitive_nurbs_surface_sphere_add()
    bpy.ops.object.volume_add()
    bpy.context.object.name = "smoke"
    arrays = read(scene)
    assert len(arrays.instances) == 4 and all(len(mesh.triangles) for mesh in arrays.meshes)
    assert arrays.warnings == ["object 'smoke': a volume is not rendered"]


def test_modifiers_and_hidden_objects(scene):
    owner = add_mesh("tri", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    modifier = owner.modifiers.new("array", "ARRAY")
    modifier.count = 5
    hidden = add_mesh("hidden", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    hidden.hide_viewport = True
    arrays = read(scene)
    assert [len(mesh.triangles) for mesh in arrays.meshes] == [5]


def test_broken_vertices_are_left_out_with_a_warning(scene):
    owner = add_mesh("bad", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 1, 2), (0, 2, 3)])
    owner.data.vertices[3].co = (math.nan, 0, 0)
    arrays = read(scene)
    assert len(arrays.meshes[0].triangles) == 1
    assert np.isfinite(arrays.meshes[0].vertices).all()
    assert "1 vertices are not finite; 1 triangles" in arrays.warnings[0] and "'bad'" in arrays.warnings[0]


def test_a_flat_object_is_stored_in_world_space(scene):
    """Scale zero along one axis still shows; along two it is nothing."""
    bpy.ops.mesh.primitive_cube_add(location=(1, 2, 3))
    bpy.context.object.scale = (1, 1, 0)
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.object.scale = (1, 0, 0)
    arrays = read(scene)
    (instance,) = arrays.instances
    np.testing.assert_array_equal(instance.transforms[0], np.eye(3, 4))
    np.testing.assert_allclose(arrays.meshes[instance.mesh].vertices[:, 2], 3.0)


def test_an_empty_scene_renders_its_world_and_no_camera_is_an_error(scene):
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    background = scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0.1, 0.2, 0.3, 1.0)
    background.inputs["Strength"].default_value = 2.0
    arrays = read(scene)
    assert not arrays.instances and not arrays.lights
    assert arrays.world == pytest.approx((0.2, 0.4, 0.6))
    with pytest.raises(SceneError, match="no pixels"):
        read(scene, (0, 10))
    scene.camera = None
    with pytest.raises(SceneError, match="has no camera"):
        read(scene)


CAMERA_CASES = {
    "wide": ((64, 48), {}, {}),
    "tall": ((48, 64), {}, {}),
    "vertical_fit": ((64, 48), {"sensor_fit": "VERTICAL", "sensor_height": 20.0}, {}),
    "shifted": ((64, 48), {"shift_x": 0.3, "shift_y": -0.2}, {}),
    "shifted_tall": ((30, 70), {"shift_x": 0.3, "shift_y": -0.2, "lens": 24.0}, {}),
    "pixel_aspect": ((64, 48), {"shift_x": 0.1}, {"pixel_aspect_x": 2.0, "pixel_aspect_y": 1.0}),
    "orthographic": ((64, 48), {"type": "ORTHO", "ortho_scale": 5.0, "shift_y": 0.1}, {}),
    "orthographic_tall": ((30, 48), {"type": "ORTHO", "ortho_scale": 5.0, "shift_x": 0.2}, {}),
}


@pytest.mark.parametrize("name", CAMERA_CASES)
def test_points_land_where_blender_puts_them(scene, name):
    """Our camera against bpy_extras' own projection of points, camera rotated, moved and scaled."""
    size, settings, render = CAMERA_CASES[name]
    owner = scene.camera
    owner.rotation_euler, owner.scale = (0.3, 0.2, 0.4), (2.0, 2.0, 2.0)
    for key, value in settings.items():
        setattr(owner.data, key, value)
    for key, value in render.items():
        setattr(scene.render, key, value)
    scene.render.resolution_x, scene.render.resolution_y = size
    camera = read(scene, size).camera
    left, right, bottom, top = camera.window
    axes, place = camera.matrix[:, :3], camera.matrix[:, 3]
    np.testing.assert_allclose(axes.T @ axes, np.eye(3), atol=1e-6)
    for point in [(0.5, 0.3, 0.0), (-1.0, 2.0, 1.0), (2.0, -1.0, -3.0)]:
        x, y, z = axes.T @ (np.array(point) - place)
        depth = 1.0 if camera.kind == 1 else -z
        ours = ((x / depth - left) / (right - left), (y / depth - bottom) / (top - bottom), -z)
        # world_to_camera_view measures in the scaled camera's space; an unscaled twin says the same.
        owner.scale = (1.0, 1.0, 1.0)
        bpy.context.view_layer.update()
        theirs = world_to_camera_view(scene, owner, Vector(point))
        assert ours == pytest.approx(tuple(theirs), abs=2e-5)


def test_an_equirectangular_camera_spans_its_angles(scene):
    data = scene.camera.data
    data.type, data.panorama_type = "PANO", "EQUIRECTANGULAR"
    data.longitude_min, data.latitude_max = -2.0, 0.5
    camera = read(scene).camera
    assert CAMERA_KINDS[camera.kind] == "panorama"
    assert camera.window == pytest.approx((-2.0, math.pi, -math.pi / 2, 0.5))


def test_another_panorama_is_perspective_with_a_warning(scene):
    scene.camera.data.type, scene.camera.data.panorama_type = "PANO", "FISHEYE_EQUISOLID"
    arrays = read(scene)
    assert arrays.camera.kind == 0
    assert "FISHEYE_EQUISOLID is rendered as perspective" in arrays.warnings[0]


def test_geometry_nodes_instances_arrive_as_one_group(scene):
    """A collection instanced twice: two transforms of one mesh."""
    owner = add_mesh("tri", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    scene.collection.objects.unlink(owner)
    collection = bpy.data.collections.new("stock")
    collection.objects.link(owner)
    for x in (1.0, 4.0):
        empty = bpy.data.objects.new("copy", None)
        empty.instance_type, empty.instance_collection = "COLLECTION", collection
        empty.location = (x, 0, 0)
        scene.collection.objects.link(empty)
    (instance,) = read(scene).instances
    assert sorted(instance.transforms[:, 0, 3].tolist()) == [1.0, 4.0]


@pytest.mark.parametrize("kind", ["single", "multiple", "PREETHAM"])
def test_a_sky_texture_is_an_environment_and_a_sun(scene, kind):
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    background = next(node for node in tree.nodes if node.type == "BACKGROUND")
    background.inputs["Strength"].default_value = 0.5
    node = tree.nodes.new("ShaderNodeTexSky")
    kinds = [item.identifier for item in node.bl_rna.properties["sky_type"].enum_items]
    names = {"single": ("NISHITA", "SINGLE_SCATTERING"), "multiple": ("MULTIPLE_SCATTERING",)}
    found = [name for name in names.get(kind, (kind,)) if name in kinds]
    if not found:
        pytest.skip(f"this Blender has no sky {kind}")
    node.sky_type = found[0]
    node.sun_elevation, node.sun_rotation = 0.4, 1.1
    tree.links.new(node.outputs["Color"], background.inputs["Color"])
    arrays = read(scene)
    assert arrays.environment is not None and np.isfinite(arrays.environment.pixels).all()
    assert arrays.environment.pixels.max() > 0.0
    if kind == "PREETHAM":
        assert arrays.lights == [] and any("PREETHAM" in warning for warning in arrays.warnings)
        return
    (sun,) = arrays.lights
    # As in Cycles: towards +y at rotation 0, turned to +x.
    towards = (math.cos(0.4) * math.sin(1.1), math.cos(0.4) * math.cos(1.1), math.sin(0.4))
    assert (sun.direction_x, sun.direction_y, sun.direction_z) == pytest.approx(towards, abs=1e-6)
    assert sun.seen == 1.0 and sun.color_r > sun.color_b > 0.0
    # The sky about the sun is its brightest part.
    environment = arrays.environment
    row, column = np.unravel_index(environment.pixels.sum(axis=2).argmax(), environment.pixels.shape[:2])
    height, width = environment.pixels.shape[:2]
    longitude = (0.5 - (column + 0.5) / width) * 2.0 * math.pi
    x, y, _ = environment.rotation @ np.array(towards)
    assert math.cos(longitude - math.atan2(y, x)) > 0.99
    assert not [warning for warning in arrays.warnings if "sky" in warning.lower()]

"""A program's spheres and planes reach the renderers as true ones, until somebody edits their meshes."""

from __future__ import annotations

import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.engine.from_blender import SceneReader  # noqa: E402
from trg_blender.engine.from_blender.shapes import is_unedited  # noqa: E402
from trg_blender.engine.scene_arrays import MeshArrays, SceneArrays  # noqa: E402
from trg_blender.engine.to_blender import shape_meshes  # noqa: E402
from trg_blender.engine.to_blender.meshes import build_mesh  # noqa: E402
from trg_blender.engine.to_blender.tags import PLANE, SPHERE  # noqa: E402

TAGS = {"sphere": (SPHERE, (0.0, 0.0, 0.0, 1.0)), "plane": (PLANE, (0.0, 0.0, 1.0, 0.0))}


def add(kind: str) -> bpy.types.Object:
    data = shape_meshes.sphere_mesh() if kind == "sphere" else shape_meshes.plane_mesh()
    owner = bpy.data.objects.new(kind, build_mesh(kind, kind, data))
    tag, values = TAGS[kind]
    owner[tag] = values
    bpy.context.scene.collection.objects.link(owner)
    return owner


@pytest.fixture
def scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(scene.camera)
    return scene


def read() -> SceneArrays:
    bpy.context.view_layer.update()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return SceneReader().read(depsgraph.scene_eval, depsgraph, (8, 8))


def only_mesh() -> MeshArrays:
    (mesh,) = read().meshes
    return mesh


@pytest.mark.parametrize("kind", TAGS)
def test_a_tagged_mesh_is_its_shape(scene, kind: str):
    owner = add(kind)
    owner.scale = (2.0, 1.0, 3.0)
    mesh = only_mesh()
    assert mesh.shape == kind and len(mesh.triangles) > 0
    del owner[TAGS[kind][0]]
    owner.update_tag()
    assert only_mesh().shape == "triangles"


@pytest.mark.parametrize("kind", TAGS)
def test_with_texture_places_too(scene, kind: str):
    owner = add(kind)
    material = bpy.data.materials.new("checked")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    image = nodes.new("ShaderNodeTexImage")
    image.image = bpy.data.images.new("pixels", 4, 4)
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    links.new(image.outputs["Color"], shader.inputs["Base Color"])
    owner.data.materials[0] = material
    mesh = only_mesh()
    assert mesh.uvs is not None and mesh.shape == kind
    owner.data.uv_layers[0].uv[0].vector = (0.3, 0.7)
    assert only_mesh().shape == "triangles"


@pytest.mark.parametrize("kind", TAGS)
def test_an_edited_mesh_is_a_mesh(scene, kind: str):
    owner = add(kind)
    owner.data.vertices[0].co.x += 0.5
    assert only_mesh().shape == "triangles"


@pytest.mark.parametrize("kind", TAGS)
def test_a_modifier_makes_it_a_mesh(scene, kind: str):
    owner = add(kind)
    owner.modifiers.new("finer", "SUBSURF").render_levels = 1
    assert only_mesh().shape == "triangles"


def test_facets_that_somebody_asked_for_are_kept(scene):
    owner = add("sphere")
    owner.data.polygons.foreach_set("use_smooth", [False] * len(owner.data.polygons))
    owner.data.update()
    assert only_mesh().shape == "triangles"


def test_objects_with_and_without_the_tag_may_share_a_mesh(scene):
    owner = add("sphere")
    plain = bpy.data.objects.new("plain", owner.data)
    scene.collection.objects.link(plain)
    arrays = read()
    shapes = {one.origin: arrays.meshes[one.mesh].shape for one in arrays.instances}
    assert shapes == {"sphere": "sphere", "plain": "triangles"}


def test_triangles_are_never_taken_for_a_shape(scene):
    add("sphere")
    assert not is_unedited(only_mesh(), "plane")
    assert not is_unedited(only_mesh(), "triangles")

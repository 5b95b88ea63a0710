"""What programs and users say of the insides of bodies reaches the renderers."""

from __future__ import annotations

import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.engine.classic_arrays import classic_rows  # noqa: E402
from trg_blender.engine.from_blender import SceneReader  # noqa: E402
from trg_blender.engine.to_blender.program_runner import ProgramRunner  # noqa: E402
from trg_blender.ui import registration  # noqa: E402

PROGRAM = """
Scene = scene();
glass = material::glass(1.5);
Scene.Add(sphere(vec3(0, 1, 0), 1, glass));
Scene.Add(sphere(vec3(3, 1, 0), 1, glass, enviroment(0.25, 1.33)));
Scene.Add(sphere(vec3(6, 1, 0), 1, enviroment(0.5, 1), glass));
Scene.Add(sphere(vec3(9, 1, 0), 1, material::red_plastic(), enviroment(0.5, 1.2)));
Scene.CamSet(48, 32, vec3(6, 3, 6), vec3(0, 1, 0), vec3(0, 1, 0));
Scene.Render();
"""


@pytest.fixture
def scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    registration.register()
    yield bpy.context.scene
    registration.unregister()


def read(scene):
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return SceneReader().read(scene.evaluated_get(depsgraph), depsgraph, (48, 32))


@pytest.fixture
def arrays(scene):
    text = bpy.data.texts.new("media.trg")
    text.write(PROGRAM)
    outcome = ProgramRunner().run(scene, text, 1)
    assert outcome.failure is None, outcome.failure
    scene.frame_set(1)
    return read(scene)


def test_a_medium_fills_its_shape_alone(arrays):
    found = {
        (round(m.absorption_r, 4), round(m.ior, 4), m.priority)
        for m in arrays.materials
        if m.transmission > 0
    }
    assert found == {(0.0, 1.5, 0.0), (0.25, 1.33, 1.0), (0.5, 1.5, 1.0)}
    opaque = [m for m in arrays.materials if m.transmission == 0]
    assert [(m.absorption_r, m.priority, m.ior) for m in opaque] == [(0.0, 0.0, pytest.approx(1.5))]


def test_classic_has_the_same_media(arrays):
    rows = classic_rows(arrays)
    found = {(round(row.decay, 4), round(row.ior, 4)) for row in rows if row.refract_r > 0}
    assert found == {(0.0, 1.5), (0.25, 1.33), (0.5, 1.5)}


def test_a_user_gives_a_material_a_priority(scene):
    bpy.ops.mesh.primitive_cube_add()
    material = bpy.data.materials.new("water")
    material["trg_priority"] = 3
    bpy.context.object.data.materials.append(material)
    bpy.ops.object.camera_add()
    scene.camera = bpy.context.object
    assert [row.priority for row in read(scene).materials] == [3.0]
    material["trg_priority"] = "much"
    material.update_tag()
    assert [row.priority for row in read(scene).materials] == [0.0]


def test_weights_of_layers_and_transmission_take_textures(scene):
    bpy.ops.mesh.primitive_cube_add()
    material = bpy.data.materials.new("layers")
    tree = material.node_tree
    if tree is None:
        material.use_nodes = True
        tree = material.node_tree
    tree.nodes.clear()
    shader, output = tree.nodes.new("ShaderNodeBsdfPrincipled"), tree.nodes.new("ShaderNodeOutputMaterial")
    checker = tree.nodes.new("ShaderNodeTexChecker")
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    names = ("Transmission Weight", "Coat Weight", "Sheen Weight", "Sheen Roughness")
    for name in names:
        tree.links.new(checker.outputs["Fac"], shader.inputs[name])
    bpy.context.object.data.materials.append(material)
    bpy.ops.object.camera_add()
    scene.camera = bpy.context.object
    arrays = read(scene)
    (row,) = arrays.materials
    found = (row.transmission_texture, row.coat_texture, row.sheen_texture, row.sheen_roughness_texture)
    assert min(found) >= 0 and row.sheen_r > 0.0
    assert not [text for text in arrays.warnings if "not supported" in text]

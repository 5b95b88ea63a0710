"""Node graphs read from Blender: what becomes of bad images, unknown nodes, groups and names."""

from __future__ import annotations

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

from benchmarks.texture_scene import SIDE, build_stage, show  # noqa: E402
from trg_blender.engine import session  # noqa: E402
from trg_blender.engine.from_blender.sync import SceneReader  # noqa: E402
from trg_blender.engine.scene_arrays import RenderSettings  # noqa: E402


def read():
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return SceneReader().read(bpy.context.scene, depsgraph, (SIDE, SIDE))


def picture(arrays):
    settings = RenderSettings(SIDE, SIDE, samples=8, max_bounces=0, threads=1)
    return session.render(arrays, settings).pixels[..., :3]


@pytest.fixture
def material():
    return build_stage(4.0, -1.0)


def test_a_missing_image_is_pink_with_one_warning(material):
    pytest.importorskip("trg_native")
    show(material, lambda tree, uv: tree.nodes.new("ShaderNodeTexImage").outputs["Color"])
    arrays = read()
    assert len(arrays.warnings) == 1 and "no image" in arrays.warnings[0]
    assert picture(arrays).reshape(-1, 3) == pytest.approx(np.tile([1.0, 0.0, 1.0], (SIDE * SIDE, 1)))


def test_a_pixel_that_is_not_finite_is_black_and_counted(material):
    image = bpy.data.images.new("broken", 2, 2, float_buffer=True)
    values = np.ones(16, np.float32)
    values[0], values[5] = np.nan, np.inf
    image.pixels.foreach_set(values)

    def build(tree, uv):
        node = tree.nodes.new("ShaderNodeTexImage")
        node.image = image
        return node.outputs["Color"]

    show(material, build)
    arrays = read()
    assert np.isfinite(arrays.images[0].pixels).all()
    assert [text for text in arrays.warnings if "2 pixels are not finite" in text]


def test_an_unknown_node_passes_its_first_colour_on_and_is_named(material):
    pytest.importorskip("trg_native")

    def build(tree, uv):
        node = tree.nodes.new("ShaderNodeTexMagic")
        ramp = tree.nodes.new("ShaderNodeGamma")
        tree.links.new(node.outputs["Color"], ramp.inputs["Color"])
        return ramp.outputs[0]

    show(material, build)
    arrays = read()
    assert len(arrays.warnings) == 1
    assert "Magic" in arrays.warnings[0] and "'stuff'" in arrays.warnings[0]


def test_a_group_is_looked_into(material):
    group = bpy.data.node_groups.new("double", "ShaderNodeTree")
    for name, side in (("In", "INPUT"), ("Out", "OUTPUT")):
        group.interface.new_socket(name, in_out=side, socket_type="NodeSocketColor")
    inside, outside = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    invert = group.nodes.new("ShaderNodeInvert")
    group.links.new(inside.outputs[0], invert.inputs["Color"])
    group.links.new(invert.outputs[0], outside.inputs[0])

    def build(tree, uv):
        node = tree.nodes.new("ShaderNodeGroup")
        node.node_tree = group
        node.inputs[0].default_value = (0.25, 0.5, 1.0, 1.0)
        return node.outputs[0]

    show(material, build)
    arrays = read()
    assert not arrays.warnings
    row = arrays.materials[0]
    assert (row.emission_r, row.emission_g, row.emission_b) == pytest.approx((0.75, 0.5, 0.0))


def test_random_is_what_cycles_makes_of_the_name(material):
    show(material, lambda tree, uv: tree.nodes.new("ShaderNodeObjectInfo").outputs["Random"])
    assert read().instances[0].randoms == pytest.approx([0.0011686024], rel=1e-5)

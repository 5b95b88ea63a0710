"""Shader nodes and images -> material, texture and image rows."""

from __future__ import annotations

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.engine.from_blender.materials import MaterialTable  # noqa: E402
from trg_blender.engine.scene_arrays import CHANNELS  # noqa: E402


@pytest.fixture
def nodes():
    """An emptied material and what builds its tree: (add node, link, read)."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    material = bpy.data.materials.new("stuff")
    material.use_nodes = True
    material.node_tree.nodes.clear()
    return Tree(material)


class Tree:
    def __init__(self, material):
        self.material, self.tree = material, material.node_tree
        self.output = self.add("OutputMaterial")

    def add(self, kind, **inputs):
        node = self.tree.nodes.new("ShaderNode" + kind)
        for name, value in inputs.items():
            node.inputs[name.replace("_", " ")].default_value = value
        return node

    def link(self, source, target, name, output=0):
        self.tree.links.new(source.outputs[output], target.inputs[name])

    def read(self, surface=None):
        if surface is not None:
            self.link(surface, self.output, "Surface")
        table = MaterialTable([])
        return table.rows[table.add(self.material)], table


def test_principled_row(nodes):
    row, table = nodes.read(
        nodes.add(
            "BsdfPrincipled",
            Base_Color=(0.1, 0.2, 0.3, 1.0),
            Metallic=0.25,
            Roughness=0.4,
            IOR=1.7,
            Specular_IOR_Level=0.25,
            Transmission_Weight=0.5,
            Emission_Color=(1.0, 0.5, 0.25, 1.0),
            Emission_Strength=4.0,
        )
    )
    assert (row.base_r, row.base_g, row.base_b) == pytest.approx((0.1, 0.2, 0.3))
    assert (row.metallic, row.roughness, row.ior) == pytest.approx((0.25, 0.4, 1.7))
    assert (row.specular, row.transmission) == pytest.approx((0.5, 0.5))
    assert (row.emission_r, row.emission_g, row.emission_b) == pytest.approx((4.0, 2.0, 1.0))
    assert table.warnings == []


def test_the_specular_level_scales_the_reflection_at_normal_incidence(nodes):
    row, _ = nodes.read(nodes.add("BsdfPrincipled", IOR=1.5, Specular_IOR_Level=1.0))
    assert (row.ior, row.specular) == (1.5, 2.0)


def test_the_layers_of_principled(nodes):
    row, table = nodes.read(
        nodes.add(
            "BsdfPrincipled",
            Coat_Weight=0.5,
            Coat_Roughness=0.2,
            Coat_IOR=1.8,
            Coat_Tint=(0.1, 0.2, 0.3, 1),
            Sheen_Weight=0.5,
            Sheen_Tint=(1.0, 0.5, 0.0, 1),
            Sheen_Roughness=0.3,
            Diffuse_Roughness=0.7,
            Specular_Tint=(0.4, 0.5, 0.6, 1),
        )
    )
    assert (row.coat, row.coat_roughness, row.coat_ior) == pytest.approx((0.5, 0.2, 1.8))
    assert (row.coat_tint_r, row.coat_tint_b) == pytest.approx((0.1, 0.3))
    assert (row.sheen_r, row.sheen_g, row.sheen_b) == pytest.approx((0.5, 0.25, 0.0))
    assert (row.sheen_roughness, row.diffuse_roughness) == pytest.approx((0.3, 0.7))
    assert (row.specular_tint_r, row.specular_tint_b) == pytest.approx((0.4, 0.6))
    assert row.multiscatter == 1.0
    assert table.warnings == []


def test_an_empty_slot_is_grey_lambert():
    table = MaterialTable([])
    row = table.rows[table.add(None)]
    assert (row.base_r, row.specular, row.metallic) == (0.8, 0.0, 0.0)


@pytest.mark.parametrize(
    ("kind", "inputs", "expected"),
    [
        ("BsdfDiffuse", {"Color": (0.2, 0.4, 0.6, 1)}, {"base_g": 0.4, "specular": 0.0}),
        ("BsdfGlossy", {"Roughness": 0.3}, {"metallic": 1.0, "roughness": 0.3}),
        ("BsdfGlass", {"IOR": 1.3, "Color": (0.5, 1, 1, 1)}, {"transmission": 1, "ior": 1.3, "base_r": 0.25}),
        ("Emission", {"Strength": 3.0}, {"emission_r": 3.0, "base_r": 0.0, "specular": 0.0}),
        ("BsdfTransparent", {"Color": (1, 0.5, 0.25, 1)}, {"alpha": 0.0, "through_g": 0.5, "base_r": 0.0}),
    ],
)
def test_simple_shaders(nodes, kind, inputs, expected):
    row, table = nodes.read(nodes.add(kind, **inputs))
    for name, value in expected.items():
        assert getattr(row, name) == pytest.approx(value), name
    assert table.warnings == []


def test_nothing_plugged_in_is_black(nodes):
    row, _ = nodes.read()
    assert (row.base_r, row.specular, row.emission_r) == (0.0, 0.0, 0.0)


def test_emission_adds_to_a_surface(nodes):
    add = nodes.add("AddShader")
    nodes.tree.links.new(nodes.add("Emission", Strength=2.0).outputs[0], add.inputs[0])
    nodes.tree.links.new(nodes.add("BsdfDiffuse").outputs[0], add.inputs[1])
    row, table = nodes.read(add)
    assert row.base_r == pytest.approx(0.8) and row.emission_r == pytest.approx(2.0)
    assert table.warnings == []


def test_a_mixture_with_transparent_is_partly_there(nodes):
    mixer = nodes.add("MixShader", Fac=0.25)
    clear = nodes.add("BsdfTransparent", Color=(1, 0.5, 0, 1))
    nodes.tree.links.new(clear.outputs[0], mixer.inputs[1])
    nodes.tree.links.new(nodes.add("BsdfDiffuse").outputs[0], mixer.inputs[2])
    row, table = nodes.read(mixer)
    assert (row.alpha, row.through_r, row.through_g, row.through_b) == pytest.approx((0.25, 1.0, 0.5, 0.0))
    assert row.base_r == pytest.approx(0.8) and table.warnings == []


def test_a_mixture_of_two_surfaces_is_two_rows(nodes):
    mixer = nodes.add("MixShader", Fac=0.25)
    nodes.tree.links.new(nodes.add("BsdfDiffuse").outputs[0], mixer.inputs[1])
    nodes.tree.links.new(nodes.add("BsdfTranslucent").outputs[0], mixer.inputs[2])
    row, table = nodes.read(mixer)
    parts = table.rows[row.mix_first : row.mix_first + row.mix_count]
    assert [(part.weight, part.translucent) for part in parts] == [(pytest.approx(0.75), 0), (0.25, 1)]
    assert row.alpha == pytest.approx(1.0) and table.warnings == []


def test_a_texture_that_mixes_weighs_the_rows(nodes):
    mixer = nodes.add("MixShader")
    nodes.link(nodes.add("TexChecker"), mixer, "Fac", output=1)
    nodes.tree.links.new(nodes.add("BsdfTransparent").outputs[0], mixer.inputs[1])
    nodes.tree.links.new(nodes.add("BsdfDiffuse").outputs[0], mixer.inputs[2])
    row, table = nodes.read(mixer)
    assert row.alpha_texture >= 0 and row.mix_count == 1 and table.warnings == []
    assert table.rows[row.mix_first].weight_texture >= 0


def test_a_volume_that_absorbs(nodes):
    volume = nodes.add("VolumeAbsorption", Color=(1.0, 0.5, 0.0, 1.0), Density=3.0)
    nodes.link(volume, nodes.output, "Volume")
    row, table = nodes.read(nodes.add("BsdfGlass"))
    assert (row.absorption_r, row.absorption_g, row.absorption_b) == pytest.approx((0.0, 1.5, 3.0))
    assert table.warnings == []


def test_another_volume_is_named(nodes):
    nodes.link(nodes.add("VolumeScatter"), nodes.output, "Volume")
    _, table = nodes.read(nodes.add("BsdfGlass"))
    assert "Volume Scatter" in table.warnings[0]


def test_one_warning_names_everything_left_out(nodes):
    surface = nodes.add("BsdfPrincipled", Subsurface_Weight=0.5, Anisotropic=0.5)
    _, table = nodes.read(surface)
    (warning,) = table.warnings
    assert "material 'stuff'" in warning
    for word in ("Subsurface Weight", "Anisotropic"):
        assert word in warning


def test_an_unknown_shader_is_grey_with_a_warning(nodes):
    row, table = nodes.read(nodes.add("BsdfToon"))
    assert row.base_r == 0.8
    assert "Toon" in table.warnings[0]


def test_texture_with_mapping_and_uv_map(nodes):
    image = bpy.data.images.new("pixels", 3, 2)
    stored = np.arange(24, dtype=np.float32) / 255
    image.alpha_mode = "CHANNEL_PACKED"  # else Cycles keeps colours multiplied by alpha
    image.pixels.foreach_set(stored)
    texture, mapping, uv = nodes.add("TexImage"), nodes.add("Mapping"), nodes.add("UVMap")
    texture.image, texture.extension, uv.uv_map = image, "EXTEND", "second"
    mapping.inputs["Scale"].default_value = (2.0, 3.0, 1.0)
    mapping.inputs["Location"].default_value = (0.5, 0.25, 0.0)
    nodes.link(uv, mapping, "Vector")
    nodes.link(mapping, texture, "Vector")
    surface = nodes.add("BsdfPrincipled")
    for name in ("Base Color", "Roughness", "Metallic"):
        nodes.link(texture, surface, name)
    row, table = nodes.read(surface)
    assert (row.base_texture, row.roughness_texture, row.metallic_texture) == (0, 1, 1)
    look_up, number = table.textures.textures
    assert CHANNELS[look_up.channel] == "color" and CHANNELS[number.channel] == "luminance"
    assert (look_up.scale_u, look_up.scale_v, look_up.offset_u, look_up.offset_v) == (2.0, 3.0, 0.5, 0.25)
    assert look_up.wrap == 1
    (pixels,) = table.textures.pool.images
    assert pixels.srgb and pixels.pixels.dtype == np.uint8
    np.testing.assert_array_equal(pixels.pixels.ravel(), np.arange(24))
    assert table.textures.attributes[look_up.uv_map] == "uv:second"
    assert table.attributes_of((0,)) == (look_up.uv_map,)
    assert table.warnings == []


def test_float_and_non_color_images_are_linear(nodes):
    surface = nodes.add("BsdfPrincipled")
    for name, is_float, space in (("Roughness", False, "Non-Color"), ("Base Color", True, None)):
        texture = nodes.add("TexImage")
        texture.image = bpy.data.images.new(name, 2, 2, float_buffer=is_float)
        if space:
            texture.image.colorspace_settings.name = space
        nodes.link(texture, surface, name)
    row, table = nodes.read(surface)
    images = table.textures.pool.images
    base = images[table.textures.textures[row.base_texture].image]
    rough = images[table.textures.textures[row.roughness_texture].image]
    assert base.pixels.dtype == np.float16 and not base.srgb  # all of it are halves
    assert rough.pixels.dtype == np.uint8 and not rough.srgb


def test_a_missing_image_is_magenta_with_a_warning(nodes):
    texture = nodes.add("TexImage")
    texture.image = bpy.data.images.new("gone", 1, 1)
    texture.image.source, texture.image.filepath = "FILE", "//no/such/file.png"
    surface = nodes.add("BsdfPrincipled")
    nodes.link(texture, surface, "Base Color")
    _, table = nodes.read(surface)
    assert table.textures.pool.images[0].pixels.ravel().tolist() == [255, 0, 255, 255]
    assert "no/such/file.png" in table.warnings[0]


PICTURED = [
    *(
        ("BsdfPrincipled", name)
        for name in (
            "Coat Tint",
            "Sheen Tint",
            "Specular Tint",
            "Coat Roughness",
            "Coat IOR",
            "Coat Normal",
            "IOR",
            "Specular IOR Level",
        )
    ),
    ("BsdfMetallic", "Edge Tint"),
    ("BsdfGlass", "Color"),
    ("BsdfGlass", "IOR"),
    ("BsdfDiffuse", "Roughness"),
    ("BsdfTransparent", "Color"),
    ("BsdfSheen", "Color"),
]


@pytest.mark.parametrize(("kind", "name"), PICTURED)
def test_a_texture_that_no_lobe_takes_is_one_warning(nodes, kind, name):
    shader, picture = nodes.add(kind), nodes.add("TexNoise")
    nodes.link(picture, shader, name)
    _, table = nodes.read(shader)
    (warning,) = table.warnings
    assert "material 'stuff'" in warning
    assert f"{name} of node {shader.name!r}" in warning


@pytest.mark.parametrize(
    "name", ["Base Color", "Roughness", "Metallic", "Coat Weight", "Sheen Weight", "Alpha"]
)
def test_a_texture_that_a_lobe_takes_is_no_warning(nodes, name):
    shader, picture = nodes.add("BsdfPrincipled"), nodes.add("TexNoise")
    nodes.link(picture, shader, name)
    _, table = nodes.read(shader)
    assert table.warnings == []

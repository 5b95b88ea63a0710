"""Passes inside Blender: what is asked for by which switch, announced, written to files and stamped."""

from __future__ import annotations

import json

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")
pytest.importorskip("OpenEXR")

from trg_blender.engine import result  # noqa: E402
from trg_blender.engine.cryptomatte import id_bits, id_of, murmur3  # noqa: E402
from trg_blender.engine.devices import find_device  # noqa: E402
from trg_blender.engine.passes import PASS_CHANNELS, PASS_NAMES  # noqa: E402
from trg_blender.ui import pass_panels, registration  # noqa: E402

from .stage import default_cube, read_exr, write_exr  # noqa: E402

SIZE = (32, 24)

needs_device = pytest.mark.skipif(
    not (find_device("cpu").available or find_device("embree").available), reason="no device to render with"
)


@pytest.fixture(autouse=True)
def registered():
    registration.register()
    yield
    registration.unregister()


@pytest.fixture
def cube():
    """Blender's default scene, small, for TRG; no pass is asked for."""
    scene = default_cube(SIZE, 4)
    for switch in switches():
        set_switch(scene.view_layers[0], switch, False)
    return scene


def switches():
    """Every switch of the table, once."""
    return sorted({each.switch for each in result.PASSES.values()})


def set_switch(layer, switch, value):
    holder, name = (layer.trg, switch[1:]) if switch.startswith(".") else (layer, switch)
    setattr(holder, name, value)


def ask_for_all(layer):
    for switch in switches():
        set_switch(layer, switch, True)


def render_layers(scene, path):
    """Renders to a multi-layer EXR; gives ({pass: {channel: (h, w)}}, header), without the layer's name."""
    write_exr(scene, path, layers=True)
    channels, header = read_exr(path)
    layer, found = scene.view_layers[0].name + ".", {}
    for name, channel in channels.items():
        if name.startswith(layer):
            group, _, last = name[len(layer) :].rpartition(".")
            found.setdefault(group, {})[last] = channel
    return found, header


class Drawn:
    """Stands for a layout: keeps which properties were drawn."""

    def __init__(self):
        self.switches = []

    def column(self, **_):
        return self

    row = column

    def prop(self, holder, name, **_):
        own = holder.bl_rna.identifier != "ViewLayer"
        assert name in holder.bl_rna.properties
        self.switches.append(("." if own else "") + name)


class Context:
    """What a panel asks of its context."""

    def __init__(self, scene):
        self.engine, self.view_layer = scene.render.engine, scene.view_layers[0]


class Panel:
    """A panel's `self`."""

    def __init__(self):
        self.layout = Drawn()


def drawn_switches(scene):
    panel = Panel()
    for each in pass_panels.CLASSES:
        each.draw(panel, Context(scene))
    return panel.layout.switches


def test_the_table_has_every_pass_of_the_engine_with_as_many_channels():
    assert sorted(result.PASSES) == sorted(PASS_NAMES)
    for name, each in result.PASSES.items():
        assert len(each.channels) == (PASS_CHANNELS[name] or 4), name


def test_every_switch_of_the_table_is_a_switch_of_blender_or_of_ours(cube):
    layer = cube.view_layers[0]
    for switch in switches():
        holder, name = (layer.trg, switch[1:]) if switch.startswith(".") else (layer, switch)
        assert holder.bl_rna.properties[name].type == "BOOLEAN", switch


def test_the_panels_show_every_switch_once(cube):
    shown = drawn_switches(cube)
    assert sorted(set(shown) - {"pass_cryptomatte_depth"}) == switches()
    assert len(shown) == len(set(shown))


def test_the_panels_show_for_this_engine_alone(cube):
    context = Context(cube)
    assert pass_panels.TRG_VIEWLAYER_PT_passes.poll(context)
    context.engine = "CYCLES"
    assert not pass_panels.TRG_VIEWLAYER_PT_passes.poll(context)


def test_a_switch_asks_for_its_passes_and_no_others(cube):
    layer = cube.view_layers[0]
    assert result.wanted_passes(layer) == ()
    for switch in switches():
        set_switch(layer, switch, True)
        expected = tuple(name for name, each in result.PASSES.items() if each.switch == switch)
        assert result.wanted_passes(layer) == expected, switch
        set_switch(layer, switch, False)


@needs_device
def test_a_file_has_the_passes_asked_for_and_no_others(cube, tmp_path):
    layer = cube.view_layers[0]
    layer.use_pass_z = layer.use_pass_glossy_direct = True
    passes, _ = render_layers(cube, tmp_path / "some.exr")
    assert set(passes) == {"Combined", result.PASSES["depth"].name, result.PASSES["glossy_direct"].name}


@needs_device
@pytest.mark.parametrize("levels", [2, 6])
def test_a_file_has_every_pass_under_blenders_name(cube, tmp_path, levels):
    layer = cube.view_layers[0]
    ask_for_all(layer)
    layer.pass_cryptomatte_depth = levels
    passes, _ = render_layers(cube, tmp_path / "all.exr")
    expected = {"Combined": "RGBA"}
    for name, each in result.PASSES.items():
        expected.update(dict.fromkeys(result.layers_of(name, levels), each.channels))
    assert {name: set(channels) for name, channels in passes.items()} == {
        name: set(channels) for name, channels in expected.items()
    }
    for name, channels in passes.items():
        for channel, values in channels.items():
            assert np.isfinite(values).all(), (name, channel)
            assert values.shape == (SIZE[1], SIZE[0])


@needs_device
def test_passes_in_a_file_add_up_to_combined(cube, tmp_path):
    ask_for_all(cube.view_layers[0])
    passes, _ = render_layers(cube, tmp_path / "all.exr")

    def read(name):
        channels = passes[result.PASSES[name].name]
        return np.stack([channels[each] for each in "RGB"], axis=-1)

    total = read("emission") + read("environment")
    for kind in ("diffuse", "glossy", "transmission"):
        total += read(f"{kind}_color") * (read(f"{kind}_direct") + read(f"{kind}_indirect"))
    combined = np.stack([passes["Combined"][each] for each in "RGB"], axis=-1)
    np.testing.assert_allclose(total, combined, rtol=1e-3, atol=1e-5)


@needs_device
def test_a_file_says_whom_the_ids_of_its_mattes_stand_for(cube, tmp_path):
    layer = cube.view_layers[0]
    ask_for_all(layer)
    passes, header = render_layers(cube, tmp_path / "mattes.exr")
    for kind, names in (("Object", {"Cube"}), ("Material", {"Material"}), ("Asset", {"Cube"})):
        title = f"{layer.name}.Crypto{kind}"
        prefix = f"cryptomatte/{murmur3(title.encode()):08x}"[: len("cryptomatte/") + 7]
        assert header[f"{prefix}/name"] == title
        assert header[f"{prefix}/hash"] == "MurmurHash3_32"
        assert header[f"{prefix}/conversion"] == "uint32_to_float32"
        manifest = json.loads(header[f"{prefix}/manifest"])
        assert names <= set(manifest)
        assert all(value == f"{id_bits(name):08x}" for name, value in manifest.items())
        first = passes[f"Crypto{kind}00"]
        middle = first["R"][SIZE[1] // 2, SIZE[0] // 2], first["G"][SIZE[1] // 2, SIZE[0] // 2]
        assert middle[0] in {np.float32(id_of(name)) for name in names}
        assert middle[1] == pytest.approx(1.0)


@needs_device
def test_a_file_without_mattes_has_no_manifest(cube, tmp_path):
    cube.view_layers[0].use_pass_mist = True
    _, header = render_layers(cube, tmp_path / "plain.exr")
    assert not [name for name in header if name.startswith("cryptomatte/")]

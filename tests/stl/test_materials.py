"""The sets of materials and the finishes."""

from __future__ import annotations

import pytest

from trg_blender.lang.library.material_table import METALS, TEAPOTS
from trg_blender.lang.scene import MaterialRecord

from .library import run_text


def materials(*calls: str) -> list[MaterialRecord]:
    """The materials that `materials::call` makes."""
    adds = "".join(f"Scene.Add(sphere(vec3(0), 1, materials::{call}));" for call in calls)
    outcome = run_text(f'include("stl/materials.trg"); Scene = scene(); {adds} Scene.Render();')
    assert outcome.diagnostics == []
    return [shape.material for shape in outcome.shapes if shape.material]


def test_the_table_by_number_is_the_whole_table_in_its_order_of_sets():
    names = [mtl.name for mtl in materials(*(f"teapot({n})" for n in range(30)))]
    assert sorted(names) == sorted(TEAPOTS)
    assert set(names[6:17]) == METALS


def test_names_by_number_are_those_of_the_materials():
    lines = "".join(f"print(materials::name({n}));" for n in range(30))
    output = run_text(f'include("stl/materials.trg"); {lines}').output
    assert output == [mtl.name for mtl in materials(*(f"teapot({n})" for n in range(30)))]


@pytest.mark.parametrize(
    ("name", "count"), [("gem", 6), ("metal", 11), ("plastic", 7), ("rubber", 6), ("teapot", 30)]
)
def test_a_set_wraps_round_and_drops_fractions(name: str, count: int):
    found = materials(*(f"{name}({n})" for n in range(count)))
    assert len({mtl.name for mtl in found}) == count
    first, below, between = materials(f"{name}({count})", f"{name}(-1)", f"{name}(1.7)")
    assert (first.name, below.name, between.name) == (found[0].name, found[-1].name, found[1].name)


def test_clear_finishes_let_light_through_with_their_index():
    water, ice, diamond, frosted, tinted = materials(
        "water()", "ice()", "diamond()", "frosted_glass(0.6)", "tinted_glass(vec3(1, 0.5, 0.25))"
    )
    assert (water.ior, ice.ior, diamond.ior) == (1.333, 1.31, 2.417)
    assert {m.transmission for m in (water, ice, diamond, frosted, tinted)} == {1}
    assert frosted.roughness == pytest.approx(0.4)
    assert tinted.base_color == (1, 0.5, 0.25)


def test_metals_are_metals_and_brushing_dulls_them():
    polished = materials("aluminium()", "iron()", "nickel()", "titanium()", "tinted_mirror()")
    assert {mtl.metallic for mtl in polished} == {1}
    (dull,) = materials("brushed(materials::aluminium(), 0.3)")
    assert dull.roughness == pytest.approx(0.7) and dull.base_color == polished[0].base_color


def test_paints_are_dull_from_lacquer_to_chalk():
    found = materials("lacquer()", "ceramic()", "clay()", "chalk()")
    roughness = [mtl.roughness for mtl in found]
    assert roughness == sorted(roughness) and roughness[-1] == 1
    assert {mtl.metallic for mtl in found} == {0}


def test_what_shines_shines():
    neon, lamp = materials("neon(vec3(0, 1, 0), 3)", "lamp(2700, 5)")
    assert (neon.emission_color, neon.emission_strength) == ((0, 1, 0), 3)
    assert lamp.emission_strength == 5 and max(lamp.emission_color) == pytest.approx(1)


def kelvin(*temperatures: float) -> list[tuple[float, ...]]:
    (found) = materials(*(f"lamp({t})" for t in temperatures))
    return [mtl.emission_color for mtl in found]


def test_a_black_body_of_6500_kelvin_is_nearly_white():
    ((r, g, b),) = kelvin(6500)
    assert min(r, g, b) > 0.93


def test_lamps_grow_bluer_with_their_temperature():
    found = kelvin(1000, 1900, 2700, 4000, 5500, 8000, 12000)
    ratios = [b / r for r, _, b in found]
    assert ratios == sorted(ratios) and ratios[0] < 0.01 and ratios[-1] > 1.3
    assert all(0 <= part <= 1 for colour in found for part in colour)


def test_every_call_gives_a_fresh_material():
    first, second = materials("gem(0)", "gem(0)")
    assert first.key != second.key

"""Arrangements: where the places lie."""

from __future__ import annotations

from itertools import pairwise
from math import atan2, dist, hypot, pi

import pytest

from trg_blender.lang.scene import Vec3

from .library import run_text


def places(call: str) -> list[Vec3]:
    """The points of the list that `arrange::call` returns."""
    program = f"""
        include("stl/arrange.trg"); Scene = scene();
        for (place in arrange::{call}) Scene.Add(sphere(place, 1));
        Scene.Render();
    """
    outcome = run_text(program)
    assert outcome.diagnostics == []
    return [shape.parameters[0] for shape in outcome.shapes]  # type: ignore[misc]


def test_a_ring_has_equal_radii_and_equal_steps():
    found = places("ring(7, 3)")
    assert [hypot(x, z) for x, _, z in found] == pytest.approx([3] * 7)
    assert {y for _, y, _ in found} == {0}
    steps = [dist(a, b) for a, b in pairwise([*found, found[0]])]
    assert steps == pytest.approx([steps[0]] * 7)
    assert found[0] == (3, 0, 0)


def test_a_row_includes_both_ends_and_one_place_is_its_start():
    assert places("row(3, vec3(0), vec3(2, 4, 0))") == [(0, 0, 0), (1, 2, 0), (2, 4, 0)]
    assert places("row(1, vec3(1), vec3(2))") == [(1, 1, 1)]


def test_a_grid_is_centred_and_evenly_spaced():
    found = places("grid(4, 3, 2)")
    assert len(found) == 12
    assert sorted({x for x, _, _ in found}) == [-3, -1, 1, 3]
    assert sorted({z for _, _, z in found}) == [-2, 0, 2]
    assert {y for _, y, _ in found} == {0}


def test_a_block_stands_on_the_ground():
    found = places("block(2, 3, 2, 0.5)")
    assert len(set(found)) == 12
    assert sorted({y for _, y, _ in found}) == [0, 0.5, 1]


def test_a_spiral_grows_evenly_from_the_middle():
    found = places("spiral(31, 6, 3, 2)")
    assert [hypot(x, z) for x, _, z in found] == pytest.approx([6 * k / 30 for k in range(31)])
    assert [y for _, y, _ in found] == pytest.approx([2 * k / 30 for k in range(31)])
    turns = sum((atan2(b[2], b[0]) - atan2(a[2], a[0])) % (2 * pi) for a, b in pairwise(found[1:]))
    assert turns == pytest.approx(3 * 2 * pi * 29 / 30)


def test_a_helix_keeps_its_radius_and_reaches_its_height():
    found = places("helix(20, 2, 4, 3)")
    assert [hypot(x, z) for x, _, z in found] == pytest.approx([2] * 20)
    assert (found[0][1], found[-1][1]) == (0, 3)


def test_the_places_of_a_sunflower_keep_their_distance():
    found = places("sunflower(150)")
    nearest = min(dist(a, b) for k, a in enumerate(found) for b in found[:k])
    assert nearest > 0.99
    assert max(hypot(x, z) for x, _, z in found) == pytest.approx(149**0.5)


def test_scatter_is_the_same_for_a_seed_and_another_for_another():
    assert places("scatter(20, vec3(0), vec3(9), 4)") == places("scatter(20, vec3(0), vec3(9), 4)")
    assert places("scatter(20, vec3(0), vec3(9), 4)") != places("scatter(20, vec3(0), vec3(9), 5)")


def test_scatter_stays_in_its_box_and_fills_it():
    found = places("scatter(400, vec3(-1, 2, 5), vec3(3, 4, 9), 8)")
    assert len(found) == 400
    for axis, (low, high) in enumerate(((-1, 3), (2, 4), (5, 9))):
        values = [place[axis] for place in found]
        assert low <= min(values) < low + 0.1 * (high - low)
        assert high - 0.1 * (high - low) < max(values) < high
        assert sum(values) / 400 == pytest.approx((low + high) / 2, abs=0.09 * (high - low))


def test_scatter_keeps_the_gap_even_where_not_all_fit():
    found = places("scatter(300, vec3(0), vec3(4, 0, 4), 2, 0.5)")
    assert 30 < len(found) < 300
    assert min(dist(a, b) for k, a in enumerate(found) for b in found[:k]) >= 0.5


def test_scatter_leaves_the_random_numbers_of_the_program_alone():
    program = 'include("stl/arrange.trg"); {} print(mth::rand());'
    plain = run_text(program.format("")).output
    assert run_text(program.format("arrange::scatter(9);")).output == plain


def test_a_heading_turns_plus_z_outwards():
    program = (
        'include("stl/arrange.trg"); for (p in [vec3(0, 0, 2), vec3(3, 0, 0)]) print(arrange::heading(p));'
    )
    assert run_text(program).output == ["0", "90"]


def test_the_generator_is_the_minimal_standard():
    program = """
        include("stl/random.trg");
        r = random::make(1); r.state = 1;
        for (k = 0; k < 10000; k++) r.Next();
        print(r.state);
    """
    assert run_text(program).output == ["1043618065"]

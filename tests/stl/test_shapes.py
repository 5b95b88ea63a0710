"""Shapes composed in TRG: how many parts, how large, where they stand."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise
from math import cos, hypot, pi, radians, tan

import pytest

from trg_blender.lang.scene import ShapeRecord

from .library import bounds, build, run_text, world_points

NEAR = {"abs": 1e-9}


def test_a_fence_has_a_post_and_a_ball_at_each_corner():
    shapes = build("shapes::fence(4, 1, 7)", "stl/shapes/fence.trg")
    assert Counter(shape.kind for shape in shapes) == {"fence": 1, "cylinder": 7, "sphere": 7}
    for post in (shape for shape in shapes if shape.kind == "cylinder"):
        x, y, z = post.transform[3], post.transform[7], post.transform[11]
        assert hypot(x, z) == pytest.approx(4 / cos(pi / 7))
        assert y == 0


def test_a_flight_rises_step_by_step_along_minus_z():
    shapes = build("shapes::stairs(12, 2, 0.2, 0.3)", "stl/shapes/stairs.trg")
    tops = [shape.parameters[1][1] for shape in shapes]
    assert tops == pytest.approx([0.2 * (k + 1) for k in range(12)])
    low, high = bounds(shapes)
    assert (low, high) == (pytest.approx((-1, 0, -3.6)), pytest.approx((1, 2.4, 0), **NEAR))


def test_a_spiral_stair_has_treads_posts_and_a_closed_rail():
    shapes = build("shapes::spiral_stairs(16, 1.5, 0.2, 22.5)", "stl/shapes/stairs.trg")
    kinds = Counter(shape.kind for shape in shapes)
    assert kinds == {"box": 16, "cylinder": 1 + 16 + 45, "sphere": 46}
    treads = [shape for shape in shapes if shape.kind == "box"]
    assert [tread.transform[7] for tread in treads] == pytest.approx([0.2 * (k + 1) for k in range(16)])
    assert len({tread.mesh_key for tread in treads}) == 1


def test_a_gear_has_its_teeth_between_root_and_tip():
    shapes = build("shapes::gear(18, 0.5, 0.4)", "stl/shapes/gear.trg")
    assert Counter(shape.kind for shape in shapes) == {"cylinder": 8, "triangle": 180}
    reach = [hypot(p[0], p[2]) for shape in shapes if shape.kind == "triangle" for p in world_points(shape)]
    half = 0.96 * 0.5 * pi / 4 - tan(radians(20)) * 0.5
    assert max(reach) == pytest.approx(hypot(18 * 0.25 + 0.5, half))
    assert min(reach) < 18 * 0.25 - 1.25 * 0.5
    low, high = bounds(shapes)
    assert low[1] == pytest.approx(0, **NEAR) and high[1] == pytest.approx(0.4 * 1.3)


@pytest.mark.parametrize(
    ("first", "second", "heading"), [(24, 12, 0), (17, 11, 0), (20, 13, 65), (9, 30, -120)]
)
@pytest.mark.parametrize("turn", [0, 7])
def test_gears_that_mesh_show_a_tooth_to_a_gap(first: int, second: int, heading: float, turn: float):
    line = f"print(shapes::meshed({first}, {turn}, {second}, {heading}));"
    other = float(run_text(f'include("stl/shapes/gear.trg"); {line}').output[0])
    phase = ((heading - turn) * first / 360) % 1
    facing = ((heading + 180 - other) * second / 360) % 1
    assert (phase + facing) % 1 == pytest.approx(0.5)


def test_gears_that_mesh_turn_against_each_other_in_the_ratio_of_their_teeth():
    lines = "print(shapes::meshed(24, 0, 12)); print(shapes::meshed(24, 3, 12));"
    before, after = map(float, run_text(f'include("stl/shapes/gear.trg"); {lines}').output)
    assert after - before == pytest.approx(-6)


def test_a_spring_is_a_closed_wire_between_floor_and_height():
    shapes = build("shapes::spring(5, 0.6, 2, 0.05)", "stl/shapes/spring.trg")
    kinds = Counter(shape.kind for shape in shapes)
    assert kinds == {"sphere": 181, "cylinder": 180}
    assert len({shape.mesh_key for shape in shapes}) == 2
    balls = [shape for shape in shapes if shape.kind == "sphere"]
    assert all(hypot(b.transform[3], b.transform[11]) == pytest.approx(0.6) for b in balls)
    heights = [ball.transform[7] for ball in balls]
    assert heights == sorted(heights)
    assert (heights[0], heights[-1]) == (pytest.approx(0.05), pytest.approx(1.95))


def test_every_rod_of_a_spring_reaches_from_ball_to_ball():
    shapes = build("shapes::spring(2.5, 0.6, 2, 0.05)", "stl/shapes/spring.trg")
    balls = [(s.transform[3], s.transform[7], s.transform[11]) for s in shapes if s.kind == "sphere"]
    rods = [shape for shape in shapes if shape.kind == "cylinder"]
    for rod, (start, end) in zip(rods, pairwise(balls), strict=True):
        _, _, length = rod.parameters
        tip = tuple(rod.transform[4 * row + 1] * length + rod.transform[4 * row + 3] for row in range(3))
        assert (rod.transform[3], rod.transform[7], rod.transform[11]) == pytest.approx(start)
        assert tip == pytest.approx(end, abs=1e-6)


@pytest.mark.parametrize("direction", ["0, 3, 0", "0, -3, 0", "2, 0, 0", "0, 0, -1", "1, -2, 3"])
def test_a_rod_ends_where_it_is_told(direction: str):
    program = 'include("stl/shapes/rod.trg"); Scene = scene();'
    call = f"Scene.Add(shapes::rod(vec3(1, 2, 3), vec3(1, 2, 3) + vec3({direction}), 0.1));"
    (rod,) = run_text(f"{program} {call} Scene.Render();").shapes
    m, length = rod.transform, rod.parameters[2]
    step = [float(part) for part in direction.split(",")]
    assert [m[4 * r + 1] * length + m[4 * r + 3] for r in range(3)] == pytest.approx(
        [c + s for c, s in zip((1, 2, 3), step, strict=True)], abs=1e-9
    )


def _reach(brick: ShapeRecord) -> tuple[float, float]:
    """From where to where along X."""
    low, high = bounds((brick,))
    return low[0], high[0]


def test_a_wall_keeps_its_length_and_shifts_every_other_row():
    shapes = build("shapes::brick_wall(4, 1, vec3(0.5, 0.2, 0.25))", "stl/shapes/wall.trg")
    bricks = [shape for shape in shapes if shape.mesh_key != shapes[0].mesh_key]
    assert bricks
    rows = sorted({round(brick.transform[7], 9) for brick in bricks})
    assert rows == pytest.approx([0, 0.24, 0.48, 0.72])
    low, high = bounds(tuple(bricks))
    assert (low[0], high[0]) == (pytest.approx(-2), pytest.approx(2))
    first, second = (
        [(x[0], x[1]) for x in (_reach(b) for b in bricks if b.transform[7] == pytest.approx(height, **NEAR))]
        for height in (0, 0.24)
    )
    assert first[0] == (pytest.approx(-2), pytest.approx(-1.5))
    assert second[0] == (pytest.approx(-2), pytest.approx(-1.77))
    for row in (first, second):
        assert all(b[0] - a[1] == pytest.approx(0.04) for a, b in pairwise(row))
    assert len({brick.mesh_key for brick in bricks}) == 1


def test_the_shades_of_a_wall_follow_its_seed():
    def colours(seed: int) -> list[tuple[float, float, float]]:
        shapes = build(
            f"shapes::brick_wall(2, 1, vec3(0.24, 0.07, 0.115), vec3(0.4), {seed})", "stl/shapes/wall.trg"
        )
        return [shape.material.base_color for shape in shapes if shape.material]

    assert colours(1) == colours(1) != colours(2)


def test_what_one_does_to_a_group_every_part_does():
    shapes = build("shapes::stairs(3).Move(vec3(1, 2, 3)).Material(material::gold())", "stl/shapes.trg")
    assert all((s.transform[3], s.transform[7], s.transform[11]) == (1, 2, 3) for s in shapes)
    assert {shape.material.name for shape in shapes if shape.material} == {"gold"}


def test_a_copy_of_a_group_shares_the_meshes_and_stands_alone():
    program = """
        include("stl/shapes.trg"); Scene = scene();
        first = shapes::stairs(3);
        second = first.Copy().Move(vec3(5, 0, 0)).Scale(2);
        first.AddTo(Scene); second.AddTo(Scene);
        Scene.Render();
    """
    shapes = run_text(program).shapes
    assert [shape.transform[3] for shape in shapes] == [0, 0, 0, 10, 10, 10]
    assert [s.mesh_key for s in shapes[:3]] == [s.mesh_key for s in shapes[3:]]

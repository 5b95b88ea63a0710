"""Cameras: where a ride begins, passes and ends."""

from __future__ import annotations

from math import dist, hypot

import pytest

from trg_blender.lang.scene import CameraRecord

from .library import run_text


def cameras(call: str, moments: list[float]) -> list[CameraRecord]:
    """The cameras that `cameras::call` gives; the call names its moment t."""
    program = f"""
        include("stl/cameras.trg"); Scene = scene();
        points = [vec3(0, 1, 0), vec3(4, 1, 0), vec3(4, 2, 4), vec3(0, 3, 4)];
        for (t in {moments})
        {{
            cameras::shoot(Scene, cameras::{call});
            Scene.Render();
        }}
    """
    outcome = run_text(program, len(moments))
    assert outcome.diagnostics == []
    return [frame.camera for frame in outcome.frames if frame.camera]


def test_a_full_orbit_returns_to_its_start():
    first, last = cameras("orbit(t, vec3(1, 2, 3), 6, 3)", [0, 1])
    assert (first.location, first.target, first.up) == (last.location, last.target, last.up)


def test_an_orbit_keeps_its_distance_and_looks_at_the_middle():
    for camera in cameras("orbit(t, vec3(1, 2, 3), 6, 3)", [0, 0.2, 0.45, 0.8]):
        x, y, z = camera.location
        assert hypot(x - 1, z - 3) == pytest.approx(6)
        assert y == 5 and camera.target == (1, 2, 3)


def test_a_dolly_goes_from_end_to_end_with_its_eye_on_the_target():
    found = cameras("dolly(t, vec3(0, 1, 9), vec3(4, 1, 1), vec3(0, 2, 0))", [0, 0.5, 1])
    assert [camera.location for camera in found] == [(0, 1, 9), (2, 1, 5), (4, 1, 1)]
    assert {camera.target for camera in found} == {(0, 2, 0)}


def test_a_track_keeps_its_direction():
    found = cameras("track(t, vec3(0, 1, 9), vec3(4, 1, 9), vec3(0, 1, 0))", [0, 0.3, 1])
    for camera in found:
        step = [a - b for a, b in zip(camera.target, camera.location, strict=True)]
        assert step == pytest.approx([0, 0, -9])


def test_a_path_passes_through_its_points():
    found = cameras("path(t, points, vec3(2, 0, 2))", [0, 1 / 3, 2 / 3, 1])
    wanted = [(0, 1, 0), (4, 1, 0), (4, 2, 4), (0, 3, 4)]
    for camera, point in zip(found, wanted, strict=True):
        assert camera.location == pytest.approx(point, abs=1e-9)
        assert camera.target == (2, 0, 2)


def test_a_closed_path_passes_through_its_points_and_returns():
    found = cameras("path(t, points, vec3(2, 0, 2), 1)", [0, 0.25, 0.5, 0.75, 1])
    wanted = [(0, 1, 0), (4, 1, 0), (4, 2, 4), (0, 3, 4), (0, 1, 0)]
    for camera, point in zip(found, wanted, strict=True):
        assert camera.location == pytest.approx(point, abs=1e-9)


@pytest.mark.parametrize("call", ["path(t, points)", "path(t, points, vec3(0), 1)"])
def test_a_path_has_no_jumps(call: str):
    moments = [k / 400 for k in range(401)]
    found = [camera.location for camera in cameras(call, moments)]
    steps = [dist(a, b) for a, b in zip(found, found[1:], strict=False)]
    assert max(steps) < 0.06
    turns = [
        dist(b, [2 * m - a for a, m in zip(x, y, strict=True)])
        for x, y, b in zip(found, found[1:], found[2:], strict=False)
    ]
    assert max(turns) < 0.002


def test_a_flight_looks_where_it_goes():
    found = cameras("fly(t, points)", [0, 0.01, 0.5, 0.51, 1])
    for here, later in ((found[0], found[1]), (found[2], found[3])):
        way = [b - a for a, b in zip(here.location, later.location, strict=True)]
        gaze = [b - a for a, b in zip(here.location, here.target, strict=True)]
        cosine = sum(a * b for a, b in zip(way, gaze, strict=True)) / (hypot(*way) * hypot(*gaze))
        assert cosine > 0.998


def test_two_points_make_a_straight_path():
    program = """
        include("stl/cameras.trg");
        for (t in [0, 0.25, 1, 1.5]) print(cameras::along(t, [vec3(0), vec3(4, 0, 8)]));
    """
    assert run_text(program).output == ["vec3(0, 0, 0)", "vec3(1, 0, 2)", "vec3(4, 0, 8)", "vec3(6, 0, 12)"]


def test_easing_keeps_the_ends_and_stops_beyond_them():
    program = 'include("stl/cameras.trg"); for (t in [-1, 0, 0.5, 1, 2]) print(cameras::ease(t));'
    assert run_text(program).output == ["0", "0", "0.5", "1", "1"]


def test_shoot_sets_size_and_angle():
    program = """
        include("stl/cameras.trg"); Scene = scene();
        cameras::shoot(Scene, cameras::look(vec3(1, 2, 3)), 800, 600, 30);
        Scene.Render();
    """
    camera = run_text(program).frames[0].camera
    assert camera is not None
    assert (camera.width, camera.height, camera.fov_degrees) == (800, 600, 30)
    assert (camera.location, camera.target, camera.up) == ((1, 2, 3), (0, 0, 0), (0, 1, 0))

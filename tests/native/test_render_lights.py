"""Lights of the native renderer against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from trg_blender.engine.scene_arrays import Light, Material

from .render_scenes import (
    ELLIPSE,
    GREY,
    POINT,
    RECTANGLE,
    SPOT,
    SUN,
    WHITE,
    Camera,
    Settings,
    add_object,
    make_floor,
    make_sphere,
    new_scene,
    picture,
)

NARROW = Camera(eye=(0.0, 0.0, 0.5), half_width=1e-3)


def floor_radiance(lights: list[Light], material: Material = GREY, x: float = 0.0, bounces: int = 0) -> float:
    """Radiance of a grey floor at (x, 0, 0), seen from above."""
    scene = new_scene([material], lights=lights)
    add_object(scene, make_floor(10.0))
    settings = Settings(8, 8, samples=256, bounces=bounces)
    pixels = picture(scene, settings, Camera(eye=(x, 0.0, 0.5), half_width=1e-3))
    assert np.ptp(pixels[..., :3], axis=2).max() == 0.0
    return float(pixels[..., 0].mean())


def area_light(kind: int, half: float, height: float, radiance: float = 1.0) -> Light:
    return Light(kind, radiance, radiance, radiance, position_z=height, direction_z=-1.0, axis_u_x=half,
                 axis_v_y=half)


@pytest.mark.parametrize("angle", [0.0, 0.01, 0.3])
def test_a_sun_gives_its_irradiance(angle: float) -> None:
    tilted = Light(SUN, 3.0, 3.0, 3.0, direction_x=0.6, direction_z=0.8, angle=angle)
    assert floor_radiance([tilted]) == pytest.approx(3.0 * 0.8 * 0.5 / np.pi, rel=2e-3)


@pytest.mark.parametrize("x", [0.0, 1.0, 3.0])
def test_a_point_falls_off_by_square_and_cosine(x: float) -> None:
    light = Light(POINT, 5.0, 5.0, 5.0, position_z=2.0)
    d2 = 4.0 + x * x
    assert floor_radiance([light], x=x) == pytest.approx(0.5 / np.pi * 5.0 / d2 * 2.0 / np.sqrt(d2), rel=1e-4)


def test_a_sphere_shines_like_its_point() -> None:
    light = Light(POINT, 5.0, 5.0, 5.0, position_z=2.0, radius=0.7)
    assert floor_radiance([light]) == pytest.approx(0.5 / np.pi * 5.0 / 4.0, rel=2e-3)


def test_a_spot_follows_smoothstep_between_its_cones() -> None:
    for x in (0.0, 0.9, 1.1, 2.0):
        light = Light(SPOT, 5.0, 5.0, 5.0, position_z=2.0, direction_z=-1.0, cos_outer=0.85, cos_inner=0.95)
        cosine = 2.0 / np.hypot(2.0, x)
        t = min(max((cosine - 0.85) / 0.1, 0.0), 1.0)
        expected = 0.5 / np.pi * 5.0 / (4.0 + x * x) * cosine * t * t * (3 - 2 * t)
        assert floor_radiance([light], x=x) == pytest.approx(expected, rel=5e-3, abs=1e-9)


def test_the_papers_falloff_is_capped_at_one() -> None:
    for height, coefficients in ((0.1, (0.0, 1.0, 0.0)), (2.0, (0.0, 1.0, 0.0)), (3.0, (0.5, 0.25, 2.0))):
        c, linear, q = coefficients
        light = Light(POINT, 5.0, 5.0, 5.0, position_z=height, radius=9.0, falloff_constant=c,
                      falloff_linear=linear, falloff_quadratic=q)
        factor = min(1.0, 1.0 / (c + linear * height + q * height * height))
        assert floor_radiance([light]) == pytest.approx(0.5 / np.pi * 5.0 * factor, rel=1e-3)


def square_form_factor(half: float, height: float) -> float:
    """Of a parallel square straight above a point (Siegel and Howell, four equal quarters)."""
    x = half / np.hypot(half, height)
    return 4.0 * 2.0 * x * np.arctan(half / np.hypot(half, height)) / (2.0 * np.pi)


@pytest.mark.parametrize("height", [0.05, 0.5, 2.0, 100.0])
def test_a_rectangle_gives_its_form_factor(height: float) -> None:
    expected = 0.5 * square_form_factor(0.5, height)
    scene = new_scene([GREY], lights=[area_light(RECTANGLE, 0.5, height)])
    add_object(scene, make_floor(10.0))
    settings = Settings(16, 16, samples=1024, bounces=0)
    pixels = picture(scene, settings, Camera(eye=(0.0, 0.0, 0.02), half_width=1e-3))
    assert pixels[..., :3].mean() == pytest.approx(expected, rel=5e-3)


@pytest.mark.parametrize("height", [0.02, 0.2, 0.45, 0.49, 1.0])
def test_a_disc_gives_its_form_factor(height: float) -> None:
    expected = 0.5 * 0.5**2 / (0.5**2 + height**2)
    scene = new_scene([GREY], lights=[area_light(ELLIPSE, 0.5, height)])
    add_object(scene, make_floor(10.0))
    settings = Settings(16, 16, samples=1024, bounces=0)
    pixels = picture(scene, settings, Camera(eye=(0.0, 0.0, 0.01), half_width=1e-3))
    assert pixels[..., :3].mean() == pytest.approx(expected, rel=3e-3)


@pytest.mark.parametrize(("x", "height"), [(2.0, 0.5), (4.5, 0.1), (7.9, 3.0), (8.1, 3.0), (30.0, 3.0)])
@pytest.mark.parametrize("turn", [0.0, 0.5])
def test_a_rectangle_lights_a_point_beside_it(x: float, height: float, turn: float) -> None:
    """By the integral over a fine grid, however near; of a skewed one too."""
    light = area_light(RECTANGLE, 1.0, height)
    light.axis_v_x = turn
    a, b = np.meshgrid(*2 * [(np.arange(800) + 0.5) / 400 - 1.0])
    d2 = (a + turn * b - x) ** 2 + b**2 + height**2
    expected = 0.5 / np.pi * 4.0 * np.mean(height**2 / d2**2)
    scene = new_scene([GREY], lights=[light])
    add_object(scene, make_floor(100.0))
    settings = Settings(16, 16, samples=1024, bounces=0)
    pixels = picture(scene, settings, Camera(eye=(x, 0.0, 0.02), half_width=1e-3))
    assert pixels[..., :3].mean() == pytest.approx(expected, rel=1e-3)


def test_an_area_light_shines_to_one_side_only() -> None:
    light = area_light(RECTANGLE, 0.5, 1.0)
    light.direction_z = 1.0
    assert floor_radiance([light]) == 0.0


def test_emissive_triangles_shine_like_an_area_light() -> None:
    glow = Material(0.0, 0.0, 0.0, specular=0.0, emission_r=2.0, emission_g=2.0, emission_b=2.0)
    for floor in (GREY, Material(0.8, 0.8, 0.8, metallic=1.0, roughness=0.4)):
        scene = new_scene([floor, glow])
        add_object(scene, make_floor(10.0))
        add_object(scene, make_floor(0.5, 1.0), 1)
        emissive = picture(scene, Settings(16, 16, samples=512, bounces=1), NARROW)[..., :3].mean()
        area = floor_radiance([area_light(RECTANGLE, 0.5, 1.0, 2.0)], floor, bounces=1)
        assert emissive == pytest.approx(area, rel=5e-3)


def test_emission_shows_on_both_sides_and_to_the_camera() -> None:
    glow = Material(0.0, 0.0, 0.0, specular=0.0, emission_r=3.0, emission_g=2.0, emission_b=1.0)
    for z in (1.0, -1.0):
        scene = new_scene([glow])
        add_object(scene, make_floor(10.0))
        axes = np.diag([1.0, z, z])
        pixels = picture(scene, Settings(4, 4, samples=4), Camera(eye=(0, 0, z), axes=axes))
        assert pixels[0, 0, :3] == pytest.approx([3.0, 2.0, 1.0])


def test_lights_with_extent_are_not_seen_by_the_camera_and_hide_nothing() -> None:
    light = area_light(RECTANGLE, 0.5, 1.0)
    light.direction_z = 1.0
    scene = new_scene([WHITE], world=1.0, lights=[light])
    add_object(scene, make_floor(10.0))
    pixels = picture(scene, Settings(8, 8, samples=64, bounces=0), Camera(eye=(0, 0, 3), half_width=0.1))
    assert pixels[..., :3].mean() == pytest.approx(1.0, abs=1e-6)


def test_many_lights_add_up() -> None:
    lights = [Light(POINT, 5.0, 5.0, 5.0, position_z=2.0), area_light(RECTANGLE, 0.5, 1.0, 3.0),
              *(Light(SUN, 1.0, 1.0, 1.0, angle=0.02) for _ in range(6)),
              Light(SPOT, 0.01, 0.01, 0.01, position_z=1.0, direction_z=-1.0, cos_outer=0.5, cos_inner=0.9)]
    apart = sum(floor_radiance([light]) for light in lights)
    assert floor_radiance(lights) == pytest.approx(apart, rel=1e-2)


def test_every_further_bounce_adds_one_scattering() -> None:
    # Inside a closed sphere of emission 1 and albedo 1/2 the radiance is 1 + 1/2 + 1/4 ...
    glow = Material(0.5, 0.5, 0.5, specular=0.0, emission_r=1.0, emission_g=1.0, emission_b=1.0)
    for bounces in (0, 1, 4):
        scene = new_scene([glow])
        add_object(scene, make_sphere(24))
        camera = Camera(eye=(0.0, 0.0, 0.0), half_width=1.0, kind=0)
        pixels = picture(scene, Settings(16, 16, samples=256, bounces=bounces), camera)
        expected = sum(0.5**k for k in range(bounces + 2))
        assert pixels[..., :3].mean() == pytest.approx(expected, rel=2e-3)

"""The reference renderer alone, against what pen and paper give."""

from __future__ import annotations

import math

import numpy as np
import pytest

from trg_blender.engine.scene_arrays import (
    ImageArrays,
    Light,
    Material,
    RenderSettings,
    SceneArrays,
    Texture,
)

from .arrays import box, floor_scene, light, look_at, place, quad

pytest.importorskip("embreex", reason="the reference renderer needs embreex")
from trg_blender.engine.reference import render_reference

WHITE = Material(1.0, 1.0, 1.0, specular=0.0)
SETTINGS = RenderSettings(8, 8, samples=256, max_bounces=4)


def picture(scene: SceneArrays, settings: RenderSettings = SETTINGS) -> np.ndarray:
    film = render_reference(scene, settings)
    assert film.rejected_samples == 0
    return film.mean(film.sums.sum(axis=0))


def center(scene: SceneArrays, settings: RenderSettings = SETTINGS) -> np.ndarray:
    return picture(scene, settings).mean(axis=(0, 1))


def narrow(scene: SceneArrays) -> SceneArrays:
    """The camera sees a spot of 6 mm only, over which nothing changes."""
    scene.camera = look_at((0.0, 0.0, 0.5), (0, 0, 0), 0.003)
    return scene


def irradiance(*lights: Light, world=(0.0, 0.0, 0.0)) -> np.ndarray:
    """On the floor at the origin, read off a white Lambert surface."""
    return math.pi * center(narrow(floor_scene(WHITE, *lights, world=world)))


@pytest.mark.parametrize("roughness", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("kind", ["diffuse", "plastic", "metal", "glass"])
def test_in_a_furnace_nothing_gains_energy(kind: str, roughness: float):
    material = {
        "diffuse": WHITE,
        "plastic": Material(1, 1, 1, roughness=roughness),
        "metal": Material(1, 1, 1, roughness=roughness, metallic=1.0),
        "glass": Material(1, 1, 1, roughness=roughness, transmission=1.0),
    }[kind]
    value = center(floor_scene(material, world=(1.0, 1.0, 1.0)), RenderSettings(8, 8, 1024, max_bounces=4))
    assert (value <= 1.003).all()
    if kind == "diffuse" or roughness == 0.0:
        assert value == pytest.approx(1.0, abs=2e-3)


def white_metal(multiscatter: float) -> np.ndarray:
    """Directional albedo, at normal incidence, of facets that reflect everything at alpha 1."""
    metal = Material(1, 1, 1, roughness=1.0, metallic=1.0, multiscatter=multiscatter)
    return center(narrow(floor_scene(metal, world=(1.0, 1.0, 1.0))), RenderSettings(8, 8, 4096))


def test_white_rough_metal_without_multiscatter_loses_what_single_scattering_loses():
    """At normal incidence and alpha 1 the directional albedo of GGX is 1 - ln 2."""
    assert white_metal(0.0) == pytest.approx(1.0 - math.log(2.0), abs=2e-3)


def test_white_rough_metal_with_multiscatter_loses_nothing():
    assert white_metal(1.0) == pytest.approx(1.0, abs=5e-3)


def test_a_closed_glass_box_in_a_furnace_is_invisible():
    scene = floor_scene(Material(1, 1, 1, transmission=1.0, roughness=0.0), world=(1.0, 1.0, 1.0))
    scene.meshes, scene.instances = [box(0.5)], [place(0)]
    assert center(scene, RenderSettings(8, 8, 256, max_bounces=64)) == pytest.approx(1.0, abs=1e-3)


def test_a_sun_gives_irradiance_times_cosine():
    direction = np.array([0.3, 0.4, 1.2]) / 1.3
    assert irradiance(light("sun", (2.0, 1.0, 0.5), direction=direction)) == pytest.approx(
        np.array([2.0, 1.0, 0.5]) * direction[2], rel=1e-6
    )


def test_a_sun_with_angle_gives_the_same_irradiance():
    sun = light("sun", (2.0, 1.0, 0.5), direction=(0, 0, 1), angle=0.5)
    assert irradiance(sun) == pytest.approx([2.0, 1.0, 0.5], rel=3e-3)


@pytest.mark.parametrize("radius", [0.0, 0.5])
def test_a_point_gives_intensity_over_distance_squared(radius: float):
    bulb = light("point", (3.0, 2.0, 1.0), (0.0, 0.0, 2.0), radius=radius)
    assert irradiance(bulb) == pytest.approx(np.array([3.0, 2.0, 1.0]) / 4.0, rel=5e-3)


def test_falloff_is_held_at_one_near_the_light():
    near = light("point", (2.0, 2.0, 2.0), (0.0, 0.0, 0.8), falloff=(0.2, 0.0, 1.0))
    far = light("point", (2.0, 2.0, 2.0), (0.0, 0.0, 2.0), falloff=(0.2, 0.5, 1.0))
    assert irradiance(near) == pytest.approx(2.0, rel=1e-4)
    assert irradiance(far) == pytest.approx(2.0 / 5.2, rel=1e-4)


def test_a_spot_is_a_smoothstep_between_its_cosines():
    cosine = math.cos(math.radians(20.0))
    direction = (math.sin(math.radians(20.0)), 0.0, -cosine)
    outer, inner = cosine - 0.03, cosine + 0.01
    spot = light("spot", (8.0, 8.0, 8.0), (0, 0, 2.0), direction=direction, cos_outer=outer, cos_inner=inner)
    x = (cosine - outer) / (inner - outer)
    assert irradiance(spot) == pytest.approx(8.0 / 4.0 * x * x * (3 - 2 * x), rel=1e-2)


def parallel_rectangle(a: float, b: float, h: float) -> float:
    """Form factor from a point to a rectangle of half sides a, b at height h above it (Howell, B-4)."""
    x, y = a / h, b / h
    p, q = math.sqrt(1 + x * x), math.sqrt(1 + y * y)
    return 4.0 / (2.0 * math.pi) * (x / p * math.atan(y / p) + y / q * math.atan(x / q))


def test_a_rectangle_gives_its_form_factor():
    lamp = light(
        "area_rectangle",
        (2.0, 1.0, 0.5),
        (0, 0, 1.2),
        direction=(0, 0, -1),
        axis_u=(0.7, 0, 0),
        axis_v=(0, 0.4, 0),
    )
    expected = math.pi * parallel_rectangle(0.7, 0.4, 1.2) * np.array([2.0, 1.0, 0.5])
    assert irradiance(lamp) == pytest.approx(expected, rel=5e-3)


def test_an_area_light_is_dark_behind():
    lamp = light(
        "area_rectangle",
        (2.0, 1.0, 0.5),
        (0, 0, 1.2),
        direction=(0, 0, 1),
        axis_u=(0.7, 0, 0),
        axis_v=(0, 0.4, 0),
    )
    assert irradiance(lamp) == pytest.approx(0.0, abs=1e-12)


def test_a_disc_gives_its_form_factor():
    lamp = light(
        "area_ellipse",
        (2.0, 1.0, 0.5),
        (0, 0, 1.2),
        direction=(0, 0, -1),
        axis_u=(0.7, 0, 0),
        axis_v=(0, 0.7, 0),
    )
    expected = math.pi * 0.49 / (0.49 + 1.44) * np.array([2.0, 1.0, 0.5])
    assert irradiance(lamp) == pytest.approx(expected, rel=5e-3)


def test_a_glowing_square_gives_its_form_factor():
    scene = narrow(floor_scene(WHITE))
    scene.meshes.append(quad(0.6, 1.1))
    scene.materials.append(Material(0, 0, 0, specular=0.0, emission_r=2.0, emission_g=1.0))
    scene.instances.append(place(1, 1))
    expected = parallel_rectangle(0.6, 0.6, 1.1) * np.array([2.0, 1.0, 0.0])
    assert center(scene) == pytest.approx(expected, rel=5e-3)


def test_a_mirror_shows_the_world_times_its_colour():
    scene = narrow(floor_scene(Material(0.9, 0.5, 0.2, metallic=1.0, roughness=0.0), world=(1.0, 2.0, 3.0)))
    assert center(scene) == pytest.approx([0.9, 1.0, 0.6], rel=1e-4)


def test_a_glass_pane_passes_what_all_its_reflections_leave():
    scene = narrow(floor_scene(Material(0, 0, 0, specular=0.0, emission_r=1.0)))
    scene.camera = look_at((0.0, 0.0, 2.0), (0, 0, 0), 0.003)
    scene.meshes.append(box(0.5))
    scene.materials.append(Material(1, 1, 1, transmission=1.0, roughness=0.0, ior=1.5))
    scene.instances.append(place(1, 1, (0, 0, 0.8), linear=np.diag([4.0, 4.0, 0.2])))
    reflectance = 0.2**2
    expected = (1.0 - reflectance) / (1.0 + reflectance)
    assert center(scene, RenderSettings(8, 8, 1024, max_bounces=24))[0] == pytest.approx(expected, abs=3e-3)


@pytest.mark.parametrize(("bounces", "seen"), [(0, False), (1, True)])
def test_light_may_scatter_once_more_than_max_bounces(bounces: int, seen: bool):
    """Through a pane one way: two scatterings, which one bounce allows."""
    scene = narrow(floor_scene(Material(0, 0, 0, specular=0.0, emission_r=1.0)))
    scene.camera = look_at((0.0, 0.0, 2.0), (0, 0, 0), 0.003)
    scene.meshes.append(box(0.5))
    scene.materials.append(Material(1, 1, 1, transmission=1.0, roughness=0.0, ior=1.5))
    scene.instances.append(place(1, 1, (0, 0, 0.8), linear=np.diag([4.0, 4.0, 0.2])))
    value = center(scene, RenderSettings(8, 8, 1024, max_bounces=bounces))[0]
    assert value == pytest.approx(0.96**2 if seen else 0.0, abs=8e-3)


def test_a_texel_lies_at_its_centre_and_is_interpolated():
    """A pixel that covers one texel of the middle sees 1/8, 6/8, 1/8 of the row."""
    values = np.random.default_rng(2).random((4, 4, 3)).astype(np.float32)
    scene = floor_scene(
        Material(0, 0, 0, specular=0.0, emission_r=1, emission_g=1, emission_b=1, emission_texture=0)
    )
    scene.images, scene.textures = [ImageArrays(values, srgb=False)], [Texture(0)]
    scene.camera = look_at((0, 0, 3), (0, 0, 0), 4.0, kind=1)
    found = picture(scene, RenderSettings(4, 4, 4096))
    kernel = np.array([1.0, 6.0, 1.0]) / 8.0
    expected = np.einsum("i,j,ijc->c", kernel, kernel, values[0:3, 1:4].astype(float))
    assert found[1, 2] == pytest.approx(expected, abs=6e-3)


def test_a_byte_texture_is_made_linear():
    scene = floor_scene(
        Material(0, 0, 0, specular=0.0, emission_r=1, emission_g=1, emission_b=1, emission_texture=0)
    )
    scene.images = [ImageArrays(np.full((1, 1, 3), 188, np.uint8))]
    scene.textures = [Texture(0)]
    assert center(scene) == pytest.approx(0.5028864, rel=1e-5)


def test_depth_and_normal_are_those_of_the_plane():
    film = render_reference(floor_scene(WHITE), SETTINGS)
    assert film.depth == pytest.approx(3.0, abs=1e-9)
    assert film.mean(film.normals) == pytest.approx(np.broadcast_to([0.0, 0.0, 1.0], (8, 8, 3)), abs=1e-9)


def test_a_ray_past_everything_has_the_far_depth_and_no_coverage():
    scene = floor_scene(WHITE)
    scene.camera = look_at((0, 0, 3), (0, 0, 6), 0.2)
    film = render_reference(scene, SETTINGS)
    assert (film.depth == 1e10).all()
    assert not film.coverage.any()
    assert not film.normals.any()


def test_clipped_surfaces_are_not_seen():
    scene = floor_scene(WHITE, world=(1.0, 1.0, 1.0))
    scene.camera.clip_end = 2.9
    assert not render_reference(scene, SETTINGS).coverage.any()
    scene.camera.clip_end, scene.camera.clip_start = 100.0, 3.1
    assert not render_reference(scene, SETTINGS).coverage.any()


def test_equal_seeds_give_equal_pictures_and_other_seeds_other_ones():
    scene = floor_scene(
        WHITE,
        light(
            "area_rectangle", (1, 1, 1), (0, 0, 1), direction=(0, 0, -1), axis_u=(1, 0, 0), axis_v=(0, 1, 0)
        ),
    )
    first, again = picture(scene), picture(scene)
    other = picture(scene, RenderSettings(8, 8, samples=256, max_bounces=4, seed=1))
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)

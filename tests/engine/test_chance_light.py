"""Light that only chance meets, and what makes an error unreliable."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from trg_blender.engine import session
from trg_blender.engine.chance_light import brightest_chance_light, error_in_hits, radiance_of, sharp_share
from trg_blender.engine.devices import find_device
from trg_blender.engine.image_error import Evidence
from trg_blender.engine.scene_arrays import Environment, ImageArrays, Light, Material, RenderSettings, Texture

from .agreement_scenes import GREY, KEY, LIGHTS, MATERIALS, studio
from .arrays import floor_scene, light

SETTINGS = RenderSettings(32, 24, samples=8, max_bounces=8)
LAMP = light("point", (4.0, 4.0, 4.0), (0.6, -0.8, 1.8), radius=0.12)
EMPTY = studio(GREY, LAMP)
SOUND = Evidence(lit=1.0, unseen=0.0, lonely=0.1, lonely_error=0.3, error_pixels=50.0)


@pytest.mark.parametrize("name", ["mirror", "glass", "coat_polished"])
def test_polished_materials_are_sharp(name: str) -> None:
    assert sharp_share(MATERIALS[name], EMPTY) > 0.02


@pytest.mark.parametrize("name", ["diffuse", "plastic", "metal", "glass_rough", "clay", "sheen"])
def test_rough_materials_are_not_sharp(name: str) -> None:
    assert sharp_share(MATERIALS[name], EMPTY) == 0.0


def test_a_polished_plastic_counts_by_what_it_reflects() -> None:
    assert sharp_share(Material(roughness=0.0, ior=1.5), EMPTY) == pytest.approx(0.04)


def test_of_a_roughness_picture_the_sharp_texels_count() -> None:
    scene = studio(Material(metallic=1.0, roughness_texture=0), LAMP)
    pixels = np.array([[[0.1], [0.1], [0.3], [0.9]]], np.float32)
    scene.images, scene.textures = [ImageArrays(pixels, srgb=False)], [Texture(0)]
    assert sharp_share(scene.materials[1], scene) == pytest.approx(0.5)
    scene.textures = [Texture(-1, program=0)]
    assert sharp_share(scene.materials[1], scene) == 1.0


@pytest.mark.parametrize("name", ["sun", "point", "spot", "point_falloff", "spot_falloff"])
def test_lights_without_extent_are_never_met(name: str) -> None:
    assert radiance_of(LIGHTS[name]) == (0.0, 0.0, 0.0)


def test_radiance_times_what_is_seen_of_a_light_is_what_it_sends() -> None:
    assert radiance_of(LAMP)[0] == pytest.approx(4.0 / (math.pi * 0.12**2))
    sun: Light = LIGHTS["sun_with_angle"]
    assert radiance_of(sun)[0] * math.pi * math.sin(sun.angle) ** 2 == pytest.approx(sun.color_r)
    assert radiance_of(KEY) == (9.0, 8.0, 7.0)
    assert radiance_of(replace(KEY, spread=1.0))[0] > 9.0


def test_scenes_without_sharp_surfaces_or_chance_have_none() -> None:
    assert brightest_chance_light(studio(GREY, LAMP), SETTINGS) == 0.0
    mirror = studio(MATERIALS["mirror"], LAMP)
    assert brightest_chance_light(mirror, SETTINGS) == pytest.approx(4.0 / (math.pi * 0.12**2))
    assert brightest_chance_light(mirror, replace(SETTINGS, integrator="classic")) == 0.0
    assert brightest_chance_light(mirror, replace(SETTINGS, max_bounces=0)) == 0.0


def test_the_brightest_spot_of_an_environment_counts() -> None:
    pixels = np.ones((2, 4, 3), np.float32)
    pixels[1, 2] = 50.0
    scene = replace(studio(MATERIALS["mirror"], LIGHTS["point"]), environment=Environment(pixels))
    assert brightest_chance_light(scene, SETTINGS) == pytest.approx(50.0)


def test_one_hit_is_one_hit() -> None:
    scene = studio(MATERIALS["mirror"], LAMP)
    one_hit = brightest_chance_light(scene, SETTINGS) / 8 / math.sqrt(32 * 24)
    assert error_in_hits(scene, SETTINGS, one_hit, 8.0) == pytest.approx(1.0)
    part = replace(SETTINGS, border=(0, 0, 16, 24))
    assert error_in_hits(scene, part, one_hit, 8.0) == pytest.approx(0.5)


def test_evidence_names_its_doubt() -> None:
    assert SOUND.is_enough
    assert SOUND.doubt is None
    assert "hits" in str(replace(SOUND, chance_hits=3.0).doubt)
    assert replace(SOUND, chance_hits=30.0).is_enough
    assert "in 1 of the pixels" in str(replace(SOUND, error_pixels=1.2).doubt)
    assert "one replicate alone" in str(replace(SOUND, lonely_error=0.95).doubt)


def test_a_caustic_that_few_samples_meet_is_not_reliable_and_its_twin_of_clay_is() -> None:
    if find_device("cpu").reason is not None:
        pytest.skip("no native core")
    for seed in range(6):
        settings = replace(SETTINGS, seed=seed)
        caustic = session.render(studio(MATERIALS["mirror"], LAMP), settings).report["error"]
        assert not caustic["reliable"]
        assert caustic["note"].startswith("not reliable")
        assert session.render(studio(MATERIALS["clay"], LAMP), settings).report["error"]["reliable"]


def test_the_more_samples_the_more_hits_an_error_is_worth() -> None:
    if find_device("cpu").reason is not None:
        pytest.skip("no native core")
    scene = floor_scene(MATERIALS["mirror"], KEY)
    scene.materials.append(GREY)
    few = error_in_hits(scene, SETTINGS, 0.1, 8.0)
    many = error_in_hits(scene, SETTINGS, 0.1 / math.sqrt(16.0), 128.0)
    assert few is not None
    assert many == pytest.approx(16.0 * few)

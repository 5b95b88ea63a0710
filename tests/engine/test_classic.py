"""The classic integrator: against closed forms, and the native one against the reference."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from trg_blender.engine.classic_arrays import ClassicMaterial, classic_row, derive_classic
from trg_blender.engine.devices import find_device
from trg_blender.engine.scene_arrays import ImageArrays, Material, SceneArrays, Texture
from trg_blender.engine.session import SceneError, render

from .arrays import ball, box, light, look_at, place, quad
from .classic_scenes import BLACK, SETTINGS, layers, studio

pytest.importorskip("trg_native", reason="the native core is not built here")
needs_embree = pytest.mark.skipif(find_device("embree").reason is not None, reason="embreex is not there")

NOTHING = classic_row(diffuse=BLACK)


def color(scene: SceneArrays, **settings) -> np.ndarray:
    """The picture's colour where all its pixels are alike."""
    pixels = render(scene, replace(SETTINGS, **settings)).pixels[..., :3]
    assert np.ptp(pixels, axis=(0, 1)).max() <= 2e-5 * pixels.max()
    return pixels.mean(axis=(0, 1))


@needs_embree
@pytest.mark.parametrize("aa", ["none", "supersampling", "mfaa"])
def test_native_and_reference_draw_the_same_picture(aa: str):
    settings = replace(SETTINGS, width=32, height=32, aa=aa, aa_side=2, frame=3)
    native, reference = (render(studio(), replace(settings, device=name)) for name in ("cpu", "embree"))
    off = np.abs(native.pixels - reference.pixels).max(axis=-1)
    # A ray that touches an edge may fall on either side of it in single precision.
    assert (off > 1e-4).mean() < 0.004
    assert native.report["rays"]["bounce"] == pytest.approx(reference.report["rays"]["bounce"], rel=0.01)
    assert native.report["samples"] == {"none": 1, "supersampling": 4, "mfaa": 2}[aa]


@needs_embree
def test_native_and_reference_follow_a_tree_of_rays_alike():
    bubbles = [place(0, 0, (x, y, 0)) for x in (-1, 0, 1) for y in (-1, 0, 1)]
    half = classic_row(diffuse=(0.2, 0.1, 0.1), reflect=(0.7, 0.6, 0.7), refract=(0.6, 0.7, 0.6), ior=1.1)
    scene = SceneArrays(
        look_at((0, -5, 1), (0, 0, 0), 0.3),
        [ball(0.45, 8)],
        bubbles,
        [Material()],
        classic=[half],
        lights=[light("sun", (3, 3, 3), direction=(0.3, -0.5, 1))],
        world=(0.3, 0.5, 0.7),
    )
    settings = replace(SETTINGS, width=16, height=16, max_bounces=9, samples=1)
    native, reference = (render(scene, replace(settings, device=name)) for name in ("cpu", "embree"))
    assert native.report["rays"]["bounce"] > 20 * native.report["rays"]["camera"]
    off = np.abs(native.pixels - reference.pixels).max(axis=-1)
    assert np.median(off) < 2e-5
    assert native.pixels.mean() == pytest.approx(reference.pixels.mean(), rel=5e-3)


def test_a_mirror_shows_its_share_of_what_it_faces():
    mirror = classic_row(diffuse=BLACK, reflect=(0.5, 0.25, 0.125))
    scene = layers([mirror])
    scene.world = (0.8, 0.8, 0.8)
    assert color(scene) == pytest.approx([0.4, 0.2, 0.1], rel=1e-6)
    assert color(scene, max_bounces=0) == pytest.approx([0.0, 0.0, 0.0])


def test_two_mirrors_reflect_into_each_other_as_deep_as_asked():
    mirror = classic_row(diffuse=BLACK, reflect=(1.0, 1.0, 1.0))
    scene = layers([mirror, mirror], eye=(0.0, 0.0, 0.5))
    scene.materials[0].emission_r = 1.0
    # Between the two: the camera and every second bounce meet the lower one.
    assert color(scene, max_bounces=100)[0] == pytest.approx(51.0)


@pytest.mark.parametrize("sheets", [1, 2, 3])
def test_a_coloured_shadow_has_the_tint_of_what_stands_in_the_light(sheets: int):
    glass = classic_row(diffuse=BLACK, refract=(0.9, 0.5, 0.25))
    floor = classic_row(diffuse=(0.6, 0.6, 0.6))
    scene = layers([floor, *[glass] * sheets], eye=(0.0, 0.0, 0.5))
    scene.lights = [light("sun", (np.pi, np.pi, np.pi), direction=(0, 0, 1))]
    assert color(scene) == pytest.approx(0.6 * np.array([0.9, 0.5, 0.25]) ** sheets, rel=1e-5)


def test_an_opaque_thing_casts_a_black_shadow():
    floor, lid = classic_row(diffuse=(0.6, 0.6, 0.6)), classic_row(diffuse=(1.0, 1.0, 1.0))
    scene = layers([floor, lid], eye=(0.0, 0.0, 0.5))
    scene.lights = [light("sun", (3, 3, 3), direction=(0, 0, 1))]
    assert color(scene).max() == 0.0


@pytest.mark.parametrize(("share", "kept"), [(1.01 / 256.0, True), (0.99 / 256.0, False)])
def test_a_ray_below_a_256th_is_not_followed(share: float, kept: bool):
    scene = layers([classic_row(diffuse=BLACK, reflect=(share, 0.0, 0.0))])
    scene.world = (1.0, 1.0, 1.0)
    result = render(scene, SETTINGS)
    assert result.pixels[..., 0] == pytest.approx(share if kept else 0.0, rel=1e-5)
    assert result.report["numerics"]["cut_rays"] == (0 if kept else 64)


def test_refraction_follows_snell():
    ramp = np.repeat(np.linspace(0.0, 1.0, 1001, dtype=np.float32)[None, :, None], 3, axis=2)
    glass = classic_row(diffuse=BLACK, refract=(1.0, 1.0, 1.0), ior=1.5)
    scene = SceneArrays(
        look_at((-2, 0, 3), (0, 0, 1), 1e-6),
        [quad(4.0), quad(4.0)],
        [place(0, 0), place(1, 1, (0, 0, 1))],
        [Material(0, 0, 0, emission_r=1.0, emission_g=1.0, emission_b=1.0, emission_texture=0), Material()],
        classic=[NOTHING, glass],
        images=[ImageArrays(ramp, False)],
        textures=[Texture(0, wrap=1)],
    )
    sine = np.sqrt(0.5) / 1.5
    x = sine / np.sqrt(1.0 - sine * sine)
    found = 8.0 * (color(scene)[0] * 1000.0 + 0.5) / 1001.0 - 4.0
    assert found == pytest.approx(x, abs=1e-3)


def test_beyond_the_critical_angle_all_is_mirrored():
    glass = classic_row(diffuse=BLACK, refract=(1.0, 1.0, 1.0), ior=1.5)
    scene = layers([NOTHING, glass], emission=0.7, eye=(-3.0, 0.0, 0.5))
    scene.camera = look_at((-1.0, 0.0, 0.5), (0.0, 0.0, 1.0), 1e-4)
    scene.world = (9.0, 9.0, 9.0)
    assert color(scene) == pytest.approx([0.7] * 3)


def test_a_medium_swallows_light_by_its_length():
    glass = classic_row(diffuse=BLACK, refract=(1.0, 1.0, 1.0), decay=0.8)
    scene = layers([NOTHING, glass], emission=1.0)
    assert color(scene) == pytest.approx([np.exp(-0.8)] * 3, rel=1e-5)


@pytest.mark.parametrize("falloff", [(1.0, 0.5, 0.25), (0.1, 0.0, 0.0)])
def test_a_light_falls_off_by_the_papers_law(falloff: tuple[float, float, float]):
    scene = layers([classic_row(diffuse=(0.5, 0.5, 0.5))])
    scene.lights = [light("point", (np.pi, np.pi, np.pi), (0, 0, 2), falloff=falloff)]
    law = min(1.0, 1.0 / (falloff[0] + 2.0 * falloff[1] + 4.0 * falloff[2]))
    assert color(scene) == pytest.approx([0.5 * law] * 3, rel=1e-4)


def test_gloss_is_phongs_power_of_the_mirrored_view():
    shiny = classic_row(diffuse=BLACK, specular=(0.3, 0.3, 0.3), power=10.0)
    scene = layers([shiny])
    angle = np.radians(25.0)
    scene.lights = [light("sun", (np.pi,) * 3, direction=(np.sin(angle), 0, np.cos(angle)))]
    assert color(scene) == pytest.approx([0.3 * np.cos(angle) ** 10] * 3, rel=1e-3)


def test_ambient_light_meets_ambient_constants():
    scene = layers([classic_row(ambient=(0.5, 0.25, 1.0), diffuse=BLACK)])
    scene.ambient = (0.2, 0.4, 0.1)
    assert color(scene) == pytest.approx([0.1, 0.1, 0.1])


def test_without_randomness_no_error_is_claimed():
    report = render(studio(), SETTINGS).report
    assert report["error"]["rmse"] is None
    assert not report["error"]["reliable"]
    assert report["error"]["note"] == "no randomness: the error of aliasing is not estimated"
    assert (report["integrator"], report["aa"], report["kernel_set"]) == ("classic", "none", "classic")


def test_threads_do_not_change_a_bit():
    one, two = (
        render(studio(), replace(SETTINGS, width=40, height=40, aa="jittering", samples=16, threads=threads))
        for threads in (1, 2)
    )
    assert np.array_equal(one.pixels, two.pixels)


@pytest.mark.parametrize(
    ("material", "wanted"),
    [
        (Material(0.2, 0.4, 0.6, specular=0.0), {"diffuse_g": 0.4, "reflect_g": 0.0, "refract_g": 0.0}),
        (Material(0.2, 0.4, 0.6, metallic=1.0, roughness=0.0), {"diffuse_g": 0.0, "reflect_g": 0.4}),
        (Material(0.2, 0.25, 0.6, transmission=1.0, roughness=0.0), {"refract_g": 0.5, "ior": 1.5}),
        (
            Material(0.2, 0.4, 0.6, metallic=1.0, roughness=0.5),
            {"reflect_g": 0.0, "specular_g": 0.4, "power": 30.0},
        ),
    ],
)
def test_a_material_without_a_row_gets_the_nearest_one(material: Material, wanted: dict[str, float]):
    row = derive_classic(material)
    assert {name: getattr(row, name) for name in wanted} == pytest.approx(wanted)


def test_bad_rows_are_refused_by_name():
    scene = layers([ClassicMaterial(power=-1.0)])
    with pytest.raises(SceneError, match="row 0 has power"):
        render(scene, SETTINGS)


def slab_view(rows: list[ClassicMaterial], materials: list[Material]) -> SceneArrays:
    """Straight down through closed boxes of `rows` about the z axis, each within the one before, at a floor
    of radiance 1."""
    floor = Material(emission_r=1.0, emission_g=1.0, emission_b=1.0)
    return SceneArrays(
        look_at((0.0, 0.0, 8.0), (0, 0, 0), 1e-6),
        [quad(50.0), box(1.0)],
        [place(0, 0, (0, 0, -5))]
        + [place(1, k + 1, linear=np.eye(3) * 0.5**k) for k in range(len(rows))],
        [floor, *materials],
        classic=[classic_row(diffuse=BLACK), *rows],
    )


@needs_embree
@pytest.mark.parametrize("device", ["cpu", "embree"])
def test_the_innermost_medium_absorbs_and_the_outer_one_again_behind_it(device: str):
    """A box of half side 1 around one of half side 1/2: 1 of the way outside of the inner, 1 in it."""
    outer, inner = (
        classic_row(diffuse=BLACK, refract=(1.0, 1.0, 1.0), ior=ior, decay=decay)
        for ior, decay in ((1.3, 0.2), (1.6, 0.7))
    )
    scene = slab_view([outer, inner], [Material(), Material()])
    assert color(scene, device=device) == pytest.approx(np.exp(-0.2 - 0.7), rel=1e-5)


@needs_embree
@pytest.mark.parametrize("device", ["cpu", "embree"])
def test_a_medium_of_higher_priority_hides_what_lies_in_it(device: str):
    outer, inner = (
        classic_row(diffuse=BLACK, refract=(1.0, 0.5, 0.5), decay=decay) for decay in (0.2, 0.7)
    )
    scene = slab_view([outer, inner], [Material(priority=2.0), Material(priority=1.0)])
    expected = np.exp(-0.4) * np.array([1.0, 0.25, 0.25])
    assert color(scene, device=device) == pytest.approx(expected, rel=1e-5)


@needs_embree
def test_rays_bend_by_the_ratio_of_the_media_they_go_between():
    """Balls within balls, of indices and decays of their own."""
    rows = [
        classic_row(diffuse=(0.1,) * 3, refract=(0.9, 0.8, 0.9), reflect=(0.1,) * 3, ior=ior, decay=decay)
        for ior, decay in ((1.5, 0.1), (1.2, 0.4), (1.33, 0.2))
    ]
    scene = slab_view(rows, [Material() for _ in rows])
    scene.meshes[1] = ball(1.0, 24)
    scene.camera = look_at((2.0, -3.0, 2.0), (0, 0, 0), 0.3)
    scene.lights = [light("sun", (2, 2, 2), direction=(0.5, -0.3, 1))]
    settings = replace(SETTINGS, width=24, height=24, max_bounces=9)
    native, reference = (render(scene, replace(settings, device=name)) for name in ("cpu", "embree"))
    off = np.abs(native.pixels - reference.pixels).max(axis=-1)
    assert (off > 1e-3).mean() < 0.02

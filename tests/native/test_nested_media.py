"""Media with priorities: a liquid in its glass, whichever way the two are modelled (rows S07, S08)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from trg_blender.engine.scene_arrays import Light, Material
from trg_blender.stability import leaving_rows

from .render_scenes import GLOW, POINT, Camera, Settings, add_object, make_floor, new_scene, picture

GLASS = Material(1.0, 1.0, 1.0, transmission=1.0, roughness=0.0, ior=1.5)
WATER = replace(GLASS, ior=1.33)
STRONG_GLASS, WEAK_WATER = replace(GLASS, priority=2.0), replace(WATER, priority=1.0)


def box(half: float, low: float, high: float, turned: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """The catalogue's box as vertices and triangles."""
    mesh = leaving_rows.box(half, low, high, turned)
    return mesh.vertices, mesh.triangles


def lit_from_within(materials: list[Material], overlap: float, glass_first: bool, turned: bool) -> float:
    """Light of a glowing floor in water that comes through a slab of glass on top, at z from 0 to 1."""
    scene = new_scene([*materials, GLOW])
    parts = [(box(1e3, 0.0, 1.0), 0), (box(1e3, -2.0, overlap, turned), 1)]
    for mesh, material in parts if glass_first else parts[::-1]:
        add_object(scene, mesh, material)
    add_object(scene, make_floor(900.0, -1.0), 2)
    settings = Settings(24, 24, samples=256, bounces=32, threads=0)
    return float(picture(scene, settings, Camera(half_width=0.5))[..., :3].mean())


@pytest.mark.parametrize("turned", [False, True], ids=["same diagonals", "other diagonals"])
@pytest.mark.parametrize("glass_first", [True, False], ids=["glass first", "water first"])
@pytest.mark.parametrize("overlap", [0.0, 1e-5, 1e-3, 0.1])
def test_s07_s08_light_crosses_from_water_into_glass_at_one_boundary(
    overlap: float, glass_first: bool, turned: bool
):
    found = lit_from_within([STRONG_GLASS, WEAK_WATER], overlap, glass_first, turned)
    assert found == pytest.approx(0.9567, abs=1e-3)


@pytest.mark.parametrize("gap", [1e-4, 1e-2])
def test_s08_a_gap_is_a_film_of_air(gap: float):
    found = lit_from_within([STRONG_GLASS, WEAK_WATER], -gap, True, False)
    assert found == pytest.approx(leaving_rows.through_slabs([1.5, 1.5, 1.33]), abs=2e-3)


@pytest.mark.parametrize("overlap", [1e-5, 0.1])
def test_s08_without_priorities_both_boundaries_are_those_to_air(overlap: float):
    found = lit_from_within([GLASS, WATER], overlap, True, False)
    assert found == pytest.approx(leaving_rows.through_slabs([1.5, 1.5, 1.33]), abs=2e-3)


@pytest.mark.parametrize("roughness", [0.0, 0.3])
def test_equal_media_that_overlap_are_one_body(roughness: float):
    """Two halves of a ball that absorbs, overlapping, against the whole."""
    one = replace(GLASS, roughness=roughness, absorption_r=1.0, absorption_g=0.2, priority=1.0)
    means = []
    for parts in ([(-1.0, 1.0)], [(-1.0, 0.2), (-0.2, 1.0)], [(-1.0, 0.0), (0.0, 1.0)]):
        scene = new_scene([one], world=1.0)
        for low, high in parts:
            add_object(scene, box(0.5, low, high))
        settings = Settings(32, 32, samples=256, bounces=32, threads=0)
        means.append(picture(scene, settings, Camera(half_width=0.7))[..., :3].mean(axis=(0, 1)))
    assert means[1] == pytest.approx(means[0], abs=4e-3)
    assert means[2] == pytest.approx(means[0], abs=4e-3)


def test_the_stronger_medium_absorbs_alone_where_two_overlap():
    """A sheet of strong glass within weak dark water: no interface differs, only absorption does."""
    same = replace(GLASS, ior=1.0)
    water = replace(same, absorption_r=0.5, absorption_g=0.5, absorption_b=0.5, priority=1.0)
    clear = replace(same, priority=2.0)
    scene = new_scene([water, clear], world=1.0)
    add_object(scene, box(50.0, -1.0, 1.0), 0)
    add_object(scene, box(50.0, -0.4, 0.4), 1)
    found = picture(scene, Settings(8, 8, samples=4096, bounces=16), Camera(half_width=0.01))[..., :3].mean()
    assert found == pytest.approx(np.exp(-0.5 * 1.2), rel=3e-3)


def test_boundaries_that_are_not_there_cast_no_shadow():
    """A lamp and a floor in strong water; a weak box between them is not there."""
    water = replace(GLASS, ior=1.0, priority=2.0)
    weak = replace(GLASS, ior=1.5, priority=1.0)
    pictures = []
    for boxed in (False, True):
        lamp = Light(POINT, 5.0, 5.0, 5.0, position_z=2.0)
        scene = new_scene([water, weak, Material(0.5, 0.5, 0.5, specular=0.0)], lights=[lamp])
        add_object(scene, box(50.0, -1.0, 10.0), 0)
        add_object(scene, make_floor(10.0, 0.0), 2)
        if boxed:
            add_object(scene, box(1.0, 0.5, 1.5), 1)
        settings = Settings(16, 16, samples=64, bounces=0)
        camera = Camera(eye=(0, 0, 5), half_width=0.1, kind=0)
        pictures.append(picture(scene, settings, camera))
    assert pictures[0][..., :3].mean() > 0.1
    assert np.allclose(pictures[0], pictures[1], atol=1e-5)

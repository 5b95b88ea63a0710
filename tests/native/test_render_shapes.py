"""Spheres and planes under light: no acne, the right emission, and what their meshes would give."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from trg_blender.engine.scene_arrays import Light, Material

from .render_scenes import (
    GLOW,
    GREY,
    SUN,
    WHITE,
    Camera,
    Settings,
    add_object,
    make_sphere,
    new_scene,
    picture,
    place,
)


def add_shape(scene: Any, shape: str, material: int = 0, transform: Any = None) -> None:
    mesh = scene.add_sphere() if shape == "sphere" else scene.add_plane()
    scene.add_instance(mesh, transform, np.array([material], np.int32))


@pytest.mark.parametrize("scale", [1e-6, 1e-3, 1.0, 1e3, 1e6])
@pytest.mark.parametrize("offset", [0.0, 100.0])
def test_s01_s02_a_white_sphere_in_a_white_world_is_not_seen(scale: float, offset: float):
    scene = new_scene([WHITE], world=1.0)
    x = offset * scale
    add_shape(scene, "sphere", transform=place(x, x, x, scale))
    camera = Camera(eye=(x, x, x + 3 * scale), half_width=1.2 * scale)
    pixels = picture(scene, Settings(samples=16, bounces=0), camera)[..., :3]
    assert np.abs(pixels - 1).max() < 1e-5


def test_a_white_sphere_shadows_nothing_of_itself_when_seen_from_afar():
    scene = new_scene([WHITE], world=1.0)
    add_shape(scene, "sphere")
    camera = Camera(eye=(0, 0, 1e4), half_width=1.2e-4, kind=0)
    assert np.abs(picture(scene, Settings(samples=16, bounces=0), camera)[..., :3] - 1).max() < 1e-5


def test_glass_spheres_keep_the_light_of_the_world():
    glass = Material(1.0, 1.0, 1.0, roughness=0.0, transmission=1.0, ior=1.5)
    scene = new_scene([glass], world=1.0)
    add_shape(scene, "sphere")
    pixels = picture(scene, Settings(samples=64, bounces=64), Camera(half_width=0.9))[..., :3]
    assert pixels.mean() == pytest.approx(1.0, abs=2e-3)


STRETCH = np.array([[0.6, 0.1, 0, 0.2], [0, 0.25, 0, 0.1], [0, 0.1, 0.4, 1.0]], np.float32)


@pytest.mark.parametrize("transform", [place(0, 0, 1, 0.4), STRETCH])
def test_a_glowing_sphere_lights_a_floor_as_its_mesh_does(transform: np.ndarray):
    settings = Settings(width=16, height=16, samples=2048, bounces=0)
    camera = Camera(eye=(0, 0, 0.05), half_width=2.0)
    means = []
    for analytic in (True, False):
        scene = new_scene([GREY, GLOW])
        add_shape(scene, "plane")
        if analytic:
            add_shape(scene, "sphere", 1, transform)
        else:
            add_object(scene, make_sphere(96), 1, transform)
        means.append(picture(scene, settings, camera)[..., 0].astype(float))
    assert means[0].mean() == pytest.approx(means[1].mean(), rel=5e-3)
    assert np.abs(means[0] - means[1]).max() < 0.1 * means[1].max()


def test_light_sampling_of_a_sphere_agrees_with_chance():
    """pi L (r / d)^2 straight below a sphere, by light samples; and by bounces alone in a big one."""
    scene = new_scene([GREY, GLOW])
    add_shape(scene, "plane")
    add_shape(scene, "sphere", 1, place(0, 0, 2, 0.5))
    settings = Settings(width=4, height=4, samples=4096, bounces=0)
    below = picture(scene, settings, Camera(eye=(0, 0, 0.1), half_width=0.01))[..., 0]
    assert below.mean() == pytest.approx(0.5 * (0.5 / 2) ** 2, rel=5e-3)


def test_a_glowing_plane_is_found_by_bounces():
    scene = new_scene([GREY, GLOW])
    add_object(scene, make_sphere(32))
    add_shape(scene, "plane", 1, place(0, 0, -5))
    camera = Camera(eye=(0, 0, -3), axes=np.diag([1.0, -1.0, -1.0]), half_width=0.05)
    pixels = picture(scene, Settings(width=8, height=8, samples=512, bounces=0), camera)[..., 0]
    assert pixels.mean() == pytest.approx(0.5, rel=1e-2)


def test_a_plane_meets_the_sky_at_the_horizon():
    """A perspective camera 1.7 above the plane, level: the lower half is lit plane, the upper sky."""
    sun = Light(kind=SUN, color_r=np.pi, color_g=np.pi, color_b=np.pi, direction_z=1.0)
    scene = new_scene([GREY], world=0.0, lights=[sun])
    add_shape(scene, "plane")
    axes = np.array([[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    camera = Camera(eye=(0, 0, 1.7), axes=axes, half_width=0.01, kind=0)
    pixels = picture(scene, Settings(width=64, height=64, samples=8, bounces=0), camera)[..., 0]
    assert np.allclose(pixels[:32], 0.5, rtol=1e-3)
    assert (pixels[32:] == 0).all()

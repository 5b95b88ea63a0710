"""The equirectangular world of the native renderer against quadrature."""

from __future__ import annotations

import numpy as np
import pytest

from .render_scenes import GREY, WHITE, Camera, Float32, Settings, add_object, make_floor, new_scene, picture

STILL = np.eye(3)


def quadrature(pixels: Float32) -> float:
    """Irradiance of the first channel on a floor facing +z: the interpolated picture, summed finely."""
    height, width = pixels.shape[:2]
    steps = max(2, 1024 // height)
    v = (np.arange(height * steps) + 0.5) / (height * steps)
    u = (np.arange(width * steps) + 0.5) / (width * steps)
    x, y = u * width - 0.5, np.clip(v * height - 0.5, 0, height - 1)
    column, row = np.floor(x).astype(int), np.floor(y).astype(int)
    fx, fy = (x - column)[None, :], (y - row)[:, None]
    image = pixels[..., 0].astype(np.float64)
    low = image[row][:, column % width] * (1 - fx) + image[row][:, (column + 1) % width] * fx
    above = np.minimum(row + 1, height - 1)
    high = image[above][:, column % width] * (1 - fx) + image[above][:, (column + 1) % width] * fx
    latitude = np.pi * (v - 0.5)
    weight = np.maximum(np.sin(latitude), 0) * np.cos(latitude)
    cell = np.pi / (height * steps) * 2 * np.pi / (width * steps)
    return float(((low * (1 - fy) + high * fy) * weight[:, None]).sum() * cell)


def floor_under(pixels: Float32, samples: int = 1024, **fields: object) -> Float32:
    """(8, 8) radiance of a white floor that sees nothing but the upper half of the sky."""
    scene = new_scene([WHITE])
    scene.set_environment(np.ascontiguousarray(pixels, np.float32), fields.get("rotation", STILL))
    add_object(scene, make_floor(0.01))
    settings = Settings(8, 8, samples=samples, bounces=0, seed=int(fields.get("seed", 1)))
    return picture(scene, settings, Camera(eye=(0, 0, 1), half_width=1e-3))[..., 0]


@pytest.mark.parametrize("size", [(1, 1), (1, 5), (2, 3), (9, 16), (64, 128)])
def test_a_floor_gets_the_irradiance_of_its_sky(size: tuple[int, int]) -> None:
    pixels = np.random.default_rng(1).random((*size, 3)) ** 4
    found = floor_under(pixels, 4096).mean()
    assert found == pytest.approx(quadrature(pixels) / np.pi, rel=2e-3)


def test_b12_one_texel_of_a_million_is_no_firefly() -> None:
    """Row B12: the mean within 0.1 %, and the noise that of a direct light, not of finding it by chance."""
    pixels = np.ones((512, 1024, 3), np.float32)
    pixels[400, 300] = 1e6
    values = floor_under(pixels, 256)
    expected = quadrature(pixels) / np.pi
    assert values.mean() == pytest.approx(expected, rel=1e-3)
    # Within the light's own texels radiance over density varies by half: 0.5 / sqrt(256).
    assert values.std() < 0.05 * expected


def test_a_turned_sky_lights_from_where_it_is_turned() -> None:
    pixels = np.zeros((64, 128, 3))
    pixels[:32] = 1.0
    upside_down = np.diag([1.0, -1.0, -1.0])
    assert floor_under(pixels, 4096, rotation=upside_down).mean() == pytest.approx(1.0, rel=1e-2)


def test_an_even_picture_is_the_constant_world() -> None:
    assert floor_under(np.full((4, 8, 3), 2.0), 16) == pytest.approx(2.0, rel=1e-5)


def test_the_camera_sees_the_picture_unless_told_otherwise() -> None:
    pixels = np.zeros((32, 64, 3), np.float32)
    pixels[:16] = 3.0
    for seen in (True, False):
        scene = new_scene([GREY])
        scene.set_environment(pixels, STILL, seen)
        found = picture(scene, Settings(4, 4, samples=4), Camera(kind=0, half_width=0.1))
        assert found[..., :3] == pytest.approx(3.0 if seen else 0.0)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_pixel_that_is_no_number_is_refused(value: float) -> None:
    pixels = np.ones((4, 8, 3), np.float32)
    pixels[1, 2, 0] = value
    with pytest.raises(ValueError, match="environment: row 1"):
        new_scene([GREY]).set_environment(pixels, STILL)


@pytest.mark.parametrize("scale", [1e-30, 1e-20, 1e20, 1e28])
def test_b10_the_sky_may_be_as_bright_as_floats_go(scale: float) -> None:
    pixels = np.random.default_rng(1).random((8, 16, 3))
    found = floor_under(pixels * scale, 4096).mean(dtype=np.float64)
    assert found == pytest.approx(quadrature(pixels) / np.pi * scale, rel=5e-3)


def test_negative_texels_take_light_away() -> None:
    pixels = np.random.default_rng(1).random((8, 16, 3)) - 0.1
    assert floor_under(pixels, 4096).mean() == pytest.approx(quadrature(pixels) / np.pi, rel=1e-2)

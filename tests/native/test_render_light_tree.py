"""The tree over many emitters: the same light as each alone, and less noise than a list by power."""

from __future__ import annotations

import numpy as np
import pytest

from trg_blender.engine.scene_arrays import Light

from .render_scenes import (
    GLOW,
    GREY,
    POINT,
    RECTANGLE,
    SPOT,
    Camera,
    Settings,
    add_object,
    finish,
    make_floor,
    new_scene,
    picture,
    place,
    start,
)

WIDE = Camera(eye=(0.0, 0.0, 0.05), half_width=1.0)


def lamp(kind: int, at: tuple[float, float, float], radius: float = 0.0) -> Light:
    row = Light(kind, 0.2, 0.2, 0.2, *at, radius=radius, cos_outer=0.5, cos_inner=0.8)
    row.direction_z = -1.0
    row.axis_u_x = row.axis_v_y = 0.05
    return row


def lamps(count: int, seed: int = 3) -> list[Light]:
    """Of every kind, over a field of 20 m."""
    rng = np.random.default_rng(seed)
    kinds = ((POINT, 0.0), (POINT, 0.05), (SPOT, 0.0), (RECTANGLE, 0.0))
    return [lamp(*((kinds[k % 4][0], (*rng.uniform(-10, 10, 2), rng.uniform(1.0, 2.0)), kinds[k % 4][1])))
            for k in range(count)]


def lit_floor(lights: list[Light], samples: int) -> np.ndarray:
    scene = new_scene([GREY], lights=lights)
    add_object(scene, make_floor(10.0))
    return picture(scene, Settings(16, 16, samples=samples, bounces=0), WIDE)[..., 0].astype(np.float64)


def test_a_thousand_lights_add_up_to_the_parts_that_are_listed() -> None:
    lights = lamps(1000)
    parts = sum(lit_floor(lights[k : k + 8], 128) for k in range(0, 1000, 8))
    found = lit_floor(lights, 4096)
    assert found.mean() == pytest.approx(parts.mean(), rel=3e-3)
    assert np.abs(found / parts - 1.0).max() < 0.1


def grid_noise(side: int) -> float:
    """Relative error of the middle of a floor under side x side bulbs, 2 m apart."""
    places = (np.arange(side) - 0.5 * (side - 1)) * 2.0
    scene = new_scene([GREY], lights=[lamp(POINT, (x, y, 1.0)) for x in places for y in places])
    add_object(scene, make_floor(100.0))
    Camera(eye=(0.0, 0.0, 0.05), half_width=1.0).apply(scene)
    scene.build(1)
    job = start(scene, Settings(16, 16, samples=64, bounces=0))
    finish(job)
    return float(job.error()["relmse"])


def list_noise(side: int) -> float:
    """The same for one light of 64 samples drawn evenly, at the middle, in closed form."""
    places = (np.arange(side) - 0.5 * (side - 1)) * 2.0
    x, y = np.meshgrid(places, places)
    light = (1.0 + x * x + y * y) ** -1.5
    return float((light.size * (light**2).sum() / light.sum() ** 2 - 1.0) / 64)


def test_a_thousand_lights_have_a_fraction_of_the_noise_that_a_list_has() -> None:
    assert grid_noise(32) < 0.01 * list_noise(32)
    assert grid_noise(5) < 0.01 * list_noise(5)


@pytest.mark.parametrize("size", [1e-6, 1e-2, 1e4])
def test_glowing_meshes_in_the_tree_shine_like_one_sheet(size: float) -> None:
    """A sheet cut into 24 x 24 squares against the sheet in one, which is listed."""
    pictures = []
    for count in (1, 24):
        scene = new_scene([GREY, GLOW])
        add_object(scene, make_floor(10.0 * size))
        for k in range(count * count):
            at = ((k % count + 0.5) / count * 2 - 1, (k // count + 0.5) / count * 2 - 1)
            spot = place(at[0] * size, at[1] * size, size, size / count)
            add_object(scene, make_floor(1.0), 1, spot)
        camera = Camera(eye=(0, 0, 0.5 * size), half_width=size)
        pictures.append(picture(scene, Settings(8, 8, samples=1024, bounces=0), camera)[..., 0])
    assert pictures[1].mean() == pytest.approx(pictures[0].mean(), rel=5e-3)


def test_lights_at_one_place_and_lights_without_power_are_no_trouble() -> None:
    same = [lamp(POINT, (0.0, 0.0, 1.0)) for _ in range(100)]
    dark = [Light(POINT, 0.0, 0.0, 0.0, position_z=float(k)) for k in range(50)]
    assert lit_floor(same + dark, 64).mean() == pytest.approx(100 * lit_floor(same[:1], 64).mean(), rel=1e-3)


@pytest.mark.parametrize("scale", [1e-30, 1e-18, 1e25])
def test_b10_many_lights_may_be_as_faint_or_bright_as_floats_go(scale: float) -> None:
    def scaled(factor: float) -> list[Light]:
        rows = lamps(200)
        for row in rows:
            row.color_r = row.color_g = row.color_b = 0.2 * factor
        return rows

    found = lit_floor(scaled(scale), 256).mean()
    assert found == pytest.approx(scale * lit_floor(scaled(1.0), 256).mean(), rel=1e-2)

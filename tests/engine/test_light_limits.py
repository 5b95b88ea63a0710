"""Lights at the ends of their parameters: nothing where there is none, and limits that are met."""

from __future__ import annotations

import numpy as np
import pytest

from trg_blender.engine import session
from trg_blender.engine.devices import find_device
from trg_blender.engine.errors import SceneError
from trg_blender.engine.scene_arrays import Light, Material, RenderSettings

from .arrays import floor_scene, light

SETTINGS = RenderSettings(16, 16, samples=4096, max_bounces=0)
DOWN = (0.0, 0.0, -1.0)


@pytest.fixture(autouse=True)
def native_only():
    if find_device("cpu").reason is not None:
        pytest.skip(find_device("cpu").reason)


def picture(one: Light) -> np.ndarray:
    """(h, w, 3) of a white floor under the light."""
    found = session.render(floor_scene(Material(1, 1, 1, specular=0.0), one), SETTINGS)
    assert np.isfinite(found.pixels).all()
    return found.pixels[..., :3]


def sun(angle: float) -> Light:
    return light("sun", (1, 1, 1), direction=(0.3, 0.0, 1.0), angle=angle)


def area(**fields) -> Light:
    given = {"axis_u": (0.5, 0, 0), "axis_v": (0, 0.5, 0)} | fields
    return light("area_rectangle", (1, 1, 1), (0, 0, 2), direction=DOWN, **given)


@pytest.mark.parametrize("kind", ["sun", "point", "spot", "area_rectangle", "area_ellipse"])
def test_a_light_without_strength_gives_black(kind: str):
    fields = {"direction": (0, 0, 1) if kind == "sun" else DOWN, "cos_outer": 0.5, "cos_inner": 0.7}
    fields |= {"axis_u": (0.5, 0, 0), "axis_v": (0, 0.5, 0), "radius": 0.1, "angle": 0.1}
    assert not picture(light(kind, (0, 0, 0), (0, 0, 2), **fields)).any()


@pytest.mark.parametrize("axes", [{"axis_u": (0, 0, 0)}, {"axis_u": (0, 0.5, 0)}])
def test_an_area_light_without_area_gives_black(axes: dict):
    assert not picture(area(**axes)).any()


def test_an_area_light_of_no_spread_lights_what_is_straight_below():
    """Blender's smallest spread keeps the power: the irradiance below is that of a parallel beam."""
    found = picture(area(spread=0.0))
    assert found.max() > 0.0
    wide = picture(area())
    assert found.max() > wide.max()


@pytest.mark.parametrize("kind", ["point", "spot"])
def test_a_small_sphere_is_a_point(kind: str):
    """Within 0.5 % of the light without radius."""
    fields = {"direction": DOWN, "cos_outer": 0.2, "cos_inner": 0.9}
    images = [picture(light(kind, (1, 1, 1), (0.3, 0, 1), radius=r, **fields)) for r in (0.0, 1e-4, 1e-2)]
    for image in images[1:]:
        np.testing.assert_allclose(image, images[0], rtol=5e-3)


def test_a_small_sun_is_a_direction():
    still = picture(sun(0.0))
    for angle in (1e-7, 1e-4, 1e-2):
        np.testing.assert_allclose(picture(sun(angle)), still, rtol=5e-3)


@pytest.mark.parametrize("angle", [0.3, np.pi / 2])
def test_a_sun_as_large_as_the_sky_stays_finite(angle: float):
    found = picture(sun(angle))
    assert (found >= 0.0).all() and found.max() < 10.0


@pytest.mark.parametrize("angle", [1.6, 3.0, 4.0, 100.0, -0.1, np.nan])
def test_a_sun_larger_than_half_of_all_directions_is_refused(angle: float):
    with pytest.raises(SceneError, match="angle"):
        picture(sun(angle))

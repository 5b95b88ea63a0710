"""Facts about a clear sky that the model of engine/sky_atmosphere.py must show."""

from __future__ import annotations

import numpy as np
import pytest

from trg_blender.engine.sky_atmosphere import GROUND, Atmosphere, densities, depth_out, phases, way_out
from trg_blender.engine.sky_picture import HEIGHT, SkyDescription, make_picture, sun_irradiance_of
from trg_blender.engine.sky_spectrum import WAVELENGTHS, rayleigh_coefficients, sun_irradiance

DAY = SkyDescription(np.radians(40.0))


def above(sky: SkyDescription) -> np.ndarray:
    """(3,) mean radiance over the upper half."""
    picture = make_picture(sky)
    assert np.isfinite(picture).all() and (picture >= 0.0).all()
    weights = np.cos((np.arange(HEIGHT) + 0.5) / HEIGHT * np.pi - 0.5 * np.pi)[HEIGHT // 2 :]
    return np.average(picture[HEIGHT // 2 :].mean(axis=1), axis=0, weights=weights)


def test_air_scatters_by_the_fourth_power_of_the_wave():
    blue, red = rayleigh_coefficients()[[3, 16]]
    assert blue / red == pytest.approx((WAVELENGTHS[16] / WAVELENGTHS[3]) ** 4, rel=0.05)


def test_the_sun_shines_with_nearly_the_solar_constant_into_what_the_eye_sees():
    """About 48 % of 1361 W / m^2 lie between 380 and 780 nm."""
    assert sun_irradiance().sum() * 20.0 == pytest.approx(0.48 * 1361.0, rel=0.05)


def test_phases_share_out_all_light():
    nodes, weights = np.polynomial.legendre.leggauss(64)
    assert 2.0 * np.pi * (phases(nodes) * weights[:, None]).sum(axis=0) == pytest.approx([1.0, 1.0], rel=1e-6)


def test_straight_up_lies_a_scale_height_of_air():
    depth = depth_out(Atmosphere(), np.array([GROUND]), np.array([1.0]))[0]
    assert depth[0] == pytest.approx(8000.0, rel=0.02)
    assert depth[2] == pytest.approx(15000.0, rel=0.05)
    assert way_out(np.array([GROUND]), np.array([1.0]), GROUND + 60e3)[0] == pytest.approx(60e3)


def test_densities_are_one_where_a_clear_day_is_densest():
    assert densities(Atmosphere(), np.array([0.0]))[0, :2] == pytest.approx([1.0, 1.0])
    assert densities(Atmosphere(), np.array([25e3]))[0, 2] == pytest.approx(1.0)


def test_day_is_blue_and_a_low_sun_red():
    red, _, blue = above(DAY)
    assert blue > 1.3 * red
    low = sun_irradiance_of(SkyDescription(np.radians(2.0)), 0.005)
    assert low[0] > 2.0 * low[1] > 4.0 * low[2]


def test_more_scattering_makes_more_light_and_no_air_none():
    assert (above(SkyDescription(DAY.elevation, repeated=True)) > above(DAY)).all()
    assert not above(SkyDescription(DAY.elevation, air=0.0, dust=0.0)).any()


def test_night_is_dark_and_its_sun_hidden():
    night = SkyDescription(np.radians(-12.0))
    assert above(night).max() < 1e-3 * above(DAY).min()
    assert sun_irradiance_of(night, 0.005) == (0.0, 0.0, 0.0)


def test_a_sun_in_the_horizon_is_seen_by_half():
    half = sum(sun_irradiance_of(SkyDescription(0.0), 0.02))
    whole = sum(sun_irradiance_of(SkyDescription(0.02), 0.02))
    assert 0.0 < half < 0.6 * whole


@pytest.mark.parametrize(
    "sky",
    [
        SkyDescription(np.pi / 2, 10.0, 10.0, 10.0, 60e3),
        SkyDescription(-np.pi / 2, 0.0, 10.0, 0.0, 0.0, True),
        SkyDescription(0.3, 1000.0, 1000.0, 1000.0, 100e3, True),
    ],
)
def test_the_ends_of_blenders_ranges_stay_finite(sky: SkyDescription):
    above(sky)

"""Light in a clear atmosphere around a round planet, by wavelength: scattered once (Nishita et al. 1993) and,
as an even glow of each place, all further times (Hillaire 2020).

Everything a place needs to be told is its distance from the planet's centre and the cosine of the angle
between up and a direction, so no vector appears.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .scene_arrays import Float64
from .sky_spectrum import WAVELENGTHS, ozone_coefficients, rayleigh_coefficients, sun_irradiance

GROUND = 6360e3
"""m from the centre"""
AIR_HEIGHT, DUST_HEIGHT = 8000.0, 1200.0
"""m in which air and dust thin out to 1 / e"""
DUST_SCATTERING, DUST_EXTINCTION = 2e-5, 1.11 * 2e-5
"""1 / m on the ground"""
FORWARD = 0.76
"""mean cosine of dust's scattering"""
VIEW_STEPS, LIGHT_STEPS = 32, 12


@dataclass(frozen=True, slots=True)
class Atmosphere:
    """Densities are times those of a clear day."""

    air: float = 1.0
    dust: float = 1.0
    ozone: float = 1.0
    top: float = 60e3
    """m above the ground where it ends"""
    angstrom: float = 0.0
    """how dust prefers short waves: its power of 1 / wavelength"""


@dataclass(frozen=True, slots=True)
class Glow:
    """Radiance, even in all directions, that light scattered twice and more gives each place."""

    heights: Float64
    """(h,) m above the ground"""
    cosines: Float64
    """(c,) of the sun"""
    radiance: Float64
    """(h, c, 21)"""


@dataclass(frozen=True, slots=True)
class Sky:
    """An atmosphere and where the sun stands."""

    atmosphere: Atmosphere
    sun_cosine: float
    """sine of its elevation"""
    glow: Glow | None = None
    """None where light is scattered but once, and the ground is not there"""


def densities(atmosphere: Atmosphere, height: Float64) -> Float64:
    """(..., 3) of air, dust and ozone, 1 where each is that of a clear day and densest."""
    layer = np.clip(1.0 - np.abs(height - 25e3) / 15e3, 0.0, 1.0)
    held = np.maximum(height, 0.0)
    return np.stack(
        [
            atmosphere.air * np.exp(-held / AIR_HEIGHT),
            atmosphere.dust * np.exp(-held / DUST_HEIGHT),
            atmosphere.ozone * layer,
        ],
        axis=-1,
    )


def dust_colors(atmosphere: Atmosphere) -> Float64:
    """(21,) scattering of dust, 1 where it is that of DUST_SCATTERING."""
    return (450.0 / WAVELENGTHS) ** atmosphere.angstrom


def extinction(atmosphere: Atmosphere) -> Float64:
    """(3, 21) what a metre of each at density 1 takes away."""
    dust = DUST_EXTINCTION * dust_colors(atmosphere)
    return np.stack([rayleigh_coefficients(), dust, ozone_coefficients()])


def scattering(atmosphere: Atmosphere, density: Float64) -> Float64:
    """(n, 21) what a metre scatters, any way."""
    dust = DUST_SCATTERING * dust_colors(atmosphere)
    return density[:, :1] * rayleigh_coefficients() + density[:, 1:2] * dust


def radius_along(radius: Float64 | float, cosine: Float64, along: Float64) -> Float64:
    """Distance from the centre of what lies `along` a ray."""
    return np.sqrt(np.maximum(radius**2 + along**2 + 2.0 * radius * cosine * along, 0.0))


def way_out(radius: Float64, cosine: Float64, limit: float) -> Float64:
    """Distance along `cosine` to where a sphere of radius `limit` is left."""
    beside = np.maximum(limit**2 - radius**2 * (1.0 - cosine**2), 0.0)
    return np.maximum(-radius * cosine + np.sqrt(beside), 0.0)


def meets_ground(radius: Float64, cosine: Float64) -> NDArray[np.bool_]:
    """Whether the planet lies along `cosine`."""
    meets: NDArray[np.bool_] = (cosine < 0.0) & (radius**2 * (1.0 - cosine**2) < GROUND**2)
    return meets


def way_on(atmosphere: Atmosphere, radius: Float64, cosine: Float64, grounded: bool) -> Float64:
    """Distance to the end of the atmosphere or, with `grounded`, to the ground that lies before it."""
    way = way_out(radius, cosine, GROUND + atmosphere.top)
    if not grounded:
        return way
    beside = np.maximum(GROUND**2 - radius**2 * (1.0 - cosine**2), 0.0)
    return np.where(meets_ground(radius, cosine), -radius * cosine - np.sqrt(beside), way)


def depth_out(atmosphere: Atmosphere, radius: Float64, cosine: Float64) -> Float64:
    """(..., 3) metres of each density from a place to the end of the atmosphere (Gauss-Legendre)."""
    nodes, weights = np.polynomial.legendre.leggauss(LIGHT_STEPS)
    way = way_out(radius, cosine, GROUND + atmosphere.top)
    total = np.zeros((*np.shape(way), 3))
    for node, weight in zip(nodes, weights, strict=True):
        along = 0.5 * (node + 1.0) * way
        height = radius_along(radius, cosine, along) - GROUND
        total += densities(atmosphere, height) * (0.5 * weight * way)[..., None]
    return total


def sunlight(atmosphere: Atmosphere, radius: Float64, cosine: Float64) -> Float64:
    """(..., 21) irradiance of a surface that faces the sun at `cosine`; none where the planet hides it."""
    left = np.exp(-depth_out(atmosphere, radius, cosine) @ extinction(atmosphere)) * sun_irradiance()
    return np.where(meets_ground(radius, cosine)[..., None], 0.0, left)


def phases(cosine: Float64) -> Float64:
    """(..., 2) share a steradian of light that air and dust turn by the angle of `cosine` (Rayleigh;
    Cornette and Shanks 1992)."""
    g = FORWARD
    dust = 3.0 * (1.0 - g * g) * (1.0 + cosine**2) / (2.0 + g * g) / (1.0 + g * g - 2.0 * g * cosine) ** 1.5
    return np.stack([3.0 * (1.0 + cosine**2), 0.5 * dust * 4.0], axis=-1) / (16.0 * np.pi)


def scattered_light(sky: Sky, radius: float, cosine: Float64, turn: Float64) -> Float64:
    """(n, 21) radiance along `cosine` (n,) from a place, `turn` being the cosine between view and sun."""
    atmosphere, gone = sky.atmosphere, extinction(sky.atmosphere)
    way = way_on(atmosphere, np.full_like(cosine, radius), cosine, sky.glow is not None)
    step = way / VIEW_STEPS
    behind = np.zeros((len(cosine), 3))
    phase, dust = phases(turn), DUST_SCATTERING * dust_colors(atmosphere)
    light = np.zeros((len(cosine), len(WAVELENGTHS)))
    for k in range(VIEW_STEPS):
        along = (k + 0.5) * step
        there = radius_along(radius, cosine, along)
        sun_there = (radius * sky.sun_cosine + along * turn) / there
        density = densities(atmosphere, there - GROUND)
        behind += density * step[:, None]
        air_phased = (density[:, :1] * phase[:, :1]) * rayleigh_coefficients()
        scattered = sunlight(atmosphere, there, sun_there) * (
            air_phased + density[:, 1:2] * phase[:, 1:] * dust
        )
        if sky.glow is not None:
            scattered += glow_at(sky.glow, there - GROUND, sun_there) * scattering(atmosphere, density)
        light += np.exp(-behind @ gone) * scattered * step[:, None]
    return light


GROUND_ALBEDO = 0.3
GLOW_STEPS, GLOW_DIRECTIONS = 12, (8, 3)


def build_glow(atmosphere: Atmosphere) -> Glow:
    """Of every height and sun: what is scattered twice, times the sum of the series of further times."""
    heights = atmosphere.top * np.linspace(0.02, 1.0, 8) ** 2
    # Dusk is where the sun's height matters most.
    turned = np.linspace(-1.0, 1.0, 17)
    cosines = turned * np.abs(turned)
    radius, sun = (grid.ravel() for grid in np.meshgrid(GROUND + heights, cosines, indexing="ij"))
    ups, arounds = GLOW_DIRECTIONS
    nodes, weights = np.polynomial.legendre.leggauss(ups)
    twice = np.zeros((len(radius), len(WAVELENGTHS)))
    share = np.zeros_like(twice)
    for up, weight in zip(nodes, weights, strict=True):
        for around in (np.arange(arounds) + 0.5) * np.pi / arounds:
            turn = up * sun + np.sqrt((1.0 - up**2) * (1.0 - sun**2)) * np.cos(around)
            light, reach = _along(atmosphere, radius, np.full_like(radius, up), (sun, turn))
            twice += light * (0.5 * weight / arounds)
            share += reach * (0.5 * weight / arounds)
    radiance = twice / (1.0 - np.minimum(share, 0.99))
    return Glow(heights, cosines, radiance.reshape(len(heights), len(cosines), -1))


def _along(
    atmosphere: Atmosphere, radius: Float64, cosine: Float64, suns: tuple[Float64, Float64]
) -> tuple[Float64, Float64]:
    """(n, 21) light scattered once, evenly, along rays from places, and the share of an even glow of 1 that
    scatters along them. `suns` are the cosines of the sun with up and with the ray."""
    ground = meets_ground(radius, cosine)
    way = way_on(atmosphere, radius, cosine, True)
    step, gone = way / GLOW_STEPS, extinction(atmosphere)
    behind = np.zeros((len(radius), 3))
    light = np.zeros((len(radius), len(WAVELENGTHS)))
    reach = np.zeros_like(light)
    for k in range(GLOW_STEPS):
        along = (k + 0.5) * step
        there = radius_along(radius, cosine, along)
        arriving = sunlight(atmosphere, there, (radius * suns[0] + along * suns[1]) / there)
        density = densities(atmosphere, there - GROUND)
        behind += 0.5 * density * step[:, None]
        passed = np.exp(-behind @ gone) * scattering(atmosphere, density) * step[:, None]
        behind += 0.5 * density * step[:, None]
        light += arriving * passed / (4.0 * np.pi)
        reach += passed
    facing = (radius * suns[0] + way * suns[1]) / GROUND
    bounced = np.maximum(facing, 0.0) * ground * GROUND_ALBEDO / np.pi
    arriving = sunlight(atmosphere, np.full_like(radius, GROUND + 1.0), facing)
    return light + np.exp(-behind @ gone) * arriving * bounced[:, None], reach


def glow_at(glow: Glow, height: Float64, sun_cosine: Float64) -> Float64:
    """(n, 21) linear between the places of the table."""
    x = np.interp(height, glow.heights, np.arange(len(glow.heights)))
    y = np.interp(sun_cosine, glow.cosines, np.arange(len(glow.cosines)))
    i, j = (
        np.minimum(v.astype(np.int64), n - 2) for v, n in ((x, len(glow.heights)), (y, len(glow.cosines)))
    )
    fx, fy = (x - i)[:, None], (y - j)[:, None]
    low = glow.radiance[i, j] * (1.0 - fy) + glow.radiance[i, j + 1] * fy
    high = glow.radiance[i + 1, j] * (1.0 - fy) + glow.radiance[i + 1, j + 1] * fy
    mixed: Float64 = low * (1.0 - fx) + high * fx
    return mixed

"""What the air does to light by wavelength, and how the eye sees it.

Scattering of molecules after Rayleigh with the index (Peck and Reeder 1972) and depolarisation (Bates 1984)
of air; absorption of ozone in its Chappuis band (about the cross sections of Serdyuchenko et al. 2014); the
sun as a black body; colour matching by the fit of Wyman, Sloan and Shirley 2013.
"""

from __future__ import annotations

import numpy as np

from .scene_arrays import Float64

STEP = 20.0
"""nm between wavelengths"""
WAVELENGTHS: Float64 = np.arange(380.0, 781.0, STEP)
"""(21,) nm"""
_OZONE = (
    0.0, 0.001, 0.003, 0.012, 0.036, 0.070, 0.121, 0.181, 0.289, 0.390, 0.460,
    0.510, 0.395, 0.285, 0.205, 0.135, 0.085, 0.060, 0.045, 0.028, 0.016,
)  # fmt: skip
OZONE_PEAK = 5.38e18
"""Molecules a cubic metre in the middle of a layer of 15 km (as a box) that holds 300 Dobson units."""


SUN_KELVIN, SUN_STERADIANS = 5778.0, 6.794e-5


def sun_irradiance() -> Float64:
    """(21,) W / m^2 / nm above the air, by Planck's law."""
    metres = WAVELENGTHS * 1e-9
    radiance = 1.191043e-16 / metres**5 / np.expm1(1.4387769e-2 / (metres * SUN_KELVIN))
    return radiance * SUN_STERADIANS * 1e-9


def rayleigh_coefficients() -> Float64:
    """(21,) scattering of air at sea level and 0 degrees, of which 8 km is the scale height; 1 / m."""
    molecules = 2.5469e25
    waves = (1e3 / WAVELENGTHS) ** 2  # 1 / micrometre^2
    index = 1.0 + 1e-8 * (5791817.0 / (238.0185 - waves) + 167909.0 / (57.362 - waves))
    nitrogen, oxygen = 1.034 + 3.17e-4 * waves, 1.096 + 1.385e-3 * waves + 1.448e-4 * waves**2
    king = 0.78084 * nitrogen + 0.20946 * oxygen + 0.00934 + 0.00036 * 1.15
    slowing = ((index**2 - 1.0) / (index**2 + 2.0)) ** 2
    cold = 288.15 / 273.15  # the index is that of air at 15 degrees
    return 24.0 * np.pi**3 * slowing / (molecules * (WAVELENGTHS * 1e-9) ** 4) * king * cold


def ozone_coefficients() -> Float64:
    """(21,) absorption in the middle of the layer, 1 / m."""
    return np.array(_OZONE) * 1e-24 * OZONE_PEAK


def _lobe(centre: float, left: float, right: float) -> Float64:
    scale = np.where(centre > WAVELENGTHS, left, right)
    return np.exp(-0.5 * ((WAVELENGTHS - centre) * scale) ** 2)


def to_rec709() -> Float64:
    """(21, 3) from radiances by nm to linear Rec.709, one watt of the eye's peak being one."""
    x = (
        1.056 * _lobe(599.8, 0.0264, 0.0323)
        + 0.362 * _lobe(442.0, 0.0624, 0.0374)
        - 0.065 * _lobe(501.1, 0.0490, 0.0382)
    )
    y = 0.821 * _lobe(568.8, 0.0213, 0.0247) + 0.286 * _lobe(530.9, 0.0613, 0.0322)
    z = 1.217 * _lobe(437.0, 0.0845, 0.0278) + 0.681 * _lobe(459.0, 0.0385, 0.0725)
    rec709 = np.array(
        [
            [3.2404542, -1.5371385, -0.4985314],
            [-0.9692660, 1.8760108, 0.0415560],
            [0.0556434, -0.2040259, 1.0572252],
        ]
    )
    colors: Float64 = STEP * np.stack([x, y, z], axis=1) @ rec709.T
    return colors

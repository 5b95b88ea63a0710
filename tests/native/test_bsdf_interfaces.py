"""Fresnel's law of the native core at its ends, and the reciprocity of an interface: rows B06, B08, B09."""

from __future__ import annotations

import numpy as np
import pytest

from tests.native.bsdfs import evaluate
from trg_blender.engine.scene_arrays import Material

FACETS = {"base_r": 1.0, "base_g": 1.0, "base_b": 1.0, "roughness": 0.5, "multiscatter": 0.0}


def reflectances(cosine: np.ndarray, ior: float, outside: bool) -> np.ndarray:
    """What facets of glass reflect at each cosine: their value over that of facets that reflect all."""
    wo = np.stack([np.sqrt(1.0 - cosine**2), np.zeros_like(cosine), cosine], axis=1).astype(np.float32)
    wi = wo * np.float32([-1, -1, 1])
    glass, _ = evaluate(Material(**FACETS, transmission=1.0, ior=ior), wo, wi, outside)
    metal, _ = evaluate(Material(**FACETS, metallic=1.0), wo, wi, outside)
    return glass[:, 0] / metal[:, 0]


def exact_reflectances(cosine: np.ndarray, eta: float) -> np.ndarray:
    """Unpolarised, of a dielectric, in double precision."""
    c = np.float32(cosine).astype(np.float64)
    step = (eta - 1.0) * (eta + 1.0)
    g = np.sqrt(np.maximum(step + c * c, 0.0))
    rs, rp = (c - g) / (c + g), (eta * eta * c - g) / (eta * eta * c + g)
    return np.where(step + c * c > 0.0, 0.5 * (rs * rs + rp * rp), 1.0)


@pytest.mark.parametrize("step", [1e-2, 1e-3, 1e-4, 1e-5, 1e-6])
def test_an_index_near_one_keeps_its_digits(step: float):
    """Row B08, straight on: ((ior - 1) / (ior + 1))^2."""
    ior = float(np.float32(1.0 + step))
    expected = ((ior - 1.0) / (ior + 1.0)) ** 2
    assert reflectances(np.ones(1), ior, True) == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_the_critical_angle_is_met(side: float):
    """Row B09: within 1e-4 as far as the index and the cosine are told apart in single precision."""
    eta = float(np.float32(1.0) / np.float32(1.5))
    cosine = np.sqrt(1.0 - eta * eta) * (1.0 + side * 10.0 ** -np.arange(1.0, 6.0))
    found = reflectances(cosine, 1.5, False)
    assert np.isfinite(found).all()
    assert found == pytest.approx(exact_reflectances(cosine, eta), abs=1e-4)


def test_an_interface_is_reciprocal():
    """Row B06: through it by the square of the index. Facets that graze outside meet total reflection inside,
    where the last digit of a direction decides; they are left out."""
    rng = np.random.default_rng(3)
    a, b = (rng.normal(size=(20_000, 3)) for _ in range(2))
    a[:, 2], b[:, 2] = np.abs(a[:, 2]) + 1e-2, -np.abs(b[:, 2]) - 1e-2
    a, b = ((v / np.linalg.norm(v, axis=1, keepdims=True)).astype(np.float32) for v in (a, b))
    facet = a + 1.5 * b.astype(np.float64)
    facing = np.abs((a * facet).sum(axis=1)) / np.linalg.norm(facet, axis=1)
    a, b = a[facing > 0.1], b[facing > 0.1]
    material = Material(**FACETS, transmission=1.0, ior=1.5)
    down = np.float32([1, 1, -1])
    there, _ = evaluate(material, a, b)
    back, _ = evaluate(material, b * down, a * down, False)
    assert (there[:, 0] > 0.0).sum() > 1000
    assert there / -b[:, 2:] == pytest.approx(1.5**2 * back / a[:, 2:], rel=2e-4, abs=1e-6)

"""The material mixture of the reference: its samples, densities and values belong together."""

from __future__ import annotations

import numpy as np
import pytest

from trg_blender.engine.reference_bsdf import Bsdf, build_bsdf, evaluate_bsdf, sample_bsdf
from trg_blender.engine.reference_energy import EnergyTables
from trg_blender.engine.reference_fresnel import fresnel_dielectric, fresnel_mean
from trg_blender.engine.reference_math import normalize
from trg_blender.engine.reference_points import Points
from trg_blender.engine.reference_surface import Material, Surface
from trg_blender.engine.scene_arrays import MATERIAL_FIELDS
from trg_blender.engine.scene_arrays import Material as MaterialRow

VIEWS = {"steep": (0.2, 0.1, 1.0), "flat": (0.9, -0.3, 0.35)}
MIXTURES = {
    "metal": {"metallic": 1.0, "alpha": 0.25},
    "plastic": {"alpha": 0.3},
    "glass": {"transmission": 1.0, "alpha": 0.3},
    "all": {"metallic": 0.3, "transmission": 0.4, "alpha": 0.4},
}


def make_bsdf(count: int, view, outside: bool = True, **values) -> Bsdf:
    """`count` times the same point, its shading normal tilted against the geometric one."""
    full = {"metallic": 0.0, "alpha": 0.2, "ior": 1.5, "specular": 1.0, "transmission": 0.0, **values}
    defaults = {name: np.full(count, float(getattr(MaterialRow(), name))) for name in MATERIAL_FIELDS}
    columns = {name: np.full(count, float(value)) for name, value in full.items()}
    base = np.tile([0.9, 0.6, 0.3], (count, 1))
    material = Material(
        base,
        columns["metallic"],
        columns["alpha"],
        columns["ior"],
        columns["specular"],
        columns["transmission"],
        np.zeros((count, 3)),
        defaults | columns,
        EnergyTables(),
    )
    wo = np.tile(normalize(np.array(view, float)), (count, 1))
    ng = np.tile([0.0, 0.0, 1.0], (count, 1))
    ns = np.tile(normalize(np.array([0.1, 0.05, 1.0])), (count, 1))
    place, row = np.zeros((count, 3)), np.zeros(count, dtype=np.int64)
    zero = np.zeros(count)
    points = Points(row, zero, zero, place[:, :2], place, ns, ng, wo, np.full(count, outside))
    surface = Surface(place, wo, ng, ns, np.full(count, outside), material, np.full(count, 1e-6), row, points)
    return build_bsdf(surface)


def sphere_grid(rows: int) -> np.ndarray:
    """Directions that share the sphere evenly."""
    z = (np.arange(rows) + 0.5) / rows * 2.0 - 1.0
    phi = (np.arange(2 * rows) + 0.5) / rows * np.pi
    z, phi = (part.ravel() for part in np.meshgrid(z, phi))
    flat = np.sqrt(1.0 - z * z)
    return np.stack([flat * np.cos(phi), flat * np.sin(phi), z], axis=1)


@pytest.mark.parametrize("outside", [True, False], ids=["outside", "inside"])
@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("mixture", MIXTURES)
def test_samples_weigh_what_the_integral_of_the_values_gives(mixture: str, view: str, outside: bool):
    directions = sphere_grid(400)
    grid = make_bsdf(len(directions), VIEWS[view], outside, **MIXTURES[mixture])
    value, pdf = evaluate_bsdf(grid, directions)
    solid_angle = 4.0 * np.pi / len(directions)
    sampled = sample_bsdf(
        make_bsdf(200_000, VIEWS[view], outside, **MIXTURES[mixture]), np.random.default_rng(1)
    )
    spread = sampled.weight.std(axis=0) / np.sqrt(len(sampled.weight))
    assert (
        np.abs(sampled.weight.mean(axis=0) - value.sum(axis=0) * solid_angle).max()
        < 4.0 * spread.max() + 2e-3
    )
    # The density misses only what goes below the surface and is thrown away.
    assert pdf.sum() * solid_angle < 1.003
    kept = (sampled.pdf > 0.0).mean()
    assert pdf.sum() * solid_angle == pytest.approx(kept, abs=6e-3)


SINGLE = {"metallic": 1.0, "alpha": 0.3, "multiscatter": 0.0}
"""Scaling by albedo and layers over the base look at one side only: they are not reciprocal."""


def test_single_scattering_of_metal_is_reciprocal():
    directions = normalize(np.random.default_rng(5).normal(size=(200, 3)) + [0.0, 0.0, 2.0])
    there = make_bsdf(len(directions), VIEWS["steep"], **SINGLE)
    value, _ = evaluate_bsdf(there, directions)
    cosine_i = directions @ there.surface.ns[0]
    cosine_o = there.wo[0, 2]
    for row in range(0, len(directions), 10):
        back = make_bsdf(1, directions[row], **SINGLE)
        reverse, _ = evaluate_bsdf(back, there.surface.wo[:1])
        assert reverse[0] / cosine_o == pytest.approx(value[row] / cosine_i[row], rel=1e-9)


def test_fresnel_has_its_known_values():
    eta = np.array([1.5, 1.5, 1.5, 1 / 1.5, 1.0])
    cosine = np.array([1.0, 0.0, np.cos(np.arctan(1.5)), 0.5, 0.3])
    found = fresnel_dielectric(cosine, eta)
    brewster = 0.5 * ((1 - 1.5**2) / (1 + 1.5**2)) ** 2
    assert found == pytest.approx([0.04, 1.0, brewster, 1.0, 0.0], abs=1e-12)


def test_the_mean_fresnel_of_glass_is_that_of_the_literature():
    """0.0918 from air into 1.5 (Egan and Hilgeman 1973); the other way by 1 - (1 - F) / n^2."""
    outside, inside = fresnel_mean(np.array([1.5, 1.0 / 1.5]))
    assert outside == pytest.approx(0.0918, abs=1e-4)
    assert inside == pytest.approx(1.0 - (1.0 - outside) / 1.5**2, abs=1e-5)

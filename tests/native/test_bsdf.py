"""The lobes of the native core: energy, densities, reciprocity, at the ends of their parameters."""

from __future__ import annotations

import numpy as np
import pytest

from tests.native.bsdfs import evaluate, sample, view
from trg_blender.engine.scene_arrays import Material
from trg_blender.stability.chi_square import RINGS, SECTORS, chi_square_score, expected_shares, facet_bins

WHITE = {"base_r": 1.0, "base_g": 1.0, "base_b": 1.0}
KINDS = {
    "metal": {"metallic": 1.0},
    "plastic": {},
    "plastic of a high index": {"ior": 3.0},
    "glass": {"transmission": 1.0},
    "glass from inside": {"transmission": 1.0},
    "coat": {"coat": 1.0, "coat_roughness": 0.3},
    "sheen": {"sheen_r": 1.0, "sheen_g": 1.0, "sheen_b": 1.0},
    "rough diffuse": {"specular": 0.0, "diffuse_roughness": 1.0},
    "all": {"metallic": 0.3, "transmission": 0.4, "coat": 0.5, "coat_roughness": 0.2, "sheen_g": 0.5},
}
ROUGHNESSES = (0.0, 1e-4, 1e-2, 0.1, 0.5, 1.0)
ANGLES = (0.0, 45.0, 80.0, 89.99)
COUNT = 60_000


def is_outside(kind: str) -> bool:
    return "inside" not in kind


@pytest.mark.parametrize("roughness", ROUGHNESSES)
@pytest.mark.parametrize("kind", KINDS)
def test_a_white_surface_in_white_light_is_white(kind: str, roughness: float):
    """Where nothing is absorbed energy is 1; tables of albedo are good to 1e-3."""
    for angle in ANGLES:
        material = Material(**WHITE, roughness=roughness, **KINDS[kind])
        drawn = sample(material, view(angle), 2 * COUNT, is_outside(kind))
        assert np.isfinite(drawn.weight).all() and (drawn.weight >= 0.0).all()
        weight = drawn.weight.max(axis=1) if kind == "all" else drawn.weight[:, 0]
        noise = weight.std() / np.sqrt(len(weight))
        low = 0.98 if kind == "all" else 1.0 - 1e-3
        assert low - 4.0 * noise < weight.mean() < 1.0 + 1e-3 + 4.0 * noise, (angle, weight.mean(), noise)


@pytest.mark.parametrize("roughness", ROUGHNESSES)
@pytest.mark.parametrize("ior", [0.5, 1.0, 1.0 + 1e-7, 1.0 + 1e-4, 1.5, 10.0, 100.0])
def test_white_glass_of_any_index_keeps_all_light(ior: float, roughness: float):
    """Row B04; the tables are good to 1e-3 at 89.99 degrees."""
    for angle in ANGLES:
        drawn = sample(Material(**WHITE, transmission=1.0, ior=ior, roughness=roughness), view(angle), COUNT)
        weight = drawn.weight[:, 0]
        noise = weight.std() / np.sqrt(len(weight))
        assert weight.mean() == pytest.approx(1.0, abs=1e-3 + 4.0 * noise), angle


def test_total_reflection_within_rough_glass_keeps_all_light():
    """Straight on, where a table on an even grid was 6e-3 too high."""
    material = Material(**WHITE, transmission=1.0, ior=1.5, roughness=0.83)
    weight = sample(material, view(0.0), 1_000_000, False).weight[:, 0]
    noise = weight.std() / np.sqrt(len(weight))
    assert weight.mean() == pytest.approx(1.0, abs=1e-3 + 4.0 * noise)


@pytest.mark.parametrize("roughness", ROUGHNESSES)
@pytest.mark.parametrize("kind", KINDS)
def test_samples_follow_their_density(kind: str, roughness: float):
    """Chi-square at 1e-4 over all of the cases (Bonferroni); deltas and absorbed samples are left out."""
    for angle in ANGLES:
        material = Material(**WHITE, roughness=roughness, **KINDS[kind])
        wo, outside = view(angle), is_outside(kind)
        drawn = sample(material, wo, COUNT, outside)
        kept = drawn.pdf > 0.0
        if kept.mean() < 1e-3:
            continue
        alpha = roughness**2 if roughness > 0.05 else 0.5
        eta = material.ior if outside else 1.0 / material.ior
        bins = facet_bins(wo, drawn.wi[kept], eta, alpha)
        found = np.bincount(bins, minlength=2 * RINGS * SECTORS)
        expected = expected_shares(material, wo, outside, eta, alpha) * COUNT
        assert expected.sum() == pytest.approx(kept.sum(), rel=0.01, abs=5.0 * np.sqrt(COUNT))
        # One-sided normal quantile of 1e-4 / 216.
        assert chi_square_score(found, expected) < 5.0, angle


@pytest.mark.parametrize("roughness", [0.1, 0.5, 1.0])
def test_single_scattering_is_reciprocal(roughness: float):
    """Value over cosine is the same both ways; scaling by albedo and layers are not meant to be."""
    material = Material(0.9, 0.5, 0.3, metallic=1.0, roughness=roughness, multiscatter=0.0)
    rng = np.random.default_rng(3)
    a, b = (rng.normal(size=(2000, 3)) for _ in range(2))
    a[:, 2], b[:, 2] = np.abs(a[:, 2]) + 1e-3, np.abs(b[:, 2]) + 1e-3
    a, b = ((v / np.linalg.norm(v, axis=1, keepdims=True)).astype(np.float32) for v in (a, b))
    there, _ = evaluate(material, a, b)
    back, _ = evaluate(material, b, a)
    assert there / b[:, 2:] == pytest.approx(back / a[:, 2:], rel=2e-4)

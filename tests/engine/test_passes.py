"""The passes of both renderers are the same pictures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from trg_blender.engine import session
from trg_blender.engine.cryptomatte import id_bits, metadata, murmur3
from trg_blender.engine.passes import KERNEL_PASSES, LIGHT_PASSES, PASS_NAMES
from trg_blender.engine.reference_passes import REFERENCE_PASSES
from trg_blender.engine.scene_arrays import (
    Camera,
    InstanceArrays,
    Light,
    Material,
    MeshArrays,
    PassData,
    RenderSettings,
    SceneArrays,
)

SEEDS = 6
Z_LIMIT = 4.6
"""Student's t of ten degrees of freedom that fair noise exceeds once in a thousand passes"""
ROUNDING = 1e-3
"""of a pass without noise: single precision, tables of energy, and samples of the pixel's area"""
Renders = list[session.Result]


def balls() -> SceneArrays:
    """Plastic, gold, glass and glow as exact spheres on a plane, under a ball of light and a sky."""
    materials = [
        Material(0.5, 0.6, 0.4, roughness=0.5),
        Material(0.2, 0.5, 0.8, roughness=0.3),
        Material(1.0, 0.7, 0.3, metallic=1.0, roughness=0.4),
        Material(0.9, 1.0, 0.9, transmission=1.0, roughness=0.4, ior=1.4),
        Material(0.3, 0.3, 0.3, emission_r=0.5, emission_g=0.4, emission_b=0.3),
    ]
    corners = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], np.float32)
    stand_in = np.array([(0, 1, 2), (0, 2, 3)], np.int32)
    floor = MeshArrays(corners * 1.2, stand_in)
    ball = MeshArrays(corners, stand_in, shape="sphere")
    instances = [InstanceArrays(0, np.eye(3, 4, dtype=np.float32)[None], np.array([0], np.int32))]
    for k, (x, y) in enumerate([(-0.4, -0.4), (0.4, -0.4), (-0.4, 0.4), (0.4, 0.4)]):
        matrix = np.column_stack([0.3 * np.eye(3), (x, y, 0.3)]).astype(np.float32)
        instances.append(InstanceArrays(1, matrix[None], np.array([k + 1], np.int32)))
    camera = Camera(0, np.column_stack([np.eye(3), (0.0, 0.0, 3.0)]), (-0.4, 0.4, -0.4, 0.4))
    light = Light(1, 20.0, 18.0, 15.0, position_x=0.3, position_y=0.2, position_z=2.5, radius=0.2)
    return SceneArrays(
        camera=camera,
        meshes=[floor, ball],
        instances=instances,
        materials=materials,
        lights=[light],
        world=(0.2, 0.2, 0.3),
        pass_data=PassData(mist=(2.0, 1.5, 2.0)),
    )


@pytest.fixture(scope="module")
def both() -> tuple[Renders, Renders]:
    """SEEDS renders by each renderer."""
    pytest.importorskip("embreex", reason="the reference renderer needs embreex")
    settings = RenderSettings(24, 24, samples=256, passes=tuple(REFERENCE_PASSES), max_bounces=4)
    slow = replace(settings, device="embree", samples=32)
    scene, seeds = balls(), range(SEEDS)
    return (
        [session.render(scene, replace(settings, seed=seed)) for seed in seeds],
        [session.render(scene, replace(slow, seed=seed)) for seed in seeds],
    )


@pytest.mark.parametrize("name", sorted(set(REFERENCE_PASSES) - {"sample_count"}))
def test_native_and_reference_agree_on(name: str, both: tuple[Renders, Renders]) -> None:
    ours, theirs = (
        np.array([np.mean(one.passes[name], dtype=np.float64) for one in renders]) for renders in both
    )
    assert (theirs.mean() != 0.0) == (ours.mean() != 0.0)
    error = np.sqrt((ours.var(ddof=1) + theirs.var(ddof=1)) / SEEDS)
    assert abs(ours.mean() - theirs.mean()) < Z_LIMIT * error + ROUNDING * abs(theirs.mean()) + 1e-6


def test_light_passes_add_up_to_combined(both: tuple[Renders, Renders]) -> None:
    for result in (both[0][0], both[1][0]):
        found = result.passes
        total = found["emission"] + found["environment"]
        for kind in ("diffuse", "glossy", "transmission"):
            total = total + found[f"{kind}_color"] * (found[f"{kind}_direct"] + found[f"{kind}_indirect"])
        np.testing.assert_allclose(total, result.pixels[..., :3], rtol=5e-5, atol=2e-6)


def test_the_reference_says_which_passes_it_leaves_empty() -> None:
    pytest.importorskip("embreex", reason="the reference renderer needs embreex")
    settings = RenderSettings(8, 8, samples=1, device="embree", passes=("uv", "emission"))
    result = session.render(balls(), settings)
    assert "device embree: empty passes: uv" in result.report["warnings"]
    assert not result.passes["uv"].any()


def test_every_pass_has_its_channels_and_is_finite() -> None:
    result = session.render(balls(), RenderSettings(16, 16, samples=16, passes=PASS_NAMES))
    assert set(result.passes) == set(PASS_NAMES)
    for name, pixels in result.passes.items():
        channels = {"depth": 1, "normal": 3, "standard_error": 1, "error_flags": 1, **KERNEL_PASSES}[
            name
        ] or 12
        assert pixels.shape == ((16, 16) if channels == 1 else (16, 16, channels))
        assert np.isfinite(pixels).all()
    assert result.passes["standard_error"].max() > 0.0
    assert set(LIGHT_PASSES) < set(result.passes)


def test_a_transparent_film_leaves_the_environment_out() -> None:
    scene = replace(balls(), transparent_film=True)
    result = session.render(scene, RenderSettings(16, 16, samples=4, passes=("environment",)))
    assert not result.passes["environment"].any()


def test_hashes_are_those_of_the_cryptomatte_specification() -> None:
    # Sample values of the specification's appendix and of the reference implementation of MurmurHash3.
    assert murmur3(b"") == 0
    assert murmur3(b"hello") == 0x248BFA47
    assert murmur3(b"hello, world") == 0x149BBB7F
    assert murmur3(b"The quick brown fox jumps over the lazy dog") == 0x2E4FF723
    for number in range(2000):
        assert (id_bits(f"object{number}") >> 23) & 255 not in (0, 255)


def test_metadata_names_layer_and_manifest() -> None:
    fields = metadata("ViewLayer.CryptoObject", ["Cube"])
    assert {key.rsplit("/", 1)[1] for key in fields} == {"name", "hash", "conversion", "manifest"}
    assert all(len(key.split("/")[1]) == 7 for key in fields)
    assert f'"Cube":"{id_bits("Cube"):08x}"' in "".join(fields.values())

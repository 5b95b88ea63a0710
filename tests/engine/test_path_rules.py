"""Rules that cut paths short: what they do to simple scenes, what is counted, what is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from trg_blender.engine import session
from trg_blender.engine.devices import find_device
from trg_blender.engine.errors import SceneError
from trg_blender.engine.path_rules import PathRules
from trg_blender.engine.scene_arrays import CAMERA_RAY, EVERY_RAY, Material, RenderSettings, SceneArrays

from .arrays import light, look_at, place, quad

SETTINGS = RenderSettings(8, 8, samples=8, max_bounces=2)
DEVICES = ("cpu", "embree")


def floor(*sheets: float, world=(0.0, 0.0, 0.0), alpha: float = 0.0) -> SceneArrays:
    """A diffuse floor under a sun straight above, seen from above through sheets at those heights."""
    return SceneArrays(
        look_at((0.0, -0.01, 5.0), (0, 0, 0), 0.1),
        [quad(4.0)],
        [place(0, 0), *(place(0, 1, (0, 0, height)) for height in sheets)],
        [Material(0.5, 0.5, 0.5, specular=0.0), Material(0.0, 0.0, 0.0, specular=0.0, alpha=alpha)],
        lights=[light("sun", (3.0, 3.0, 3.0), direction=(0.0, 0.0, 1.0))],
        world=world,
    )


def brightness(scene: SceneArrays, device: str, **rules: float) -> float:
    if find_device(device).reason is not None:
        pytest.skip(find_device(device).reason)
    settings = replace(SETTINGS, device=device, rules=PathRules(**rules))
    return float(session.render(scene, settings).pixels[..., :3].mean())


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("limit", [0, 1, 2])
def test_as_many_transparent_surfaces_are_passed_as_the_limit_says(device: str, limit: int):
    # The camera and the sun's shadow rays both pass all sheets above the floor.
    full = 3.0 * 0.5 / np.pi
    for sheets in range(4):
        seen = brightness(floor(*(1.0 + k for k in range(sheets))), device, transparent=limit)
        passed = sheets == 0 or 2 * sheets <= limit
        assert seen == pytest.approx(full if passed else 0.0, rel=1e-5)


@pytest.mark.parametrize("device", DEVICES)
def test_a_clamp_scales_each_contribution_to_its_mean_and_is_counted(device: str):
    if find_device(device).reason is not None:
        pytest.skip(find_device(device).reason)
    scene = floor()
    scene.lights[0].color_g = scene.lights[0].color_b = 0.0
    settings = replace(SETTINGS, device=device, rules=PathRules(clamp_direct=0.1))
    result = session.render(scene, settings)
    assert result.pixels[..., 0] == pytest.approx(0.3, rel=1e-5)
    assert result.report["numerics"]["clamped"] == 8 * 8 * 8
    assert "clamp direct: 0.1" in result.report["error"]["biases"]


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("transparent", [False, True])
def test_a_hole_is_black_and_not_covered(device: str, transparent: bool):
    if find_device(device).reason is not None:
        pytest.skip(find_device(device).reason)
    scene = floor(world=(0.2, 0.3, 0.4))
    scene.transparent_film = transparent
    scene.instances[0].holdout = True
    pixels = session.render(scene, replace(SETTINGS, device=device)).pixels
    assert np.all(pixels == 0.0)
    scene.instances[0].mask = EVERY_RAY & ~CAMERA_RAY
    pixels = session.render(scene, replace(SETTINGS, device=device)).pixels
    assert np.allclose(pixels, (0, 0, 0, 0) if transparent else (0.2, 0.3, 0.4, 1.0))


def test_rules_that_cannot_bite_leave_the_kernels_as_they_are():
    if find_device("cpu").reason is not None:
        pytest.skip(find_device("cpu").reason)
    idle = session.render(floor(), replace(SETTINGS, rules=PathRules(diffuse=2, glossy=5)))
    assert idle.report["kernel_set"] != "limited"
    assert (
        session.render(floor(), replace(SETTINGS, rules=PathRules(diffuse=1))).report["kernel_set"]
        == "limited"
    )


@pytest.mark.parametrize("rules", [PathRules(diffuse=-1), PathRules(clamp_direct=float("nan"))])
def test_rules_below_zero_are_refused(rules: PathRules):
    with pytest.raises(SceneError, match="must be 0 or more"):
        session.render(floor(), replace(SETTINGS, rules=rules))

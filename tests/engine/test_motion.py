"""Motion while a shutter is open: keys, and pictures against the mean of still ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from trg_blender.engine import session
from trg_blender.engine.devices import find_device
from trg_blender.engine.errors import SceneError
from trg_blender.engine.motion import moves, place_at, rotation, still_at, turning_keys
from trg_blender.engine.scene_arrays import Material, RenderSettings, SceneArrays

from .agreement_scenes import at, way
from .arrays import look_at, place, quad

SETTINGS = RenderSettings(24, 24, samples=1024, max_bounces=0)


def native_only() -> None:
    if find_device("cpu").reason is not None:
        pytest.skip(find_device("cpu").reason)


def glowing_square() -> SceneArrays:
    """Seen from above, of radiance 1."""
    glow = Material(0, 0, 0, emission_r=1, emission_g=1, emission_b=1, specular=0.0)
    return SceneArrays(look_at((0, 0, 4), (0, 0, 0), 0.5), [quad(0.5)], [place(0)], [glow])


def test_straight_motion_needs_no_further_keys():
    keys = turning_keys(np.stack([at((0, 0, 0)), at((1, 2, 3), 2.0)]))
    assert keys.shape == (2, 3, 4)
    np.testing.assert_array_equal(place_at(keys[None], 0.25)[0], at((0.25, 0.5, 0.75), 1.25))


@pytest.mark.parametrize("degrees", [30.0, 179.0, 180.0])
@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_what_turns_stays_on_its_circle(degrees: float, mirror: float):
    size = np.diag([2.0, 1.0, mirror])
    turned = rotation(np.array([0.0, 0.0, np.radians(degrees)])) @ size
    keys = turning_keys(np.stack([np.column_stack([each, np.zeros(3)]) for each in (size, turned)]))
    for time in (0.1, 0.37, 0.5, 0.99):
        place_then = place_at(keys[None], time)[0, :, :3]
        exact = rotation(np.array([0.0, 0.0, np.radians(degrees) * time])) @ size
        # Half a turn may go either way.
        other = rotation(np.array([0.0, 0.0, -np.radians(degrees) * time])) @ size
        errors = [np.abs(place_then - each).max() for each in (exact, other)]
        assert errors[0] < 2e-4 or (degrees == 180.0 and errors[1] < 2e-4)


@pytest.mark.parametrize("moved", ["object", "camera"])
def test_a_picture_is_the_mean_over_the_shutter(moved: str):
    """Straight there, back and beyond; the stills are 64 even times."""
    native_only()
    scene = glowing_square()
    if moved == "object":
        scene.instances[0].motion = way(at((-1, 0, 0)), at((0.5, 0, 0)), at((0, 1, 0), 2.0))
    else:
        ends = [look_at(place, (0.2, 0, 0), 0.5).matrix for place in ((-1.0, 0, 4), (0, 1.0, 3))]
        scene.camera.motion = np.stack(ends)
    assert moves(scene)
    blurred = session.render(scene, SETTINGS).pixels[..., 0]
    times = (np.arange(64) + 0.5) / 64
    stills = [session.render(still_at(scene, t), replace(SETTINGS, samples=32)).pixels[..., 0] for t in times]
    mean = np.mean(stills, axis=0)
    assert 0.05 < mean.mean() < 0.9 and np.ptp(mean) > 0.3
    assert np.abs(blurred - mean).max() < 0.05
    assert blurred.mean() == pytest.approx(mean.mean(), rel=5e-3)


def test_one_that_stands_still_all_the_time_gives_the_same_picture():
    native_only()
    scene = glowing_square()
    still = session.render(scene, SETTINGS).pixels
    scene.instances[0].motion = way(at((0, 0, 0)), at((0, 0, 0)))
    np.testing.assert_array_equal(session.render(scene, SETTINGS).pixels, still)


@pytest.mark.parametrize("bad", [np.nan, 0.0])
def test_impossible_motion_is_refused(bad: float):
    scene = glowing_square()
    scene.instances[0].motion = way(at((0, 0, 0)), bad * at((1, 0, 0)))
    with pytest.raises(SceneError, match="motion"):
        session.render(scene, SETTINGS)

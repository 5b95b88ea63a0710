"""Every light and camera gives Cycles' picture: the ratio of means lies within half a percent."""

from __future__ import annotations

import pytest

bpy = pytest.importorskip("bpy")
addon_utils = pytest.importorskip("addon_utils")

from trg_blender.engine.devices import find_device  # noqa: E402

from .cycles_scenes import CAMERAS, LIGHTS, new_scene, ratio_of_means  # noqa: E402

SAMPLES = 1024


@pytest.fixture(scope="module", autouse=True)
def cycles():
    if not find_device("cpu").available:
        pytest.skip("trg_native is not built")
    addon_utils.enable("cycles")
    yield
    addon_utils.disable("cycles")


CASES = LIGHTS | CAMERAS


@pytest.mark.parametrize("name", CASES)
def test_a_light_or_camera_gives_the_mean_that_cycles_gives(name: str):
    new_scene()
    CASES[name]()
    ratio, worst_block = ratio_of_means(SAMPLES)
    assert ratio == pytest.approx(1.0, abs=5e-3)
    assert worst_block < 0.03

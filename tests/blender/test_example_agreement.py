"""Native and reference show the same expected picture of every example, on the way that a render takes."""

from __future__ import annotations

import os
import sys
from dataclasses import replace

import pytest

pytest.importorskip("bpy", reason="examples become arrays through Blender")
from benchmarks.example_arrays import example_names, read_example, registered
from benchmarks.reference_agreement import EXAMPLE_SETTINGS, compare_devices
from trg_blender.engine.devices import find_device

STEPS = (1, 4, 16)
"""Times the samples of the first comparison: each step counts only where the one before left doubt."""


@pytest.mark.parametrize("name", example_names())
def test_native_and_reference_agree_on_the_example(name: str):
    if os.environ.get("CI") == "true" and sys.version_info < (3, 12):
        pytest.skip("compared on the newest Python alone: the core is one binary for all")
    for device in ("cpu", "embree"):
        reason = find_device(device).reason
        if reason is not None:
            pytest.skip(reason)
    with registered():
        scene = read_example(name, (EXAMPLE_SETTINGS.width, EXAMPLE_SETTINGS.height))
    # Caustics of 64 samples are far from a bell: what seems to differ must do so with more, drawn anew.
    for attempt, step in enumerate(STEPS):
        samples = step * EXAMPLE_SETTINGS.samples
        asked = replace(EXAMPLE_SETTINGS, samples=samples, seed=attempt)
        agreement, _ = compare_devices(scene, asked, step * 1024)
        if agreement.agrees:
            break
    assert agreement.agrees, str(agreement)

"""Native and reference show the same expected picture of every example, on the way that a render takes."""

from __future__ import annotations

import pytest

pytest.importorskip("bpy", reason="examples become arrays through Blender")
from benchmarks.example_arrays import example_names, read_example, registered
from benchmarks.reference_agreement import EXAMPLE_SETTINGS, compare_devices
from trg_blender.engine.devices import find_device


@pytest.mark.parametrize("name", example_names())
def test_native_and_reference_agree_on_the_example(name: str):
    for device in ("cpu", "embree"):
        reason = find_device(device).reason
        if reason is not None:
            pytest.skip(reason)
    with registered():
        scene = read_example(name, (EXAMPLE_SETTINGS.width, EXAMPLE_SETTINGS.height))
    agreement, _ = compare_devices(scene, EXAMPLE_SETTINGS, 1024)
    assert agreement.agrees, str(agreement)

"""The panel of error and time: its words, its curve, and what the render under way tells it."""

from __future__ import annotations

import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.engine.result import records  # noqa: E402
from trg_blender.ui import registration  # noqa: E402
from trg_blender.ui.error_curve import NAME, curve_icon  # noqa: E402
from trg_blender.ui.report_panel import report_lines  # noqa: E402

from .stage import default_cube  # noqa: E402


@pytest.fixture
def rendered():
    """The report of the default scene, rendered with an error target that is met."""
    registration.register()
    try:
        scene = default_cube((32, 18), 256)
        scene.trg.use_error_target, scene.trg.error_target = True, 0.05
        bpy.ops.render.render()
        yield records.report_of(scene.name)
    finally:
        registration.unregister()


def test_the_curve_is_drawn_once_a_report_and_given_back(rendered) -> None:
    icon = curve_icon.of(rendered)
    preview = curve_icon.collection[NAME]
    assert tuple(preview.image_size) == (320, 320)
    assert any(value > 0.9 for value in preview.image_pixels_float[:])
    assert curve_icon.of(rendered) == icon
    other = {**rendered, "error": {**rendered["error"], "history": []}}
    assert curve_icon.of(other) == 0
    curve_icon.forget()
    assert curve_icon.collection is None


def test_the_lines_say_error_and_interval(rendered) -> None:
    lines = report_lines(rendered)
    assert any(line.startswith("RMSE") and "95 %" in line for line in lines)
    assert all(len(line) < 80 for line in lines)


def test_a_render_under_way_is_told_until_it_ends(rendered) -> None:
    seen = []
    scene = bpy.context.scene
    scene.trg.use_error_target, scene.trg.samples = False, 4096

    def watch(progress) -> None:
        seen.append((progress.done, records.is_rendering(), records.progress_of(scene.name)))

    records.watcher = watch
    try:
        bpy.ops.render.render()
    finally:
        records.watcher = None
    assert not records.is_rendering()
    assert records.progress_of(scene.name) is None
    under_way = [told for done, told, _ in seen if not done]
    assert all(under_way)

"""What a viewport is given to draw: without a window, the tracer alone."""

from __future__ import annotations

import threading
import time
from dataclasses import replace

import numpy as np
import pytest

from trg_blender.engine import session, viewport_tracer
from trg_blender.engine.devices import find_device
from trg_blender.engine.scene_arrays import Material, RenderSettings
from trg_blender.engine.viewport_tracer import View, ViewportTracer, settings_for

from .arrays import floor_scene, light, look_at

pytestmark = pytest.mark.skipif(not find_device("cpu").available, reason="no native core")

SETTINGS = RenderSettings(1, 1, samples=16, max_bounces=1)
SUN = light("sun", (np.pi, np.pi, np.pi), direction=(0, 0, 1))
VIEW = View(look_at((0, 0, 3), (0, 0, 0), 0.2), 48, 32)


def floor(red: float = 0.8):
    return floor_scene(Material(red, 0.4, 0.2, specular=0.0), SUN)


@pytest.fixture
def tracer():
    made = ViewportTracer(lambda: None)
    yield made
    assert made.close()
    assert all(thread.name != "TRG viewport" for thread in threading.enumerate())


def wait_for(what, seconds: float = 20.0):
    end = time.monotonic() + seconds
    while not what():
        assert time.monotonic() < end, "nothing came"
        time.sleep(0.005)


def finished(tracer: ViewportTracer, number: int = 0) -> bool:
    """Whether the picture with all samples is there, and newer than `number`."""
    picture = tracer.picture()
    return picture is not None and picture.number > number and picture.samples == SETTINGS.samples


def test_a_coarse_picture_comes_first_and_the_last_is_a_render(tracer):
    seen = []
    tracer._redraw = lambda: seen.append(tracer.picture())
    tracer.show(floor(), SETTINGS)
    assert tracer.picture() is None
    tracer.look(VIEW)
    wait_for(lambda: finished(tracer))
    assert seen[0].scale > 1 and seen[0].pixels.shape == (8, 12, 4)
    numbers = [picture.number for picture in seen]
    assert numbers == sorted(set(numbers))
    scene = replace(floor(), camera=VIEW.camera)
    whole = session.render(scene, replace(SETTINGS, width=48, height=32))
    np.testing.assert_array_equal(seen[-1].pixels, whole.pixels)
    assert "sample 16/16" in tracer.status()


def test_a_change_of_scene_or_view_shows(tracer):
    tracer.show(floor(), SETTINGS)
    tracer.look(VIEW)
    wait_for(lambda: finished(tracer))
    before = tracer.picture()
    tracer.look(replace(VIEW, camera=look_at((0, 0, 3), (0, 0, 0), 0.2)))  # the same again
    time.sleep(0.1)
    assert tracer.picture() is before
    tracer.show(floor(0.1), SETTINGS)
    wait_for(lambda: finished(tracer, before.number))
    assert tracer.picture().pixels[..., 0].mean() == pytest.approx(0.1, rel=1e-3)
    number = tracer.picture().number
    tracer.look(replace(VIEW, width=20))
    wait_for(lambda: finished(tracer, number))
    assert tracer.picture().pixels.shape == (32, 20, 4)


def test_a_border_gives_its_part(tracer):
    tracer.show(floor(), SETTINGS)
    tracer.look(replace(VIEW, border=(12, 8, 36, 24)))
    wait_for(lambda: finished(tracer))
    picture = tracer.picture()
    assert picture.pixels.shape == (16, 24, 4)
    assert picture.place == (0.25, 0.25, 0.75, 0.75)


def test_a_refused_scene_leaves_the_last_picture(tracer):
    tracer.show(floor(), SETTINGS)
    tracer.look(VIEW)
    wait_for(lambda: finished(tracer))
    good = tracer.picture()
    bad = floor()
    bad.materials.clear()
    tracer.show(bad, SETTINGS)
    wait_for(lambda: tracer.error)
    assert "material" in tracer.status() and tracer.picture() is good
    tracer.show(floor(0.3), SETTINGS)
    wait_for(lambda: finished(tracer, good.number))
    assert not tracer.error


def test_what_the_viewer_says_of_the_scene_stays_until_it_is_shown(tracer):
    tracer.show(floor(), SETTINGS)
    tracer.look(VIEW)
    tracer.refuse("the scene is gone")
    assert tracer.status() == "error: the scene is gone"
    tracer.show(floor(), SETTINGS)
    assert tracer.error == ""


def test_a_hundred_changes_while_it_traces_end_with_the_last(tracer):
    endless = replace(SETTINGS, samples=0)
    scene = floor()
    for turn in range(100):
        if turn % 10 == 0:
            tracer.show(floor(0.1 + turn / 200), endless if turn < 90 else SETTINGS)
        tracer.look(replace(VIEW, camera=look_at((0.01 * turn, 0, 3), (0, 0, 0), 0.2)))
        time.sleep(0.002)
    wait_for(lambda: finished(tracer))
    assert tracer.picture().pixels[..., 0].mean() == pytest.approx(0.55, rel=1e-2)
    assert scene.materials


def test_closing_is_quick_and_may_be_repeated():
    tracer = ViewportTracer(lambda: None)
    tracer.show(floor(), replace(SETTINGS, samples=0))
    tracer.look(replace(VIEW, width=960, height=540))
    wait_for(lambda: tracer.picture() is not None)
    assert tracer.close() and tracer.close()
    assert ViewportTracer(lambda: None).close()


def test_scales_keep_every_border_inside():
    for scale in (1, 2, 3, 7, 8):
        for border in ((0, 0, 1, 1), (46, 30, 48, 32), (5, 7, 6, 8), (0, 0, 48, 32)):
            settings = settings_for(replace(VIEW, border=border), SETTINGS, scale)
            x_min, y_min, x_max, y_max = settings.border
            assert 0 <= x_min < x_max <= settings.width and 0 <= y_min < y_max <= settings.height


def test_the_coarse_scale_follows_what_pixels_cost(tracer):
    assert tracer._coarse_scale(VIEW) == viewport_tracer.FIRST_SCALE
    tracer._learn(1e-3, 1, replace(SETTINGS, width=100, height=100))
    assert tracer._coarse_scale(View(VIEW.camera, 100, 100)) == 1
    assert tracer._coarse_scale(View(VIEW.camera, 2000, 1000)) == 3
    assert tracer._coarse_scale(View(VIEW.camera, 100_000, 1000)) == viewport_tracer.COARSEST

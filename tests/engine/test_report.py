"""The report: every key of docs/report.md, of the right type, and the statistics line."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from pathlib import Path

import pytest

from trg_blender.engine import session
from trg_blender.engine.devices import find_device
from trg_blender.engine.features import FEATURES
from trg_blender.engine.image_error import PictureError
from trg_blender.engine.report import (
    ENDLESS_SAMPLES,
    Progress,
    format_clock,
    format_progress,
    seconds_left,
    seconds_to_target,
    with_source,
)
from trg_blender.engine.scene_arrays import Material, RenderSettings, Texture

from .arrays import checker, floor_scene, light

DOCUMENT = Path(__file__).resolve().parents[2] / "docs" / "report.md"
SCHEMA = json.loads(re.search(r"```json\n(.*?)```", DOCUMENT.read_text(encoding="utf-8"), re.DOTALL).group(1))
TYPES = {
    "object": dict,
    "array": list,
    "string": str,
    "boolean": bool,
    "integer": int,
    "number": (int, float),
    "null": type(None),
}
SETTINGS = RenderSettings(6, 5, samples=32, max_bounces=2, passes=("depth", "normal"))
SUN = light("sun", (1, 1, 1), direction=(0, 0.5, 1), angle=0.1)


def faults(value, schema: dict, at: str = "report") -> list[str]:
    """What of `value` breaks `schema`; the few words of JSON Schema that the document uses."""
    if "enum" in schema:
        return [] if value in schema["enum"] else [f"{at}: {value!r} is none of {schema['enum']}"]
    names = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
    if isinstance(value, bool) != ("boolean" in names) or not any(
        isinstance(value, TYPES[name]) for name in names
    ):
        return [f"{at}: {value!r} is no {' or '.join(names)}"]
    found = []
    if isinstance(value, dict):
        found += (
            [f"{at}: keys {sorted(value.keys() ^ schema['properties'].keys())}"]
            if value.keys() != schema["properties"].keys()
            else []
        )
        found += [
            text
            for name, part in schema["properties"].items()
            if name in value
            for text in faults(value[name], part, f"{at}.{name}")
        ]
    if isinstance(value, list):
        found += [text for item in value for text in faults(item, schema["items"], f"{at}[]")]
    return found


@pytest.fixture(params=["cpu", "embree"])
def device(request) -> str:
    reason = find_device(request.param).reason
    if reason is not None:
        pytest.skip(reason)
    return request.param


def render_report(device: str, **changes) -> dict:
    scene = floor_scene(Material(base_texture=0), SUN)
    scene.images, scene.textures = [checker()], [Texture(0)]
    scene.warnings = ["the scene warns"]
    return session.render(scene, replace(SETTINGS, device=device, **changes)).report


def test_the_report_keeps_to_its_schema_as_json(device: str):
    report = render_report(device)
    assert faults(report, SCHEMA) == []
    assert json.loads(json.dumps(report, allow_nan=False)) == report


def test_the_schema_check_finds_faults(device: str):
    report = render_report(device)
    assert faults({**report, "samples": "many"}, SCHEMA)
    assert faults({key: value for key, value in report.items() if key != "rays"}, SCHEMA)


def test_the_report_counts_what_there_is(device: str):
    report = render_report(device)
    assert report["size"] == [6, 5]
    assert report["samples"] == 32
    assert report["rays"]["camera"] == 6 * 5 * 32
    rays = report["rays"]
    assert rays["total"] == rays["camera"] + rays["shadow"] + rays["bounce"]
    assert report["scene"] == {"triangles": 2, "instances": 1, "lights": 1, "materials": 1, "textures": 1}
    assert report["warnings"] == ["the scene warns"]
    assert report["error"]["stopped_by"] == "samples"


def test_the_history_grows_and_ends_with_the_picture(device: str):
    error = render_report(device, samples=100)["error"]
    samples = [entry["samples"] for entry in error["history"]]
    assert samples[-1] == 100
    assert all(later > earlier for earlier, later in zip(samples, samples[1:], strict=False))
    assert error["history"][-1]["rmse"] == error["rmse"]
    low, high = error["ci95"]
    assert 0.0 < low < error["rmse"] < high


def test_features_are_told_from_the_arrays(device: str):
    features = render_report(device)["features"]
    assert set(features["used"]) == {"textures", "suns", "sun_angle", "depth", "normal"}
    assert sorted(features["used"] + features["left_out"]) == sorted(FEATURES)


def test_the_caller_adds_file_frame_and_times(device: str):
    report = with_source(render_report(device), "fence.trg", 3, {"script": 1.0, "sync": 2.0})
    assert (report["file"], report["frame"]) == ("fence.trg", 3)
    parts = report["seconds"]
    assert parts["total"] == pytest.approx(3.0 + parts["build"] + parts["trace"])
    assert faults(report, SCHEMA) == []


def test_the_statistics_line_reads_as_documented():
    error = PictureError(0.0212, (0.0188, 0.0241), 0.1)
    progress = Progress(False, False, 12.0, 64, error, 3.41e6, 1.0, 4.3)
    assert format_progress(progress) == "sample 12/64, rmse 0.021 (0.019 to 0.024), 3.4 Mrays/s, 00:04 left"
    unknown = Progress(False, False, 0.0, 64, PictureError(), 0.0, 0.0, None)
    assert format_progress(unknown) == "sample 0/64"
    endless = Progress(False, False, 12.0, ENDLESS_SAMPLES, PictureError(0.02), 0.0, 1.0, 3.0)
    assert format_progress(endless) == "sample 12, rmse 0.02, 00:03 left"
    assert endless.share == pytest.approx(0.25)


def test_the_line_says_when_the_error_target_will_be_met():
    error = PictureError(0.02)
    left = seconds_to_target(1.0, 0.01, error)
    running = Progress(False, False, 12.0, 64, error, 0.0, 1.0, 2.0, 0.01, left)
    assert format_progress(running) == "sample 12/64, rmse 0.02, target 0.01 in 00:03, 00:02 left"
    assert seconds_to_target(1.0, 0.0, error) is None
    assert seconds_to_target(1.0, 0.01, PictureError()) is None
    assert seconds_to_target(1.0, 0.05, error) == 0.0


def test_the_first_limit_tells_how_long_it_takes():
    state = {"samples": 10, "target": 100, "seconds": 2.0}
    assert seconds_left(state, SETTINGS, PictureError()) == pytest.approx(18.0)
    assert seconds_left(state, replace(SETTINGS, seconds=5.0), PictureError()) == pytest.approx(3.0)
    target = replace(SETTINGS, seconds=5.0, rmse=0.1)
    assert seconds_left(state, target, PictureError(0.1 * math.sqrt(2.0))) == pytest.approx(2.0)
    assert seconds_left(state, target, PictureError(0.05)) == 0.0
    assert seconds_left({**state, "samples": 0}, SETTINGS, PictureError()) is None


def test_one_sample_gives_no_error_but_a_reason(device: str):
    error = render_report(device, samples=1)["error"]
    assert (error["rmse"], error["ci95"], error["evidence"], error["reliable"]) == (None, None, None, False)
    assert "no spread" in error["note"]


def dark_report(device: str, world: float) -> dict:
    scene = floor_scene(Material(0, 0, 0, specular=0.0))
    scene.world, scene.instances = (world,) * 3, []
    return session.render(scene, replace(SETTINGS, device=device)).report


def test_pictures_without_noise_say_why_the_error_is_0(device: str):
    dark, constant = dark_report(device, 0.0)["error"], dark_report(device, 0.5)["error"]
    assert dark["rmse"] == constant["rmse"] == 0.0
    assert "no sample has met any light" in dark["note"]
    assert "every replicate gave the same picture" in constant["note"]
    assert not dark["reliable"]


def test_a_target_that_is_not_met_is_a_warning():
    if find_device("cpu").reason is not None:
        pytest.skip(find_device("cpu").reason)
    report = render_report("cpu", rmse=1e-7)
    assert report["error"]["target"] == 1e-7
    assert report["error"]["stopped_by"] == "samples"
    assert any("was not met" in warning for warning in report["warnings"])


@pytest.mark.parametrize(("seconds", "text"), [(0.4, "00:00"), (61, "01:01"), (3725, "1:02:05")])
def test_the_clock_shows_hours_when_there_are_any(seconds: float, text: str):
    assert format_clock(seconds) == text

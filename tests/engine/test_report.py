"""The report: every key of docs/report.md, of the right type, and the statistics line."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest

from trg_blender.engine import session
from trg_blender.engine.devices import find_device
from trg_blender.engine.features import FEATURES
from trg_blender.engine.report import Progress, format_clock, format_progress, with_source
from trg_blender.engine.scene_arrays import Material, RenderSettings, Texture

from .arrays import checker, floor_scene, light

DOCUMENT = Path(__file__).resolve().parents[2] / "docs" / "report.md"
SCHEMA = json.loads(re.search(r"```json\n(.*?)```", DOCUMENT.read_text(encoding="utf-8"), re.DOTALL).group(1))
TYPES = {
    "object": dict,
    "array": list,
    "string": str,
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
    if isinstance(value, bool) or not any(isinstance(value, TYPES[name]) for name in names):
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


def test_the_history_doubles_and_ends_with_the_picture(device: str):
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
    progress = Progress(False, False, 12.0, 64, 0.0212, 3.41e6, 1.0, 4.3)
    assert format_progress(progress) == "sample 12/64, rmse 0.021, 3.4 Mrays/s, 00:04 left"
    assert format_progress(Progress(False, False, 0.0, 64, None, 0.0, 0.0, None)) == "sample 0/64"


@pytest.mark.parametrize(("seconds", "text"), [(0.4, "00:00"), (61, "01:01"), (3725, "1:02:05")])
def test_the_clock_shows_hours_when_there_are_any(seconds: float, text: str):
    assert format_clock(seconds) == text

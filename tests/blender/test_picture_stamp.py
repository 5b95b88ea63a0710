"""Picture files say how wrong they are: text fields of PNG and EXR, read back."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import pytest

pytest.importorskip("bpy")
pytest.importorskip("OpenEXR")

from trg_blender import __version__, cli  # noqa: E402
from trg_blender.engine.picture_stamp import UNKNOWN, stamp_fields  # noqa: E402

from .stage import read_exr  # noqa: E402

HELLO = Path(__file__).resolve().parents[2] / "examples" / "hello.trg"


def png_texts(path: Path) -> dict[str, str]:
    """The tEXt chunks of a PNG file (Portable Network Graphics, section 11.3.4)."""
    content, at, found = path.read_bytes(), 8, {}
    while at < len(content):
        (length,), kind = struct.unpack(">I", content[at : at + 4]), content[at + 4 : at + 8]
        if kind == b"tEXt":
            name, _, value = content[at + 8 : at + 8 + length].partition(b"\0")
            found[name.decode("latin-1")] = value.decode("latin-1")
        at += 12 + length
    return found


def render(picture: Path, *words: str) -> dict:
    """Renders the first example to `picture`; gives the report."""
    report = picture.with_suffix(".json")
    ask = ["render", str(HELLO), "-o", str(picture), "--size", "32x18", "--quiet", "--report", str(report)]
    assert cli.main([*ask, *words]) == 0
    return json.loads(report.read_text(encoding="utf-8"))


def fields_of(picture: Path) -> dict[str, str]:
    texts = png_texts(picture) if picture.suffix == ".png" else read_exr(picture)[1]
    return {name: value for name, value in texts.items() if name.startswith("trg/")}


@pytest.mark.parametrize("suffix", [".png", ".exr"])
def test_a_picture_holds_the_figures_of_its_report(tmp_path: Path, suffix: str) -> None:
    picture = tmp_path / f"hello{suffix}"
    report = render(picture, "--samples", "16", "--seed", "7")
    found, error = fields_of(picture), report["error"]
    assert float(found["trg/rmse"]) == pytest.approx(error["rmse"], rel=1e-5)
    assert [float(end) for end in found["trg/interval95"].split()] == pytest.approx(error["ci95"], rel=1e-5)
    assert found["trg/samples"] == "16"
    assert found["trg/seed"] == "7"
    assert found["trg/stopped_by"] == "samples"
    assert found["trg/device"] == f"cpu/{report['accel']}"
    assert found["trg/version"] == __version__
    assert found["trg/reliable"] == ("yes" if error["reliable"] else "no")
    assert 0.0 < float(found["trg/seconds"]) <= report["seconds"]["total"] + 1e-3


def test_a_render_that_stops_by_its_error_says_so(tmp_path: Path) -> None:
    picture = tmp_path / "hello.png"
    report = render(picture, "--error", "0.5")
    assert report["error"]["stopped_by"] == "error"
    assert fields_of(picture)["trg/stopped_by"] == "error"


def test_one_sample_says_that_its_error_is_unknown(tmp_path: Path) -> None:
    picture = tmp_path / "hello.png"
    report = render(picture, "--samples", "1")
    found = fields_of(picture)
    assert found["trg/rmse"] == found["trg/interval95"] == UNKNOWN
    assert found["trg/note"] == report["error"]["note"]
    assert "no spread" in found["trg/note"]
    assert stamp_fields(report).keys() == found.keys()

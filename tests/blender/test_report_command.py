"""`trg report`: three files that say the same, and wrong usage."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import pytest

pytest.importorskip("bpy", reason="trg report needs bpy")
pytest.importorskip("matplotlib", reason="the chart needs matplotlib")

from trg_blender import cli  # noqa: E402

HELLO = Path(__file__).resolve().parents[2] / "examples" / "hello.trg"


def test_table_chart_and_page(tmp_path: Path) -> None:
    words = ["report", str(HELLO), "--size", "24x16", "--times", "0.1,0.2,0.4", "--seeds", "1"]
    words += ["--accels", "bvh,none", "--target", "0.05", "--out", str(tmp_path)]
    assert cli.main(words) == 0
    with (tmp_path / "curves.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert {row["accel"] for row in rows} == {"bvh", "none"}
    assert len(rows) == 6
    assert all(float(row["rmse"]) > 0.0 and float(row["seconds"]) > 0.0 for row in rows)
    assert (tmp_path / "curves.png").read_bytes().startswith(b"\x89PNG")
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "cpu / none / path / watertight" in page
    assert "seconds to 0.05" in page
    assert not re.search(r'(?:src|href)="(?!data:)', page)


def test_antialiasing_methods_are_compared_with_one_reference_for_each_filter(tmp_path: Path) -> None:
    words = ["report", str(HELLO), "--size", "24x16", "--times", "0.1,0.2", "--seeds", "1"]
    words += ["--integrators", "classic", "--aas", "none,supersampling:2,supersampling:8,sobol,gaussian"]
    assert cli.main([*words, "--out", str(tmp_path)]) == 0
    with (tmp_path / "curves.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    last = {row["aa"]: float(row["rmse"]) for row in rows}
    assert last.keys() == {"none", "supersampling:2", "supersampling:8", "sobol", "gaussian"}
    assert last["none"] > last["supersampling:2"] > last["supersampling:8"]
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "classic, box: cpu" in page
    assert "classic, gaussian: cpu" in page


def test_a_reference_of_another_size_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import bpy

    image = bpy.data.images.new("reference", 8, 8, float_buffer=True)
    image.filepath_raw, image.file_format = str(tmp_path / "reference.exr"), "OPEN_EXR"
    image.save()
    words = ["report", str(HELLO), "--size", "24x16", "--times", "0.1", "--seeds", "1"]
    assert cli.main([*words, "--reference", str(tmp_path / "reference.exr"), "--out", str(tmp_path)]) == 1
    assert "it is 8 x 8, the picture 24 x 16" in capsys.readouterr().err


@pytest.mark.parametrize(
    "words",
    [
        ["--accels", "quick"],
        ["--times", "0"],
        ["--times", ","],
        ["--target", "-1"],
        ["--devices", ""],
        ["--seeds", "0"],
        ["--aas", "fine"],
        ["--aas", "supersampling:0"],
        ["--aas", ","],
    ],
)
def test_wrong_usage_is_2(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["report", str(HELLO), *words]) == 2
    assert "error:" in capsys.readouterr().err

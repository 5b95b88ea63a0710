"""A rendered viewport under a virtual X server: it follows every change, and nothing is left behind."""

from __future__ import annotations

import json
from typing import Any

import pytest

from .real_blender_tool import INSIDE, RealBlender


@pytest.fixture(scope="module")
def noted(blender: RealBlender, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What the viewport showed in one session; pictures of the window lie beside it."""
    facts = tmp_path_factory.mktemp("viewport") / "viewport.json"
    done = blender.run(
        *("--window-geometry", "0", "0", "900", "600"),
        *("--python", INSIDE / "viewport.py", "--", facts),
        gui=True,
    )
    assert done.status == 0, done.text
    assert "Traceback" not in done.text, done.text
    noted: dict[str, Any] = json.loads(facts.read_text(encoding="utf-8"))
    assert not noted["timed_out"], noted
    return noted


def test_it_follows_objects_views_and_materials(noted: dict[str, Any]) -> None:
    for name in ("rendered", "moved", "orbited", "orthographic", "camera"):
        red, green, _, alpha = noted[name]["mean"]
        assert 0.0 < red < 1.0 and green > 0.0 and alpha == pytest.approx(1.0), name
        assert noted[name]["status"].startswith("sample ")
    assert noted["pictures_while_orbiting"] > 0
    assert noted["red"]["mean"][0] - noted["red"]["mean"][1] > 1e-4


def test_border_and_transparent_film_are_those_of_the_camera(noted: dict[str, Any]) -> None:
    x_min, y_min, x_max, y_max = noted["border"]["place"]
    assert 0.0 < x_min < x_max < 1.0 and 0.0 < y_min < y_max < 1.0
    assert 0.0 < noted["transparent"]["mean"][3] < 0.9


def test_a_faulty_program_is_said_and_the_picture_stays(noted: dict[str, Any]) -> None:
    assert "scene.trg:2:" in noted["build_error"]
    assert noted["faulty_status"].startswith("program: scene.trg:2:")
    assert noted["picture_stays"]
    assert noted["text_deleted"]["status"].startswith("sample ")


def test_two_viewports_and_an_emptied_scene_are_shown(noted: dict[str, Any]) -> None:
    assert noted["viewports"] == 2
    assert noted["emptied"]["mean"][3] == 0.0


def test_nothing_is_left_behind(noted: dict[str, Any]) -> None:
    assert noted["memory_late_mb"] - noted["memory_early_mb"] < 40.0, noted
    assert noted["threads_left"] == []

"""Every file of the library: how it opens, that it compiles, that its lines of use run."""

from __future__ import annotations

import re

import pytest

from trg_blender import cli
from trg_blender.lang import NoFiles, compile_source
from trg_blender.lang.format import format_source

from .library import EXAMPLES, LIBRARY, ROOT, head_of, run_example, run_text, use_of

ASSIGNED = re.compile(r"^((\w+)::\w+) = function\(", re.MULTILINE)


def names_of(file: str) -> list[str]:
    return [name for name, _ in ASSIGNED.findall((ROOT / file).read_text(encoding="utf-8"))]


@pytest.mark.parametrize("file", LIBRARY)
def test_a_file_opens_with_its_name_and_ten_lines_of_use(file: str):
    name = file.rsplit("/", 1)[1].removesuffix(".trg")
    head = head_of(file)
    assert head.startswith(f"{name} - ")
    assert "metres" in head or "linear" in head or name in ("random", "sets")
    assert 8 <= len([line for line in use_of(file).splitlines() if line]) <= 12


@pytest.mark.parametrize("file", LIBRARY)
def test_the_lines_of_use_run_to_a_picture_without_a_complaint(file: str):
    outcome = run_text(use_of(file))
    assert outcome.diagnostics == []
    (scene,) = outcome.frames
    assert scene.shapes and scene.camera is not None


@pytest.mark.parametrize("file", LIBRARY)
def test_the_lines_of_use_include_the_file_itself(file: str):
    assert f'include("{file}");' in use_of(file)


@pytest.mark.parametrize("file", LIBRARY)
def test_a_file_may_be_included_twice_and_beside_all_others(file: str):
    everything = "".join(f'include("{other}");' for other in [file, *LIBRARY, file])
    program = compile_source(everything, "main.trg", NoFiles())
    assert program.diagnostics == ()


@pytest.mark.parametrize("file", LIBRARY)
def test_names_stand_in_a_space_of_the_library_and_are_told_in_a_head(file: str):
    heads = "".join(head_of(other) for other in LIBRARY)
    private = {
        "arrange::is_near", "arrange::polar", "cameras::point", "shapes::gear_tooth", "shapes::quad",
        "shapes::brick_shades", "shapes::spring_point",
    }  # fmt: skip
    for name in names_of(file):
        space, _, last = name.partition("::")
        assert space in ("arrange", "cameras", "group", "materials", "random", "shapes", "stl")
        method = last.replace("_", " ").title().replace(" ", "")
        told = re.search(rf"\b{last}\(", heads) or f".{method}(" in heads
        assert told or name in private


@pytest.mark.parametrize("file", [*LIBRARY, *(f"examples/{name}" for name in EXAMPLES)])
def test_check_finds_nothing(file: str, capsys: pytest.CaptureFixture[str]):
    assert cli.main(["check", str(ROOT / file)]) == 0
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize("file", LIBRARY)
def test_a_file_has_the_standard_layout(file: str):
    text = (ROOT / file).read_text(encoding="utf-8")
    assert format_source(text, file) == text


@pytest.mark.parametrize("name", [name for name in EXAMPLES if name.startswith("stl_")])
def test_an_example_of_the_library_runs_for_three_frames(name: str):
    outcome = run_example(name, 3)
    assert outcome.diagnostics == []
    assert outcome.frames and all(frame.shapes and frame.camera for frame in outcome.frames)
    assert outcome.frames[0].lights


def test_every_file_of_the_library_is_used_by_an_example():
    texts = "".join((ROOT / "examples" / name).read_text(encoding="utf-8") for name in EXAMPLES)
    included = set(re.findall(r'include\("([^"]+)"\)', texts.replace("\\\\", "/")))
    for _ in range(3):
        for file in LIBRARY:
            if file in included:
                text = (ROOT / file).read_text(encoding="utf-8").split("*/", 1)[1]
                for name in re.findall(r'^include\("([^"]+)"\)', text, re.MULTILINE):
                    beside = f"{file.rsplit('/', 1)[0]}/{name}"
                    included.add(name if name in LIBRARY else beside)
    assert set(LIBRARY) <= included

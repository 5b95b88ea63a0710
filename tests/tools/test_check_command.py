"""`trg check` and the language of messages, as their user sees them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from trg_blender.cli import main
from trg_blender.commands.language import chosen_language

KEYS = {"severity", "code", "file", "line", "col", "end_line", "end_col", "message", "hint"}
FAULTY = "шар = 1;\nif (шар = 2) шар;\nb = ;\nc = shpere(1);\n"


@pytest.fixture(autouse=True)
def english(monkeypatch: pytest.MonkeyPatch):
    """Messages in English whatever the machine's language."""
    for name in ("LC_ALL", "LC_MESSAGES", "LANG"):
        monkeypatch.delenv(name, raising=False)


@pytest.fixture
def program(tmp_path: Path) -> Path:
    file = tmp_path / "scene.trg"
    file.write_text(FAULTY, encoding="utf-8")
    return file


def test_text_has_a_line_for_each_with_its_place_and_severity(program: Path, capsys):
    assert main(["check", str(program)]) == 1
    first_lines = [line for line in capsys.readouterr().out.splitlines() if line.startswith("scene.trg:")]
    assert [line.split(": ")[:2] for line in first_lines] == [
        ["scene.trg:2:5", "warning"], ["scene.trg:3:5", "error"], ["scene.trg:4:5", "error"],
    ]  # fmt: skip


def test_json_is_one_object_of_the_agreed_shape(program: Path, capsys):
    assert main(["check", "--json", str(program)]) == 1
    (line,) = capsys.readouterr().out.splitlines()
    whole = json.loads(line)
    assert set(whole) == {"diagnostics"}
    assert all(set(d) == KEYS for d in whole["diagnostics"])
    last = whole["diagnostics"][-1]
    assert (last["severity"], last["code"], last["file"]) == ("error", "E302", "scene.trg")
    assert (last["line"], last["col"], last["end_line"], last["end_col"]) == (4, 5, 4, 11)
    assert "sphere" in last["hint"]
    assert whole["diagnostics"][0]["severity"] == "warning"
    assert whole["diagnostics"][0]["hint"] is not None


def test_a_right_program_is_silent_and_warnings_alone_are_no_failure(program: Path, capsys):
    program.write_text("a = 1;\n")
    assert main(["check", str(program)]) == 0
    assert capsys.readouterr().out == ""
    assert main(["check", "--json", str(program)]) == 0
    assert json.loads(capsys.readouterr().out) == {"diagnostics": []}
    program.write_text("a = 1;\nif (a = 2) a;\n")
    assert main(["check", str(program)]) == 0


@pytest.mark.parametrize("command", ["check", "run"])
def test_an_error_in_an_included_file_shows_that_file_s_line(program: Path, capsys, command: str):
    program.write_text('include("part.trg");\n')
    program.with_name("part.trg").write_text("a = 1;\nb = shpere(1);\n")
    assert main([command, str(program)]) == 1
    shown = "".join(capsys.readouterr())
    assert "part.trg:2:5: error" in shown
    assert "b = shpere(1);" in shown


@pytest.mark.parametrize("command", ["check", "run"])
def test_russian_by_option_and_by_environment(program: Path, capsys, monkeypatch, command: str):
    main([command, "--lang", "ru", str(program)])
    assert "выражение" in "".join(capsys.readouterr())
    monkeypatch.setenv("LANG", "ru_RU.UTF-8")
    main([command, str(program)])
    assert "выражение" in "".join(capsys.readouterr())
    main([command, "--lang", "en", str(program)])
    assert "expression" in "".join(capsys.readouterr())


def test_errors_while_it_runs_are_in_the_chosen_language(program: Path, capsys):
    program.write_text("a = 1 / 0;\n")
    main(["run", "--lang", "ru", str(program)])
    assert "деление на ноль" in capsys.readouterr().err


def test_the_language_of_the_environment():
    assert chosen_language(None, {"LANG": "ru_RU.UTF-8"}) == "ru"
    assert chosen_language(None, {"LANG": "ru_RU.UTF-8", "LC_ALL": "de_DE"}) == "en"
    assert chosen_language(None, {"LANG": "ru_RU.UTF-8", "LC_ALL": ""}) == "ru"
    assert chosen_language(None, {}) == "en"
    assert chosen_language("en", {"LANG": "ru_RU"}) == "en"


def test_an_unknown_language_is_a_wrong_usage(program: Path):
    assert main(["check", "--lang", "xx", str(program)]) == 2

"""`trg fmt` as its user sees it."""

from __future__ import annotations

import io
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from trg_blender.cli import main

UGLY, PLAIN = "a=1;\n", "a = 1;\n"


@pytest.fixture
def program(tmp_path: Path) -> Path:
    file = tmp_path / "scene.trg"
    file.write_bytes(UGLY.encode())
    return file


def test_a_file_is_rewritten_in_place_and_keeps_its_mode(program: Path):
    program.chmod(0o600)
    assert main(["fmt", str(program)]) == 0
    assert program.read_text() == PLAIN
    assert program.stat().st_mode & 0o777 == 0o600
    assert list(program.parent.iterdir()) == [program]


def test_check_names_the_file_changes_nothing_and_exits_with_1(program: Path, capsys):
    assert main(["fmt", "--check", str(program)]) == 1
    assert program.read_text() == UGLY
    assert str(program) in capsys.readouterr().out
    main(["fmt", str(program)])
    assert main(["fmt", "--check", str(program)]) == 0


def test_windows_line_ends_stay(program: Path):
    program.write_bytes(b"a=1;\r\nb=2;\r\n")
    assert main(["fmt", str(program)]) == 0
    assert program.read_bytes() == b"a = 1;\r\nb = 2;\r\n"


def test_a_faulty_program_is_left_as_it_is(program: Path, capsys):
    program.write_text("a = ;\n")
    assert main(["fmt", str(program)]) == 1
    assert program.read_text() == "a = ;\n"
    assert "scene.trg:1:5: error" in capsys.readouterr().err


def test_one_faulty_file_does_not_keep_the_others_from_being_formatted(program: Path):
    faulty = program.with_name("faulty.trg")
    faulty.write_text("a = ;\n")
    assert main(["fmt", str(faulty), str(program)]) == 1
    assert program.read_text() == PLAIN


def test_a_dash_reads_the_input_and_writes_the_output(monkeypatch):
    given = SimpleNamespace(buffer=io.BytesIO("шар=1; // 🎈\n".encode()))
    taken = SimpleNamespace(buffer=io.BytesIO())
    with monkeypatch.context() as patched:
        patched.setattr(sys, "stdin", given)
        patched.setattr(sys, "stdout", taken)
        assert main(["fmt", "-"]) == 0
    assert taken.buffer.getvalue().decode() == "шар = 1;  // 🎈\n"


def test_a_missing_file_and_a_file_that_is_no_text_exit_with_1(program: Path, capsys):
    assert main(["fmt", str(program.with_name("none.trg"))]) == 1
    program.write_bytes(b"\xff\xfe")
    assert main(["fmt", str(program)]) == 1
    assert "UTF-8" in capsys.readouterr().err


def test_russian_messages_on_request(program: Path, capsys):
    program.write_text("a = ;\n")
    main(["fmt", "--lang", "ru", str(program)])
    assert "выражение" in capsys.readouterr().err

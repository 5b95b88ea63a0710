"""The command line: exit codes, help, and what a subcommand costs to start."""

from __future__ import annotations

import json
import subprocess
import sys
import types
from pathlib import Path

import pytest

from trg_blender import __version__, cli
from trg_blender.engine.devices import DEVICE_NAMES, Unavailable
from trg_blender.engine.errors import SceneError

ROOT = Path(__file__).resolve().parents[2]


def fake_command(monkeypatch, failure: BaseException | None = None, code: int = 0):
    """Puts a subcommand in the place of `info` that raises or returns."""

    def run(args):
        if failure is not None:
            raise failure
        return code

    module = types.SimpleNamespace(add_parser=lambda subparsers: subparsers.add_parser("info"), run=run)
    monkeypatch.setattr(cli.importlib, "import_module", lambda *_: module)


@pytest.mark.parametrize("words", [[], ["paint"], ["info", "--no-such-option"], ["--no-such-option"]])
def test_wrong_usage_is_2_with_the_reason_on_stderr(words: list[str], capsys):
    assert cli.main(words) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert "trg" in said.err
    assert "error:" in said.err


def test_help_names_every_command(capsys):
    assert cli.main(["--help"]) == 0
    said = capsys.readouterr().out
    assert all(f"  {name}" in said for name in cli.COMMANDS)


def test_version_is_the_package_s(capsys):
    assert cli.main(["--version"]) == 0
    assert capsys.readouterr().out == f"trg {__version__}\n"


@pytest.mark.parametrize("name", cli.COMMANDS)
def test_every_command_explains_itself(name: str, capsys):
    if name == "render":
        pytest.importorskip("bpy", reason="trg render needs bpy")
    assert cli.main([name, "--help"]) == 0
    assert f"trg {name}" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("failure", "code"),
    [
        (SceneError("no camera"), 1),
        (FileNotFoundError(2, "No such file or directory", "x.trg"), 1),
        (KeyboardInterrupt(), 3),
        (Unavailable("device cuda: not built yet"), 4),
    ],
)
def test_expected_failures_are_one_line_and_a_code(monkeypatch, capsys, failure, code: int):
    fake_command(monkeypatch, failure)
    assert cli.main(["info"]) == code
    said = capsys.readouterr().err
    assert said.startswith("trg: ")
    assert said.count("\n") == 1


def test_a_bug_of_ours_is_not_hidden(monkeypatch):
    fake_command(monkeypatch, ZeroDivisionError())
    with pytest.raises(ZeroDivisionError):
        cli.main(["info"])


def test_the_command_s_code_is_the_program_s(monkeypatch):
    fake_command(monkeypatch, code=3)
    assert cli.main(["info"]) == 3


def test_info_tells_every_device_and_the_reason_of_the_absent_ones():
    done = subprocess.run(
        [sys.executable, "-m", "trg_blender", "info", "--json"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    facts = json.loads(done.stdout)
    assert [device["name"] for device in facts["devices"]] == list(DEVICE_NAMES)
    for device in facts["devices"]:
        assert device["available"] == (device["reason"] is None)
        assert device["available"] or len(device["reason"]) > 10


@pytest.mark.parametrize("name", ["run", "check"])
def test_a_program_alone_needs_neither_numpy_nor_bpy(name: str):
    code = (
        f"import sys; from trg_blender.cli import main; main(['{name}', '--help']);"
        "sys.stderr.write(' '.join({'numpy', 'bpy', 'trg_native'} & sys.modules.keys()))"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stderr == ""


def test_a_reader_that_leaves_early_is_no_error():
    done = subprocess.run(
        f"{sys.executable} -m trg_blender info --json | true; exit ${{PIPESTATUS[0]}}",
        cwd=ROOT,
        capture_output=True,
        text=True,
        shell=True,
        executable="/bin/bash",
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")

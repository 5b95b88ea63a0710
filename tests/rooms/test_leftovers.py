"""Nothing is left behind: no notes to self, no debugging output, no code asleep, no place of one machine."""

from __future__ import annotations

import ast
import re
import subprocess
import sys

import pytest

from .tree import (
    PACKAGE,
    ROOT,
    files,
    native_files,
    python_files,
    read,
    report,
    syntax_tree,
    without_comments,
)

CODE = (".py", ".h", ".cpp", ".cu", ".trg", ".sh", ".cmake", "CMakeLists.txt", "Makefile", ".toml")
BINARY = (".png", ".jpg", ".jpeg", ".g24", ".g32", ".gsm", ".g3dm", ".g3d", ".exr", ".blend", ".gif", ".webp")
THIS_FILE = "tests/rooms/test_leftovers.py"
MARKS = re.compile(r"\b(TODO|FIXME|XXX|HACK)\b")
MACHINE_PATHS = re.compile(r"(?<![\w.$}~*)\]-])/(home|Users|root|work|mnt|data)/\w|\b[A-Z]:\\\\?Users\b")
REGISTRIES = re.compile(
    r"pypi\.org|pythonhosted|artifactory|devpi|(extra-)?index-url|registry\.npmjs", re.IGNORECASE
)
PRINTING_PLACES = (f"{PACKAGE}/cli.py", f"{PACKAGE}/commands/")
"""What a command prints is its result."""


def text_lines(*suffixes: str) -> list[tuple[str, int, str]]:
    """(file, line number, line) of every text file but this one."""
    names = [name for name in files(*suffixes) if name != THIS_FILE and not name.lower().endswith(BINARY)]
    return [(name, number, line) for name in names for number, line in enumerate(read(name).splitlines(), 1)]


def test_no_code_holds_a_note_to_self():
    violations = [
        f"{name}:{number}: {line.strip()}" for name, number, line in text_lines(*CODE) if MARKS.search(line)
    ]
    assert not violations, report(violations)


def test_no_file_names_a_place_of_one_machine():
    violations = [
        f"{name}:{number}: {found[0]}"
        for name, number, line in text_lines()
        if (found := MACHINE_PATHS.search(line))
    ]
    assert not violations, report(violations)


def test_no_file_names_a_package_registry():
    violations = [
        f"{name}:{number}: {found[0]}"
        for name, number, line in text_lines()
        if (found := REGISTRIES.search(line))
    ]
    assert not violations, report(violations)


def test_the_package_does_not_print():
    violations = []
    for name in python_files(PACKAGE):
        for node in ast.walk(syntax_tree(name)):
            called = node.func.id if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) else ""
            if called == "breakpoint" or (called == "print" and not name.startswith(PRINTING_PLACES)):
                violations.append(f"{name}:{node.lineno}: {called}()")
    assert not violations, report(violations)


def test_native_code_does_not_print():
    pattern = re.compile(r"\b(printf|fprintf|puts)\s*\(|std::(cout|cerr|clog)\b")
    violations = [
        f"{name}:{number}: {line.strip()}"
        for name in native_files()
        if not name.startswith(("native/tests/", "native/bench/"))
        for number, line in enumerate(without_comments(read(name)).splitlines(), 1)
        if pattern.search(line)
    ]
    assert not violations, report(violations)


def test_native_code_holds_no_code_in_comments():
    asleep = re.compile(
        r"^\s*//(?!/)\s*(#\s*include|return\b.*;|if\s*\(|for\s*\(|[\w:.>\-\[\]]+\s*(=|\().*;\s*$|\}\s*$)"
    )
    violations = [
        f"{name}:{number}: {line.strip()}"
        for name in native_files()
        for number, line in enumerate(read(name).splitlines(), 1)
        if asleep.search(line)
    ]
    assert not violations, report(violations)


def test_python_holds_no_code_in_comments():
    pytest.importorskip("ruff", reason="ruff (requirements/lint.txt) tells code from prose")
    command = [sys.executable, "-m", "ruff", "check", "--select", "ERA001", "--output-format", "concise", "."]
    checked = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert checked.returncode == 0, checked.stdout


def test_no_test_is_switched_off_without_a_reason():
    violations = []
    for name in python_files("tests/"):
        for node in ast.walk(syntax_tree(name)):
            if not isinstance(node, ast.Call | ast.Attribute):
                continue
            text = ast.unparse(node.func if isinstance(node, ast.Call) else node)
            named = isinstance(node, ast.Call) and (node.args or node.keywords)
            if (
                re.fullmatch(r"pytest\.(mark\.(skip|xfail)|skip|xfail)", text)
                and isinstance(node, ast.Call)
                and not named
            ):
                violations.append(f"{name}:{node.lineno}: {text} without a reason")
    assert not violations, report(violations)

"""The project's files as the structural tests read them: tracked ones and new ones git does not ignore."""

from __future__ import annotations

import ast
import re
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = "trg_blender"
GENERATED_FOLDERS = {"build", "dist", "out", "__pycache__"}


@cache
def files(*suffixes: str) -> tuple[str, ...]:
    """Paths relative to the root, sorted; all of them without `suffixes`."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard"]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    names = listed.stdout.splitlines() if listed.returncode == 0 else list(_walk())
    return tuple(
        sorted({n for n in names if (ROOT / n).is_file() and (not suffixes or n.endswith(suffixes))})
    )


def _walk() -> Iterator[str]:
    """For a copy of the tree without git."""
    for path in ROOT.rglob("*"):
        parts = path.relative_to(ROOT).parts
        hidden = any(part.startswith(".") for part in parts[:-1]) and parts[0] != ".ci"
        if path.is_file() and not hidden and not GENERATED_FOLDERS.intersection(parts):
            yield "/".join(parts)


def read(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8", errors="replace")


@cache
def syntax_tree(name: str) -> ast.Module:
    return ast.parse(read(name), filename=name)


def python_files(*folders: str) -> list[str]:
    return [name for name in files(".py") if name.startswith(folders)]


def native_files(*suffixes: str) -> list[str]:
    return [name for name in files(*(suffixes or (".h", ".cpp", ".cu"))) if name.startswith("native/")]


@dataclass(frozen=True, slots=True)
class Import:
    line: int
    module: str
    """absolute dotted name"""
    relative: bool


def imports_of(name: str) -> list[Import]:
    """Every import of a file, also those inside functions; relative ones made absolute."""
    package = name.removesuffix(".py").removesuffix("/__init__").split("/")
    if not name.endswith("/__init__.py"):
        package = package[:-1]
    found = []
    for node in ast.walk(syntax_tree(name)):
        if isinstance(node, ast.Import):
            found += [Import(node.lineno, alias.name, False) for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and not node.level:
            found.append(Import(node.lineno, node.module or "", False))
        elif isinstance(node, ast.ImportFrom):
            found += _relative_imports(node, package)
    return found


def _relative_imports(node: ast.ImportFrom, package: list[str]) -> list[Import]:
    """`from . import a, b` names modules a and b; `from .a import f` names a."""
    climbed = package[: len(package) - node.level + 1] if node.level <= len(package) else ["<outside>"]
    if node.module:
        return [Import(node.lineno, ".".join([*climbed, node.module]), True)]
    return [Import(node.lineno, ".".join([*climbed, alias.name]), True) for alias in node.names]


def without_comments(text: str) -> str:
    """C++ text with comments and string contents blanked, lines kept."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)
    return pattern.sub(lambda found: '""' if found[0][0] == '"' else "\n" * found[0].count("\n"), text)


def report(violations: list[str]) -> str:
    """For an assertion's message: one violation a line."""
    return "\n".join(["", *violations])

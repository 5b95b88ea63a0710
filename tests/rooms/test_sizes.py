"""Files, functions and parameter lists keep to the limits of the project's style."""

from __future__ import annotations

import ast

import pytest

from .tree import PACKAGE, ROOT, files, native_files, python_files, read, report, syntax_tree

MAX_FILE_LINES = 500
MAX_FUNCTION_LINES = 60
MAX_PARAMETERS = 5
MAX_TRACKED_BYTES = 200_000
MAX_PICTURE_BYTES = 400_000
MAX_PICTURES = 15
SOURCES = (".py", ".h", ".cpp", ".cu", ".trg", ".sh", ".cmake")
PICTURES = (".png", ".jpg", ".jpeg", ".webp", ".gif")

MANY_PARAMETERS: dict[str, str] = {}
"""`file::function` -> why a struct would not be better"""


def functions_of(name: str) -> list[ast.FunctionDef | ast.AsyncFunctionDef]:
    kinds = ast.FunctionDef | ast.AsyncFunctionDef
    return [node for node in ast.walk(syntax_tree(name)) if isinstance(node, kinds)]


def parameter_count(function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    """Without self and cls, and without *args and **kwargs."""
    arguments = [*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs]
    return sum(argument.arg not in ("self", "cls") for argument in arguments)


def test_no_source_file_is_longer_than_500_lines():
    lengths = {name: len(read(name).splitlines()) for name in files(*SOURCES)}
    violations = [f"{name}: {length} lines" for name, length in lengths.items() if length > MAX_FILE_LINES]
    assert not violations, report(violations)


def test_no_python_function_is_longer_than_60_lines():
    violations = [
        f"{name}:{function.lineno}: {function.name} has {function.end_lineno - function.lineno + 1} lines"
        for name in files(".py")
        for function in functions_of(name)
        if function.end_lineno - function.lineno + 1 > MAX_FUNCTION_LINES
    ]
    assert not violations, report(violations)


def test_no_python_function_takes_more_than_five_parameters():
    violations = [
        f"{name}:{function.lineno}: {function.name} takes {parameter_count(function)}"
        for name in python_files(PACKAGE, "tools/", "__init__.py")
        for function in functions_of(name)
        if parameter_count(function) > MAX_PARAMETERS and f"{name}::{function.name}" not in MANY_PARAMETERS
    ]
    assert not violations, report(violations)


def test_native_functions_keep_to_60_lines_and_five_parameters():
    lizard = pytest.importorskip("lizard", reason="lizard (requirements/lint.txt) measures C++")
    violations = []
    for name in native_files():
        for function in lizard.analyze_file(str(ROOT / name)).function_list:
            place = f"{name}:{function.start_line}: {function.name}"
            if function.length > MAX_FUNCTION_LINES:
                violations.append(f"{place} has {function.length} lines")
            count = len(function.parameters)
            if count > MAX_PARAMETERS and f"{name}::{function.name}" not in MANY_PARAMETERS:
                violations.append(f"{place} takes {count} parameters")
    assert not violations, report(violations)


def is_docs_picture(name: str) -> bool:
    return name.startswith("docs/") and name.lower().endswith(PICTURES)


def test_no_tracked_file_is_larger_than_200_kb_but_the_pictures_of_the_docs():
    sizes = {name: (ROOT / name).stat().st_size for name in files()}
    violations = [
        f"{name}: {size} bytes"
        for name, size in sizes.items()
        if size > (MAX_PICTURE_BYTES if is_docs_picture(name) else MAX_TRACKED_BYTES)
    ]
    assert not violations, report(violations)


def test_the_docs_hold_at_most_15_pictures():
    assert sum(is_docs_picture(name) for name in files()) <= MAX_PICTURES

"""Imports run one way: lang <- engine <- ui <- commands, and bpy stays in its marked files."""

from __future__ import annotations

import ast
import re
import sys

from .tree import PACKAGE, imports_of, python_files, read, report, syntax_tree

ROOMS_BELOW = {
    "lang": {"lang"},
    "engine": {"lang", "engine"},
    "ui": {"lang", "engine", "ui"},
}
"""A room not named here (commands, cli, the package itself) may use every room."""

BLENDER_MODULES = {
    "bpy",
    "bpy_extras",
    "bmesh",
    "mathutils",
    "gpu",
    "gpu_extras",
    "blf",
    "aud",
    "addon_utils",
}


def blender_places() -> tuple[str, ...]:
    """Files and folders that may import bpy: those that docs/architecture.md marks, ui and one command."""
    (marked,) = re.findall(r"with bpy: ([^|]*)\|", read("docs/architecture.md"))
    places = [f"{PACKAGE}/engine/{place}" for place in re.findall(r"`([^`]+)`", marked)]
    return (*places, f"{PACKAGE}/ui/", f"{PACKAGE}/commands/render.py")


def room_of(module: str) -> str:
    """`trg_blender.engine.formats` -> engine; empty for the package itself."""
    parts = module.split(".")
    return parts[1] if len(parts) > 1 else ""


def test_the_architecture_marks_the_files_that_may_import_bpy():
    assert f"{PACKAGE}/engine/to_blender/" in blender_places()


def test_no_room_imports_one_above_it():
    violations = []
    for name in python_files(PACKAGE):
        below = ROOMS_BELOW.get(room_of(name.removesuffix(".py").replace("/", ".")))
        for found in imports_of(name):
            inside = found.module.split(".")[0] == PACKAGE
            # The package itself holds the version, which every room may read.
            if inside and below is not None and room_of(found.module) not in below | {"", "__version__"}:
                violations.append(f"{name}:{found.line}: imports {found.module}")
    assert not violations, report(violations)


def test_imports_inside_the_package_are_relative_and_stay_inside():
    violations = [
        f"{name}:{found.line}: imports {found.module}"
        for name in python_files(PACKAGE)
        for found in imports_of(name)
        if (found.module.split(".")[0] == PACKAGE) != found.relative
    ]
    assert not violations, report(violations)


def test_the_language_needs_nothing_but_the_standard_library():
    violations = [
        f"{name}:{found.line}: imports {found.module}"
        for name in python_files(f"{PACKAGE}/lang/")
        for found in imports_of(name)
        if not found.relative and found.module.split(".")[0] not in sys.stdlib_module_names
    ]
    assert not violations, report(violations)


def test_bpy_is_imported_only_where_the_architecture_says():
    places = blender_places()
    violations = [
        f"{name}:{found.line}: imports {found.module}"
        for name in python_files(PACKAGE)
        for found in imports_of(name)
        if found.module.split(".")[0] in BLENDER_MODULES and not name.startswith(places)
    ]
    assert not violations, report(violations)


def test_the_formats_need_numpy_only():
    violations = [
        f"{name}:{found.line}: imports {found.module}"
        for name in python_files(f"{PACKAGE}/engine/formats/")
        for found in imports_of(name)
        if not found.module.startswith(f"{PACKAGE}.engine.formats")
        and found.module.split(".")[0] not in sys.stdlib_module_names | {"numpy"}
    ]
    assert not violations, report(violations)


def test_the_language_knows_no_any():
    violations = [
        f"{name}:{node.lineno}: Any"
        for name in python_files(f"{PACKAGE}/lang/")
        for node in ast.walk(syntax_tree(name))
        if (isinstance(node, ast.Name) and node.id == "Any")
        or (isinstance(node, ast.Attribute) and node.attr == "Any")
    ]
    assert not violations, report(violations)


def test_every_function_of_the_language_is_annotated():
    violations = []
    for name in python_files(f"{PACKAGE}/lang/"):
        for node in ast.walk(syntax_tree(name)):
            if not isinstance(node, ast.FunctionDef):
                continue
            arguments = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
            bare = [a.arg for a in arguments if a.annotation is None and a.arg not in ("self", "cls")]
            if bare or node.returns is None:
                violations.append(f"{name}:{node.lineno}: {node.name} lacks {bare or 'its return type'}")
    assert not violations, report(violations)


def broad_handlers(name: str) -> list[ast.ExceptHandler]:
    """Handlers of a file that catch everything."""
    handlers = [node for node in ast.walk(syntax_tree(name)) if isinstance(node, ast.ExceptHandler)]
    return [h for h in handlers if h.type is None or ast.unparse(h.type) in ("Exception", "BaseException")]


def test_a_file_catches_everything_at_one_border_at_most_and_reports_it():
    violations = []
    for name in python_files(PACKAGE, "tools/", "__init__.py"):
        handlers = broad_handlers(name)
        violations += [f"{name}:{handler.lineno}: a second broad except" for handler in handlers[1:]]
        violations += [
            f"{name}:{handler.lineno}: swallows everything without a word"
            for handler in handlers
            if all(isinstance(statement, ast.Pass | ast.Continue) for statement in handler.body)
        ]
    assert not violations, report(violations)

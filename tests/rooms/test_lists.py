"""Lists that must agree exist once, or are compared here."""

from __future__ import annotations

import ast
import re
import tomllib

import pytest

import trg_blender
from trg_blender.engine import classic_arrays, scene_arrays
from trg_blender.lang import scene

from .tree import read, syntax_tree

MIRROR = "trg_blender/engine/to_blender"
LEGS = ("3.11", "3.13")


@pytest.mark.parametrize("table", ["MATERIAL_FIELDS", "LIGHT_FIELDS", "TEXTURE_FIELDS"])
def test_the_columns_of_a_packed_table_are_the_same_in_both_languages(table: str):
    trg_native = pytest.importorskip("trg_native", reason="the native core is not built here")
    if not hasattr(trg_native, table):
        pytest.fail(f"trg_native has no {table}")
    assert tuple(getattr(trg_native, table)) == getattr(scene_arrays, table)


def test_the_columns_of_classic_materials_are_the_same_in_both_languages():
    trg_native = pytest.importorskip("trg_native", reason="the native core is not built here")
    assert trg_native.CLASSIC_FIELDS == classic_arrays.CLASSIC_FIELDS


@pytest.mark.parametrize("manifest", ["native/pyproject.toml", "blender_manifest.toml"])
def test_the_version_is_the_packages(manifest: str):
    written = tomllib.loads(read(manifest))
    assert written.get("project", written)["version"] == trg_blender.__version__


@pytest.mark.parametrize("leg", LEGS)
def test_a_leg_pins_the_blender_module_that_the_project_declares(leg: str):
    (pinned,) = re.findall(r"^bpy==(\S+)$", read(f"requirements/{leg}.txt"), re.MULTILINE)
    render = tomllib.loads(read("pyproject.toml"))["project"]["optional-dependencies"]["render"]
    assert f"bpy=={pinned}; python_version == '{leg}'" in render
    assert f"{pinned} (Python {leg})" in read("docs/architecture.md")


def test_every_declared_dependency_is_pinned_for_the_legs():
    project = tomllib.loads(read("pyproject.toml"))["project"]
    optional = project["optional-dependencies"]
    wanted = {
        re.split(r"[=<>;]", line)[0].lower() for line in [*project["dependencies"], *optional["render"]]
    }
    for leg in LEGS:
        text = read(f"requirements/{leg}.txt") + read("requirements/common.txt")
        pinned = {name.lower() for name in re.findall(r"^([\w-]+)==", text, re.MULTILINE)}
        assert wanted <= pinned, f"Python {leg} lacks {wanted - pinned}"


def value_of(name: str, file: str) -> ast.expr:
    """The expression that `file` assigns to the module variable `name`, read without importing bpy."""
    for node in syntax_tree(file).body:
        targets = node.targets if isinstance(node, ast.Assign) else [getattr(node, "target", None)]
        if any(isinstance(target, ast.Name) and target.id == name for target in targets):
            return node.value
    raise AssertionError(f"{file} assigns no {name}")


def keys_of(name: str, file: str) -> list[str]:
    return [ast.literal_eval(key) for key in value_of(name, file).keys]


def described_shapes() -> dict[str, list[str]]:
    """Kind -> parameter names, as ShapeRecord describes them."""
    found = re.findall(r"(\w+) \(([\w, ]+)\)", scene.ShapeRecord.__doc__ or "")
    return {kind: [word for word in names.split(", ") if word] for kind, names in found if kind != "model"}


def test_shapes_are_checked_by_the_parameters_that_their_record_describes():
    table = ast.literal_eval(value_of("SHAPE_PARAMETERS", f"{MIRROR}/validate.py"))
    checked = {kind: [name for name, _ in parameters] for kind, parameters in table.items()}
    assert checked == {**described_shapes(), "model": ["file"]}


def test_every_described_shape_has_a_place_in_blender():
    assert keys_of("PLACERS", f"{MIRROR}/placement.py") == list(described_shapes())


def test_every_described_light_is_checked_and_has_a_blender_type():
    (described,) = re.findall(r"`kind`: ([\w |]+)\.", scene.LightRecord.__doc__ or "")
    kinds = described.split(" | ")
    assert list(ast.literal_eval(value_of("LIGHT_KINDS", f"{MIRROR}/validate.py"))) == kinds
    assert keys_of("BLENDER_TYPES", f"{MIRROR}/lights.py") == kinds


def test_the_tour_shows_the_first_example_as_it_is():
    shown = re.findall(r"```c\n(.*?)```", read("docs/language_tour.md"), re.DOTALL)
    assert read("examples/hello.trg") in shown

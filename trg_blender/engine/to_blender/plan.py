"""What one frame needs, worked out before Blender is touched: meshes, places, materials, groups of copies.

A program often makes equal materials over and over (`material::red_plastic()` in a loop). The first of
equal ones stands for all, so that their shapes can share an instancer.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Container
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ...lang.scene import MaterialRecord, SceneDescription, ShapeRecord
from . import validate
from .axes import transforms_to_blender
from .models import MISSING_MODEL_KEY, MeshContents
from .placement import MeshRecipe, bake_linear_part, place_shape
from .tags import fingerprint
from .transforms import Decomposition, decompose

COPY_THRESHOLD = 200
"""More copies than this of one mesh and material become one instancer."""


@dataclass(frozen=True, slots=True)
class PlannedShape:
    """What follows from a shape's record alone; good as long as the record stays equal."""

    shape: ShapeRecord
    recipe: MeshRecipe
    matrix: NDArray[np.float64]
    """(4, 4) mesh to Blender's world"""
    digest: str
    """fingerprint of all but the material"""


@dataclass(frozen=True, slots=True)
class CopyGroup:
    """Copies that differ only in their place."""

    mesh_key: str
    material_key: str
    copies: tuple[PlannedShape, ...]

    @property
    def key(self) -> str:
        return f"copies of {self.mesh_key} in {self.material_key or 'its own material'}"


@dataclass(frozen=True, slots=True)
class FramePlan:
    singles: tuple[PlannedShape, ...]
    groups: tuple[CopyGroup, ...]
    new_meshes: dict[str, MeshContents]
    """by recipe key: meshes that Blender does not have yet"""
    materials: dict[str, MaterialRecord]
    """by the key of a record: the record that stands for it"""

    def material_of(self, planned: PlannedShape) -> MaterialRecord | None:
        """The record that stands for the shape's; None: the mesh keeps its own, as a placeholder does."""
        material = planned.shape.material
        is_placeholder = planned.recipe.key.startswith(MISSING_MODEL_KEY)
        return None if material is None or is_placeholder else self.materials[material.key]


@dataclass(slots=True)
class Planner:
    """Plans frame after frame; remembers what it worked out about records that stay equal."""

    model_recipe: Callable[[ShapeRecord], MeshRecipe]
    _shapes: dict[str, PlannedShape] = field(default_factory=dict)
    _material_digests: dict[str, tuple[MaterialRecord, str]] = field(default_factory=dict)

    def plan(self, description: SceneDescription, existing_meshes: Container[str]) -> FramePlan:
        """The plan of a frame. Raises SceneError when a record or a model's file is wrong."""
        _check_rest(description)
        materials = self._representatives(description)
        self._shapes = self._planned_shapes(description)
        singles, groups = _grouped(list(self._shapes.values()), materials)
        new_meshes: dict[str, MeshContents] = {}
        for planned in self._shapes.values():
            key = planned.recipe.key
            if key not in existing_meshes and key not in new_meshes:
                new_meshes[key] = planned.recipe.build()
        return FramePlan(singles, groups, new_meshes, materials)

    def _planned_shapes(self, description: SceneDescription) -> dict[str, PlannedShape]:
        """Every shape of the frame by key. Only what changed is worked out, and models: files may change."""
        records = {shape.key: shape for shape in description.shapes}
        fresh: list[ShapeRecord] = []
        for key, shape in records.items():
            planned = self._shapes.get(key)
            if planned is None or shape.kind == "model" or planned.shape != shape:
                validate.check_shape(shape)
                fresh.append(shape)
        worked_out = dict(
            zip((shape.key for shape in fresh), _work_out(fresh, self.model_recipe), strict=True)
        )
        return {key: worked_out.get(key) or self._shapes[key] for key in records}

    def _representatives(self, description: SceneDescription) -> dict[str, MaterialRecord]:
        """For each material's key the first record of equal content."""
        records = {
            shape.material.key: shape.material for shape in description.shapes if shape.material is not None
        }
        digests: dict[str, tuple[MaterialRecord, str]] = {}
        first_of: dict[str, MaterialRecord] = {}
        result: dict[str, MaterialRecord] = {}
        for key, record in records.items():
            known = self._material_digests.get(key)
            if known is None or known[0] != record:
                validate.check_material(record)
                known = (record, fingerprint(replace(record, key="", version=0, origin=None)))
            digests[key] = known
            result[key] = first_of.setdefault(known[1], record)
        self._material_digests = digests
        return result


def _check_rest(description: SceneDescription) -> None:
    validate.check_counts(description)
    for light in description.lights:
        validate.check_light(light)
    if description.camera is not None:
        validate.check_camera(description.camera)
    validate.check_background(description)


def _work_out(
    shapes: list[ShapeRecord], model_recipe: Callable[[ShapeRecord], MeshRecipe]
) -> list[PlannedShape]:
    """Meshes and matrices of checked records. An object of Blender cannot be sheared: then its mesh is."""
    if not shapes:
        return []
    placements = [place_shape(shape, model_recipe) for shape in shapes]
    exact = decompose(np.array([placement.matrix for placement in placements])).exact
    placements = [p if fits else bake_linear_part(p) for p, fits in zip(placements, exact, strict=True)]
    matrices = transforms_to_blender(np.array([placement.matrix for placement in placements]))
    return [
        PlannedShape(
            shape,
            placement.recipe,
            matrix,
            fingerprint(replace(shape, material=None, version=0), placement.recipe.key),
        )
        for shape, placement, matrix in zip(shapes, placements, matrices, strict=True)
    ]


def _grouped(
    shapes: list[PlannedShape], materials: dict[str, MaterialRecord]
) -> tuple[tuple[PlannedShape, ...], tuple[CopyGroup, ...]]:
    """Shapes apart, and groups of many unnamed copies."""
    kinds = [_kind_of_copy(planned, materials) for planned in shapes]
    counts = Counter(kind for kind in kinds if kind is not None)
    members: dict[tuple[str, str], list[PlannedShape]] = {}
    singles = []
    for planned, kind in zip(shapes, kinds, strict=True):
        if kind is not None and counts[kind] > COPY_THRESHOLD:
            members.setdefault(kind, []).append(planned)
        else:
            singles.append(planned)
    groups = tuple(CopyGroup(mesh, material, tuple(copies)) for (mesh, material), copies in members.items())
    return tuple(singles), groups


def _kind_of_copy(planned: PlannedShape, materials: dict[str, MaterialRecord]) -> tuple[str, str] | None:
    """(mesh, material) for a shape that may go into an instancer; None for one with a name of its own."""
    if planned.shape.name:
        return None
    material = planned.shape.material
    return planned.recipe.key, materials[material.key].key if material is not None else ""


def poses_of(group: CopyGroup) -> Decomposition:
    """Places of the copies in Blender's world."""
    return decompose(np.array([planned.matrix for planned in group.copies]))

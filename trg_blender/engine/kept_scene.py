"""A native scene that outlives its picture: the next one makes anew only what is different.

What is different is told by comparing arrays, bit by bit; arrays that are the very same object cost
nothing. Three ways, the cheapest that serves: tables alone; vertices and transforms in place (trees are
fitted, the top level is built); a new scene that takes the meshes with their trees out of the old one.
"""

from __future__ import annotations

import time
from collections import defaultdict
from dataclasses import asdict, dataclass, field, fields
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .holes import has_holes
from .native_scene import (
    add_environment,
    add_mesh,
    finish_native_scene,
    set_attributes,
    set_look_ups,
    set_pass_data,
    set_randoms,
    set_tables,
    set_view,
)
from .scene_arrays import Environment, ImageArrays, InstanceArrays, MeshArrays, RenderSettings, SceneArrays

SCENE_FIELDS = tuple(each.name for each in fields(SceneArrays) if each.name not in ("camera", "warnings"))

SIZE_CHANGE = 4
"""So many times the triangles call for another choice of accelerator."""


@dataclass(slots=True)
class Changes:
    """What of the index a picture needed; counts of meshes, and whether the top level was built."""

    built_trees: int = 0
    kept_trees: int = 0
    fitted_trees: int = 0
    """vertices moved, boxes followed"""
    top_level: bool = False


@dataclass(slots=True)
class KeptScene:
    """One native scene and the arrays that it was made of; empty at first.

    Not for several threads at once. No job may be alive on the scene when it changes: then it is left
    to that job and a new one is made.
    """

    arrays: SceneArrays | None = None
    _scene: Any = None
    _made_for: tuple[object, ...] = ()
    _build: dict[str, Any] = field(default_factory=dict)

    def knows(self, scene: SceneArrays) -> bool:
        """Whether all but the camera is the very same."""
        return self.arrays is not None and is_same_scene(self.arrays, scene)

    def bring(
        self, native: ModuleType, scene: SceneArrays, settings: RenderSettings
    ) -> tuple[Any, dict[str, Any]]:
        """The built native scene of `scene`, and its build statistics with `changes` of this time.

        Raises ValueError as the native scene does, and forgets all then.
        """
        start = time.perf_counter()
        old, old_arrays, same_kind = self._scene, self.arrays, self._made_for == _kind(scene, settings)
        self._scene = None
        changes = Changes()
        if old is None or old_arrays is None or not same_kind:
            self._build_new(native, scene, settings, changes)
        else:
            try:
                if not _update(old, (old_arrays, scene), settings, changes):
                    old = self._rebuild(native, (old, old_arrays), scene, settings, changes)
                self._scene = old
            except RuntimeError:  # a job still reads the old scene
                self._build_new(native, scene, settings, changes)
        self.arrays, self._made_for = scene, _kind(scene, settings)
        seconds = time.perf_counter() - start
        return self._scene, {**self._build, "seconds": seconds, "changes": asdict(changes)}

    def forget(self) -> None:
        """Gives the memory back."""
        self.arrays, self._scene = None, None

    def _build_new(
        self, native: ModuleType, scene: SceneArrays, settings: RenderSettings, changes: Changes
    ) -> None:
        result = native.Scene(accel=settings.accel, triangle_test=settings.triangle_test)
        for mesh in scene.meshes:
            add_mesh(result, mesh)
        self._finish(result, scene, settings, changes)

    def _rebuild(
        self,
        native: ModuleType,
        old: tuple[Any, SceneArrays],
        scene: SceneArrays,
        settings: RenderSettings,
        changes: Changes,
    ) -> Any:
        source, arrays = old
        accel = self._accel(arrays, scene, settings)
        result = native.Scene(accel=accel, triangle_test=settings.triangle_test)
        for mesh, number in zip(scene.meshes, match_meshes(arrays.meshes, scene.meshes), strict=True):
            if number < 0:
                add_mesh(result, mesh)
            else:
                result.take_mesh(source, number)
        self._finish(result, scene, settings, changes)
        return result

    def _accel(self, old: SceneArrays, new: SceneArrays, settings: RenderSettings) -> str:
        """A choice stays while the scene is about as large: trees of another kind cannot be kept."""
        sizes = [sum(len(mesh.triangles) for mesh in one.meshes) for one in (old, new)]
        alike = max(sizes) < SIZE_CHANGE * min(sizes)
        return str(self._build["accel"]) if settings.accel == "auto" and alike else settings.accel

    def _finish(self, result: Any, scene: SceneArrays, settings: RenderSettings, changes: Changes) -> None:
        self._build = finish_native_scene(result, scene, settings, merge=False)
        changes.built_trees = self._build["built_trees"]
        changes.kept_trees = self._build["kept_trees"]
        changes.top_level = True
        self._scene = result


def is_same_scene(a: SceneArrays, b: SceneArrays) -> bool:
    """Whether all but the camera is the very same object."""
    return all(getattr(a, name) is getattr(b, name) for name in SCENE_FIELDS)


def count_trees(scene: SceneArrays) -> int:
    """Meshes that are placed anywhere."""
    return len({one.mesh for one in scene.instances if len(one.transforms)})


def _kind(scene: SceneArrays, settings: RenderSettings) -> tuple[object, ...]:
    """What a native scene cannot change once it is made."""
    return (
        settings.accel,
        settings.triangle_test,
        settings.integrator,
        scene.environment is None,
        scene.pass_data is None,
        scene.transparent_film,
        has_holes(scene),
    )


def _update(
    result: Any, arrays: tuple[SceneArrays, SceneArrays], settings: RenderSettings, changes: Changes
) -> bool:
    """Changes `result` in place from the old arrays to the new; False, and nothing done, where it cannot.

    Raises RuntimeError, and nothing is done, while a job reads it.
    """
    old, new = arrays
    if is_same_scene(old, new):
        set_view(result, new, settings)
        changes.kept_trees = count_trees(new)
        return True
    moved = moved_meshes(old.meshes, new.meshes)
    if moved is None or not _same_instances(old.instances, new.instances):
        return False
    if not _same_images(old.images, new.images) or not _same_randoms(old.instances, new.instances):
        return False
    result.set_world(0.0, 0.0, 0.0)  # refused while the scene is in use, before anything is done
    for number in moved:
        _move_vertices(result, number, new.meshes[number], settings, changes)
    changes.top_level = _move_instances(result, arrays, settings) or bool(moved)
    changes.kept_trees = count_trees(new) - changes.built_trees - changes.fitted_trees
    set_look_ups(result, new)
    set_tables(result, new)
    if new.environment is not None and not _same_environment(old.environment, new.environment):
        add_environment(result, new)
    if new.pass_data is not None and not _same_identities(old, new):
        set_pass_data(result, new, new.pass_data)
    set_randoms(result, new)
    set_view(result, new, settings)
    return True


def _move_vertices(
    result: Any, number: int, mesh: MeshArrays, settings: RenderSettings, changes: Changes
) -> None:
    normals = None if mesh.normals is None else np.ascontiguousarray(mesh.normals, dtype=np.float32)
    vertices = np.ascontiguousarray(mesh.vertices, dtype=np.float32)
    if result.update_vertices(number, vertices, normals, settings.threads)["rebuilt"]:
        changes.built_trees += 1
    else:
        changes.fitted_trees += 1
    set_attributes(result, number, mesh)


def _move_instances(result: Any, arrays: tuple[SceneArrays, SceneArrays], settings: RenderSettings) -> bool:
    """Moves all between the first and the last that stand elsewhere; False where all stand still."""
    pairs = list(zip(arrays[0].instances, arrays[1].instances, strict=True))
    different = [k for k, pair in enumerate(pairs) if not same_array(pair[0].transforms, pair[1].transforms)]
    if not different:
        return False
    first = sum(len(one.transforms) for one, _ in pairs[: different[0]])
    rows = [new.transforms for _, new in pairs[different[0] : different[-1] + 1]]
    places = np.ascontiguousarray(np.concatenate(rows), dtype=np.float32)
    result.update_transforms(first, places, settings.threads)
    return True


def same_array(a: NDArray[Any] | None, b: NDArray[Any] | None) -> bool:
    """Bit by bit, of the same type and shape."""
    if a is b:
        return True
    if a is None or b is None or a.shape != b.shape or a.dtype != b.dtype:
        return False
    if not a.size:
        return True
    flat = [memoryview(np.ascontiguousarray(each)).cast("B") for each in (a, b)]
    return flat[0] == flat[1]


def same_topology(a: MeshArrays, b: MeshArrays) -> bool:
    """Whether the meshes differ at most in where vertices and normals are."""
    return (
        a.shape == b.shape
        and a.vertices.shape == b.vertices.shape
        and (a.normals is None) == (b.normals is None)
        and a.attributes.keys() == b.attributes.keys()
        and same_array(a.triangles, b.triangles)
        and same_array(a.slots, b.slots)
        and same_array(a.uvs, b.uvs)
    )


def same_mesh(a: MeshArrays, b: MeshArrays) -> bool:
    """Whether the meshes are the same bit by bit; names do not count."""
    return a is b or (
        a.texture_space == b.texture_space
        and same_array(a.vertices, b.vertices)
        and same_topology(a, b)
        and same_array(a.normals, b.normals)
        and all(same_array(values, b.attributes[key]) for key, values in a.attributes.items())
    )


def moved_meshes(old: list[MeshArrays], new: list[MeshArrays]) -> list[int] | None:
    """Numbers of the meshes whose vertices moved; None when more than that is different."""
    if len(old) != len(new):
        return None
    moved = []
    for number, (a, b) in enumerate(zip(old, new, strict=True)):
        if same_mesh(a, b):
            continue
        if a.shape != "triangles" or not same_topology(a, b):
            return None
        moved.append(number)
    return moved


def match_meshes(old: list[MeshArrays], new: list[MeshArrays]) -> list[int]:
    """For each new mesh the old one that is the same, used once; -1 where there is none."""
    named: dict[tuple[str, int], list[int]] = defaultdict(list)
    for number, mesh in enumerate(old):
        named[mesh.origin, len(mesh.triangles)].append(number)
    matches = []
    for mesh in new:
        candidates = named[mesh.origin, len(mesh.triangles)]
        match = next((number for number in candidates if same_mesh(old[number], mesh)), -1)
        if match >= 0:
            candidates.remove(match)
        matches.append(match)
    return matches


def _same_instances(old: list[InstanceArrays], new: list[InstanceArrays]) -> bool:
    """Whether they are copies of the same meshes with the same materials, wherever they stand."""
    return len(old) == len(new) and all(
        a is b
        or (
            a.mesh == b.mesh
            and a.transforms.shape == b.transforms.shape
            and same_array(a.slot_materials, b.slot_materials)
            and (a.mask, a.holdout) == (b.mask, b.holdout)
            and a.motion is None
            and b.motion is None
        )
        for a, b in zip(old, new, strict=True)
    )


def _same_randoms(old: list[InstanceArrays], new: list[InstanceArrays]) -> bool:
    """Whether both have numbers or neither: a scene that has them keeps them."""
    return any(one.randoms is not None for one in old) == any(one.randoms is not None for one in new)


def _same_images(old: list[ImageArrays], new: list[ImageArrays]) -> bool:
    return len(old) == len(new) and all(
        a.srgb == b.srgb and same_array(a.pixels, b.pixels) for a, b in zip(old, new, strict=True)
    )


def _same_environment(old: Environment | None, new: Environment | None) -> bool:
    if old is None or new is None:
        return old is new
    return (
        old.seen_by_camera == new.seen_by_camera
        and same_array(old.rotation, new.rotation)
        and same_array(old.pixels, new.pixels)
    )


def _same_identities(old: SceneArrays, new: SceneArrays) -> bool:
    return old.pass_data == new.pass_data and all(
        a.identities == b.identities for a, b in zip(old.instances, new.instances, strict=True)
    )

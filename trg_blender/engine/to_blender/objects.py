"""The objects of one scene's mirror: found by key, made, changed, removed in bulk."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

import bpy
from mathutils import Matrix, Quaternion, Vector

from ...lang.scene import ShapeRecord
from .edits import is_moved, note_pose
from .placement import MeshRecipe
from .tags import DETACHED, HASH, KEY, KIND, MEDIUM_DECAY, MEDIUM_INDEX, ORIGIN, PLANE, SPHERE

BULK = 200
"""From this many new or vanished objects on, the collection leaves the scene while it is edited:
Blender then sorts its view layers once, not once an object."""

LAYER_FLAGS = ("exclude", "hide_viewport", "holdout", "indirect_only")
ANALYTIC = {"sphere": (SPHERE, (0.0, 0.0, 0.0, 1.0)), "plane": (PLANE, (0.0, 0.0, 1.0, 0.0))}


@dataclass(frozen=True, slots=True)
class Pose:
    """Location, rotation and scale in Blender's world."""

    location: Vector
    rotation: Quaternion
    scale: Vector


@dataclass(slots=True)
class ObjectStore:
    """Objects of the mirror's collection. New ones are linked by `finish`, unnamed ones removed by it."""

    scene: bpy.types.Scene
    collection: bpy.types.Collection
    made: int = 0
    updated: int = 0
    deleted: int = 0
    _objects: dict[str, bpy.types.Object] = field(default_factory=dict)
    _new: list[bpy.types.Object] = field(default_factory=list)
    _wanted: set[str] = field(default_factory=set)
    _detached: frozenset[str] = frozenset()
    warnings: list[str] = field(default_factory=list)
    """edits by hand that the program's new records replaced"""

    def __post_init__(self) -> None:
        self._detached = frozenset(self.collection.get(DETACHED, ()))
        self._objects = {obj[KEY]: obj for obj in self.collection.objects if KEY in obj}

    def unchanged(self, key: str, digest: str) -> bool:
        """Note that the key is wanted; tell whether its object is already what `digest` stands for, or the
        user's own."""
        self._wanted.add(key)
        if key in self._detached:
            return True
        obj = self._objects.get(key)
        return obj is not None and obj.get(HASH) == digest

    def get(self, key: str) -> bpy.types.Object | None:
        return self._objects.get(key)

    def write(self, key: str, digest: str, name: str, data: bpy.types.ID | None) -> bpy.types.Object:
        """The object of `key` with `data`, made when it is not there. Its kind of data may not change:
        then the old object makes way for a new one."""
        obj = self._objects.get(key)
        if obj is not None and (obj.data is None or data is None or obj.data.bl_rna != data.bl_rna):
            bpy.data.objects.remove(obj)
            obj = None
        if obj is None:
            obj = bpy.data.objects.new(name, data)
            obj[KEY] = key
            obj.rotation_mode = "QUATERNION"
            self._objects[key] = obj
            self._new.append(obj)
            self.made += 1
        else:
            self.updated += 1
            if is_moved(obj):
                self.warnings.append(
                    f"{obj.name}: was moved by hand; the program has changed it since and moved it back"
                )
            if obj.data != data:
                obj.data = data
        obj[HASH] = digest
        return obj

    def finish(self) -> None:
        """Link what is new and remove what no record named."""
        vanished = [obj for key, obj in self._objects.items() if key not in self._wanted]
        if len(self._new) >= BULK or len(vanished) >= BULK:
            with _out_of_scene(self.scene, self.collection):
                self._link_and_remove(vanished)
        else:
            self._link_and_remove(vanished)

    def _link_and_remove(self, vanished: list[bpy.types.Object]) -> None:
        for obj in self._new:
            self.collection.objects.link(obj)
        if vanished:
            bpy.data.batch_remove(vanished)
        self.deleted += len(vanished)
        self._new = []


def set_pose(obj: bpy.types.Object, pose: Pose) -> None:
    """Write only the parts that differ."""
    if obj.location != pose.location:
        obj.location = pose.location
    if obj.rotation_quaternion != pose.rotation:
        obj.rotation_quaternion = pose.rotation
    if obj.scale != pose.scale:
        obj.scale = pose.scale
    note_pose(obj)


def pose_of_matrix(matrix: Matrix) -> Pose:
    location, rotation, scale = matrix.decompose()
    return Pose(location, rotation, scale)


def set_material(obj: bpy.types.Object, material: bpy.types.Material | None) -> None:
    """Give all slots of the object the material, on the object since meshes are shared; None: the mesh's."""
    for slot in obj.material_slots:
        link = "DATA" if material is None else "OBJECT"
        if slot.link != link:
            slot.link = link
        if material is not None and slot.material != material:
            slot.material = material


def write_shape_properties(obj: bpy.types.Object, shape: ShapeRecord, recipe: MeshRecipe) -> None:
    """Where the shape came from, its medium, and the true sphere or plane that its mesh stands for."""
    obj[KIND] = shape.kind
    obj[ORIGIN] = str(shape.origin or "")
    obj[MEDIUM_DECAY] = float(shape.medium.decay)
    obj[MEDIUM_INDEX] = float(shape.medium.index)
    for kind, (name, values) in ANALYTIC.items():
        if shape.kind == kind and recipe.key == kind:
            obj[name] = values
        elif name in obj:
            del obj[name]


@contextmanager
def _out_of_scene(scene: bpy.types.Scene, collection: bpy.types.Collection) -> Iterator[None]:
    """Unlink the collection for the length of a `with`, and bring its view-layer flags back afterwards."""
    layers = {layer.name: layer.layer_collection.children.get(collection.name) for layer in scene.view_layers}
    kept = {
        name: {flag: getattr(child, flag) for flag in LAYER_FLAGS}
        for name, child in layers.items()
        if child is not None
    }
    scene.collection.children.unlink(collection)
    try:
        yield
    finally:
        scene.collection.children.link(collection)
        for name, flags in kept.items():
            child = scene.view_layers[name].layer_collection.children[collection.name]
            for flag, value in flags.items():
                setattr(child, flag, value)

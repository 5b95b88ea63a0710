"""What a user does to objects that a program made: noticed before it is overwritten, or made the user's own.

The program stays the master of what it describes. An edit lives until the program's own record of that
object or material changes; then the record wins and the edit is told of. Who wants to keep it detaches.
"""

from __future__ import annotations

from collections.abc import Iterable

import bpy

from . import instancers
from .tags import (
    DETACHED,
    HASH,
    IMAGE,
    KEY,
    KIND,
    MESH,
    ORIGIN,
    OWNER,
    PLANE,
    POSE,
    SPHERE,
    WRITTEN,
    fingerprint,
)

TOLERANCE = 1e-5
"""Of a pose's numbers relative to the largest: Blender keeps them in single precision."""
_TAGS = (HASH, IMAGE, KEY, KIND, MESH, ORIGIN, OWNER, PLANE, POSE, SPHERE, WRITTEN)


def note_pose(obj: bpy.types.Object) -> None:
    """Remember the pose that the program gave."""
    obj[POSE] = _pose_of(obj)


def is_moved(obj: bpy.types.Object) -> bool:
    """Whether the object stands elsewhere than the program put it."""
    written = obj.get(POSE)
    if written is None:
        return False
    now = _pose_of(obj)
    largest = max(1.0, *map(abs, now))
    return any(abs(a - b) > TOLERANCE * largest for a, b in zip(now, written, strict=True))


def _pose_of(obj: bpy.types.Object) -> list[float]:
    return [*obj.location, *obj.rotation_quaternion, *obj.scale]


def note_material(material: bpy.types.Material) -> None:
    """Remember the nodes' values that the program gave."""
    material[WRITTEN] = _nodes_of(material)


def is_changed(material: bpy.types.Material) -> bool:
    """Whether the material's nodes are others than the program made, or have other values."""
    return WRITTEN in material and material[WRITTEN] != _nodes_of(material)


def _nodes_of(material: bpy.types.Material) -> str:
    tree = material.node_tree
    values = [
        (node.name, socket.name, _plain(socket.default_value))
        for node in tree.nodes
        for socket in node.inputs
        if hasattr(socket, "default_value") and not socket.is_linked
    ]
    links = [(link.from_node.name, link.to_node.name, link.to_socket.name) for link in tree.links]
    return fingerprint(sorted(values, key=repr), sorted(links))


def _plain(value: object) -> object:
    return tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else str(value)


def detach_objects(collection: bpy.types.Collection, objects: Iterable[bpy.types.Object]) -> int:
    """Make objects of a program's collection the user's own, and have the program leave them out.

    Returns how many. They stay where they are, in the collection that holds the program's.
    """
    keys = set(collection.get(DETACHED, ()))
    found = [obj for obj in objects if KEY in obj and obj.name in collection.objects]
    for obj in found:
        keys.add(obj[KEY])
        _make_ordinary(obj)
    collection[DETACHED] = sorted(keys)
    return len(found)


def detach_all(scene: bpy.types.Scene, collection: bpy.types.Collection) -> int:
    """Make everything of a program the user's own: a new run begins with a collection of its own.

    Returns how many objects.
    """
    found = [obj for obj in collection.objects if KEY in obj]
    for obj in found:
        _make_ordinary(obj)
    if scene.world is not None and scene.world.get(OWNER) == collection[OWNER]:
        _untag(scene.world)
    for name in [name for name in collection.keys() if name.startswith("trg_")]:  # noqa: SIM118
        del collection[name]
    return len(found)


def attach_all(collection: bpy.types.Collection) -> int:
    """Let the program make the objects again that were detached; returns how many it left out."""
    keys = collection.get(DETACHED, ())
    if DETACHED in collection:
        del collection[DETACHED]
    return len(keys)


def _make_ordinary(obj: bpy.types.Object) -> None:
    """Take the tags from an object and from all that it alone would lose to the program."""
    source = instancers.source_of(obj)
    if source is not None:
        for modifier in obj.modifiers:
            if modifier.type == "NODES" and modifier.node_group is not None:
                _untag(modifier.node_group)
        source.use_fake_user = True
        _make_ordinary(source)
    if obj.data is not None:
        if obj.data.users > 1:
            obj.data = obj.data.copy()
        _untag(obj.data)
    for slot in obj.material_slots:
        if slot.material is not None and OWNER in slot.material:
            slot.material = slot.material.copy()
            _untag(slot.material)
    _untag(obj)


def _untag(block: bpy.types.ID) -> None:
    for tag in _TAGS:
        if tag in block:
            del block[tag]

"""The custom properties by which a scene's mirror finds its own again, in this session or after loading."""

from __future__ import annotations

import hashlib
import uuid
from collections.abc import Iterable

import bpy

KEY = "trg_key"
KIND = "trg_kind"
ORIGIN = "trg_origin"
HASH = "trg_hash"
"""fingerprint of the record that the block was last made equal to"""
OWNER = "trg_owner"
"""id of the scene whose program made the block"""
MESH = "trg_mesh"
"""key of the recipe that a mesh was made by"""
IMAGE = "trg_image"
SPHERE = "trg_sphere"
"""(x, y, z, radius) in object space: the mesh stands for this sphere"""
PLANE = "trg_plane"
"""(x, y, z, distance) in object space: the mesh stands for this plane"""
POSE = "trg_pose"
"""location, rotation and scale that the program gave an object"""
WRITTEN = "trg_written"
"""fingerprint of a material's nodes as the program made them"""
DETACHED = "trg_detached"
"""keys of the objects that the user took from the program; of its collection"""
FALLOFF = "trg_falloff"
MEDIUM_DECAY = "trg_medium_decay"
MEDIUM_INDEX = "trg_medium_index"
COLLECTION_NAME = "TRG"


def fingerprint(*parts: object) -> str:
    """Short stable digest of values whose repr is their whole content."""
    return hashlib.blake2b(repr(parts).encode(), digest_size=12).hexdigest()


def mirror_collection(scene: bpy.types.Scene) -> bpy.types.Collection:
    """The scene's own collection "TRG", made when it is not there yet."""
    found = collection_of(scene)
    if found is not None:
        return found
    collection = bpy.data.collections.new(COLLECTION_NAME)
    collection[OWNER] = uuid.uuid4().hex
    scene.collection.children.link(collection)
    return collection


def collection_of(scene: bpy.types.Scene) -> bpy.types.Collection | None:
    """The collection of the scene's program, when it has made one."""
    found = (c for c in scene.collection.children if OWNER in c and c.library is None)
    return next(found, None)


def blocks_by_key(blocks: Iterable[bpy.types.ID], owner: str | None = None) -> dict[str, bpy.types.ID]:
    """Tagged data blocks by their key; `owner` restricts them to one scene's."""
    found: dict[str, bpy.types.ID] = {}
    for block in blocks:
        key = block.get(KEY)
        if key is not None and (owner is None or block.get(OWNER) == owner):
            found[key] = block
    return found

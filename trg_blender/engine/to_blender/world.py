"""The background of a program as a world of Blender."""

from __future__ import annotations

import bpy

from ...lang.scene import SceneDescription, TextureRecord
from .images import ImageStore
from .tags import HASH, KEY, OWNER, fingerprint

WORLD_KEY = "world"


def write_world(
    scene: bpy.types.Scene, owner: str, description: SceneDescription, images: ImageStore
) -> bool:
    """Give the scene its own world with the program's background; tells whether anything was written."""
    background = description.background
    picture = images.source_key(background) if isinstance(background, TextureRecord) else ""
    digest = fingerprint(background, description.ambient, picture)
    world = scene.world
    if world is None or world.get(OWNER) != owner:
        own = (w for w in bpy.data.worlds if w.get(OWNER) == owner)
        world = next(own, None) or bpy.data.worlds.new("TRG")
        world[KEY], world[OWNER] = WORLD_KEY, owner
        scene.world = world
    if world.get(HASH) == digest:
        return False
    if bpy.app.version < (5, 0, 0):
        world.use_nodes = True
    _write_tree(world.node_tree, description.background, images)
    if not isinstance(description.background, TextureRecord):
        world.color = description.background
    world["trg_ambient"] = tuple(float(c) for c in description.ambient)
    world[HASH] = digest
    return True


def _write_tree(
    tree: bpy.types.NodeTree, background: tuple[float, float, float] | TextureRecord, images: ImageStore
) -> None:
    tree.nodes.clear()
    shader = tree.nodes.new("ShaderNodeBackground")
    output = tree.nodes.new("ShaderNodeOutputWorld")
    output.location = (250, 0)
    tree.links.new(output.inputs["Surface"], shader.outputs["Background"])
    shader.inputs["Strength"].default_value = 1.0
    if isinstance(background, TextureRecord):
        picture = tree.nodes.new("ShaderNodeTexEnvironment")
        picture.location = (-350, 0)
        picture.image = images.prepare(background, is_color=True)
        tree.links.new(shader.inputs["Color"], picture.outputs["Color"])
    else:
        shader.inputs["Color"].default_value = (*background, 1.0)

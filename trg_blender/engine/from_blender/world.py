"""Blender's world -> one constant radiance, or an equirectangular picture and perhaps a sun."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Euler

from ..scene_arrays import Color, Environment, Float32, Float64, Light
from .sky import place_sun, read_sky
from .sockets import active_tree, as_color, as_number, constant_of, feeding_socket

BLACK: Color = (0.0, 0.0, 0.0)
LARGEST_RADIANCE = 1e30


@dataclass(frozen=True, slots=True)
class WorldLight:
    """What surrounds a scene."""

    color: Color
    """constant radiance, where there is no environment"""
    environment: Environment | None = None
    sun: Light | None = None
    """that of a sky"""


def read_world(world: bpy.types.World | None, warnings: list[str]) -> WorldLight:
    """Light of the background: Background node colour times strength; black without a world."""
    if world is None:
        return WorldLight(BLACK)
    tree = active_tree(world)
    if tree is None:
        return WorldLight(as_color(world.color))
    output = tree.get_output_node("CYCLES")
    if output is None:
        return WorldLight(BLACK)
    if output.inputs["Volume"].is_linked:
        warnings.append(f"world {world.name!r}: its volume is not rendered")
    source = feeding_socket(output.inputs["Surface"])
    if source is None:
        return WorldLight(BLACK)
    if source.node.type not in ("BACKGROUND", "EMISSION"):
        warnings.append(f"world {world.name!r}: node {source.node.name!r} is not supported, black is used")
        return WorldLight(BLACK)
    strength = as_number(_constant(source.node.inputs["Strength"], world.name, warnings))
    picture = feeding_socket(source.node.inputs["Color"])
    if picture is not None and picture.node.type == "TEX_ENVIRONMENT":
        return _read_environment(world, picture.node, strength, warnings)
    if picture is not None and picture.node.type == "TEX_SKY":
        return _read_sky(world, picture.node, strength, warnings)
    red, green, blue = as_color(_constant(source.node.inputs["Color"], world.name, warnings))
    return WorldLight((red * strength, green * strength, blue * strength))


def _constant(socket: bpy.types.NodeSocket, name: str, warnings: list[str]) -> object:
    source = feeding_socket(socket)
    if source is None:
        return socket.default_value
    value = constant_of(source)
    if value is None:
        warnings.append(
            f"world {name!r}: node {source.node.name!r} on {socket.name} is not supported, "
            f"the socket's own value is used"
        )
        return socket.default_value
    return value


def _read_environment(
    world: bpy.types.World, node: bpy.types.Node, strength: float, warnings: list[str]
) -> WorldLight:
    """An Environment Texture node; the node's magenta where its image is missing, as in Cycles."""
    where = f"world {world.name!r}: node {node.name!r}"
    pixels = _radiance(node.image)
    if pixels is None:
        warnings.append(f"{where}: it has no image that can be read; shown in magenta")
        return WorldLight((strength, 0.0, strength))
    if node.projection != "EQUIRECTANGULAR":
        warnings.append(f"{where}: projection {node.projection} is rendered as equirectangular")
    if node.interpolation != "Linear":
        warnings.append(f"{where}: interpolation {node.interpolation} is rendered as linear")
    if not np.isfinite(pixels).all():
        warnings.append(f"{where}: pixels that are not finite are rendered black")
        pixels = np.where(np.isfinite(pixels), pixels, 0.0)
    rotation = _rotation(node, where, warnings)
    return WorldLight(
        BLACK, Environment(_scaled(pixels, strength), rotation, _is_seen(world), node.image.name)
    )


def _scaled(pixels: Float32, strength: float) -> Float32:
    with np.errstate(over="ignore"):
        return np.clip(pixels * np.float32(strength), -LARGEST_RADIANCE, LARGEST_RADIANCE).astype(np.float32)


def _is_seen(world: bpy.types.World) -> bool:
    return bool(world.cycles_visibility.camera) if hasattr(world, "cycles_visibility") else True


def _read_sky(
    world: bpy.types.World, node: bpy.types.Node, strength: float, warnings: list[str]
) -> WorldLight:
    where = f"world {world.name!r}: node {node.name!r}"
    pixels, turn, sun = read_sky(node, where, warnings)
    rotation = turn @ _rotation(node, where, warnings)
    environment = Environment(_scaled(pixels, strength), rotation, _is_seen(world), node.name)
    return WorldLight(BLACK, environment, None if sun is None else place_sun(sun, rotation, strength))


def _radiance(image: bpy.types.Image | None) -> Float32 | None:
    """(h, w, 3) linear pixels; None when there are none."""
    if image is None or not image.size[0] or not image.size[1] or not image.channels:
        return None
    width, height = image.size
    flat = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(flat)
    pixels = flat.reshape(height, width, image.channels)
    pixels = pixels[..., :3] if image.channels >= 3 else np.repeat(pixels[..., :1], 3, axis=2)
    if image.is_float or image.colorspace_settings.is_data or "Linear" in image.colorspace_settings.name:
        return pixels
    low = pixels / 12.92
    return np.where(pixels <= 0.04045, low, ((pixels + 0.055) / 1.055) ** 2.4).astype(np.float32)


def _rotation(node: bpy.types.Node, where: str, warnings: list[str]) -> Float64:
    """(3, 3) what Mapping nodes before `node` do to a direction, as far as it is a rotation."""
    rotation = np.eye(3)
    socket = node.inputs.get("Vector")
    source = None if socket is None else feeding_socket(socket)
    while source is not None and source.node.type == "MAPPING":
        rotation = rotation @ _mapping_rotation(source.node, where, warnings)
        source = feeding_socket(source.node.inputs["Vector"])
    known = ("Generated", "Object", "Position")
    if source is not None and source.name not in known:
        warnings.append(f"{where}: {source.node.name!r} is read as the direction")
    return rotation


def _mapping_rotation(node: bpy.types.Node, where: str, warnings: list[str]) -> Float64:
    values = {}
    for name in ("Location", "Rotation", "Scale"):
        socket = node.inputs.get(name)
        values[name] = None if socket is None else tuple(socket.default_value)
        if socket is not None and feeding_socket(socket) is not None:
            warnings.append(f"{where}: a link into {name} of {node.name!r} is not supported")
    moved = node.vector_type in ("POINT", "TEXTURE") and any(values["Location"] or ())
    if moved or any(abs(abs(s) - 1.0) > 1e-6 or s < 0.0 for s in values["Scale"] or ()):
        warnings.append(f"{where}: location and scale of {node.name!r} are not rendered, rotation is")
    turn = np.array(Euler(values["Rotation"] or (0.0, 0.0, 0.0)).to_matrix(), dtype=np.float64)
    return turn.T if node.vector_type == "TEXTURE" else turn

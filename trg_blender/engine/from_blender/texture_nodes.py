"""What each node that gives a number, vector or colour becomes in a program."""

from __future__ import annotations

from collections.abc import Callable

import bpy
from mathutils import Matrix

from ..program_builder import Value
from ..texture_ops import (
    GRADIENTS,
    INFOS,
    MAPPINGS,
    NOISE_COLORED,
    NOISE_KIND_SHIFT,
    NOISE_NORMALIZE,
    NOISES,
    NORMAL_SPACES,
    NORMALS,
    PROJECTIONS,
    WAVE_PROFILE_SHIFT,
    WAVE_RINGS,
)
from .color_nodes import COLOR_READERS
from .image_texture import constant_mapping
from .sockets import describe
from .texture_graph import GraphReader, number

NodeReader = Callable[[GraphReader, bpy.types.Node, bpy.types.NodeSocket], Value]


def _constant(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    return graph.own_value(source)


def _image(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    row = graph.table.image_texture(node, graph.owner, bool(node.outputs["Alpha"].is_linked))
    place = graph.place_or(node, "uv")
    if node.projection == "BOX":
        texel = graph.builder.emit("box", place, number(node.projection_blend), mode=row)
    else:
        if node.projection != "FLAT":
            place = graph.builder.emit("project", place, mode=PROJECTIONS.index(node.projection.lower()))
        texel = graph.builder.emit("image", place, mode=row)
    return texel.part(3) if source.identifier == "Alpha" else texel


def _checker(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    inputs = [graph.named(node, name) for name in ("Color1", "Color2", "Scale")]
    texel = graph.builder.emit("checker", graph.place_or(node, "generated"), *inputs)
    return texel.part(3) if source.identifier == "Fac" else texel


def _noise(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    mode = int(node.noise_dimensions[0]) - 1
    mode |= NOISES.index(node.noise_type) << NOISE_KIND_SHIFT
    mode |= NOISE_NORMALIZE if node.normalize else 0
    mode |= NOISE_COLORED if source.identifier == "Color" else 0
    names = ("W", "Scale", "Detail", "Roughness", "Lacunarity", "Offset", "Gain", "Distortion")
    inputs = [graph.named(node, name) for name in names]
    return graph.builder.emit("noise", graph.place_or(node, "generated"), *inputs, mode=mode)


def _brick(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    names = ("Color1", "Color2", "Mortar", "Scale", "Mortar Size", "Mortar Smooth", "Bias", "Brick Width")
    inputs = [graph.named(node, name) for name in (*names, "Row Height")]
    fixed = (node.offset, node.squash, float(node.offset_frequency), float(node.squash_frequency))
    texel = graph.builder.emit("brick", graph.place_or(node, "generated"), *inputs, Value(fixed))
    return texel.part(3) if source.identifier == "Fac" else texel


def _wave(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    rings = node.wave_type == "RINGS"
    axis = node.rings_direction if rings else node.bands_direction
    mode = {"X": 0, "Y": 1, "Z": 2}.get(axis, 3) | (WAVE_RINGS if rings else 0)
    mode |= ("SIN", "SAW", "TRI").index(node.wave_profile) << WAVE_PROFILE_SHIFT
    names = ("Scale", "Distortion", "Detail", "Detail Scale", "Detail Roughness", "Phase Offset")
    inputs = [graph.named(node, name) for name in names]
    return graph.builder.emit("wave", graph.place_or(node, "generated"), *inputs, mode=mode)


def _gradient(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    mode = GRADIENTS.index(node.gradient_type)
    return graph.builder.emit("gradient", graph.place_or(node, "generated"), mode=mode)


def affine(graph: GraphReader, place: Value, matrix: Matrix) -> Value:
    rows = tuple(matrix[row][column] for row in range(3) for column in range(4))
    return graph.builder.emit("affine", place, Value(rows))


def _mapping(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    matrix, place = constant_mapping(node), graph.named(node, "Vector")
    if matrix is not None:
        return affine(graph, place, matrix)
    inputs = [graph.named(node, name) for name in ("Location", "Rotation", "Scale")]
    return graph.builder.emit("mapping", place, *inputs, mode=MAPPINGS.index(node.vector_type))


def _coordinates(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    name = source.identifier
    if name == "UV":
        graph.used.add(0)
        return graph.builder.emit("attribute")
    if name == "Generated":
        return graph.builder.emit("generated")
    if name == "Object":
        if node.object is None:
            return graph.builder.emit("object")
        return affine(graph, graph.builder.emit("position"), node.object.matrix_world.inverted_safe())
    if name in ("Normal", "Reflection"):
        return graph.builder.emit(
            "normal", mode=NORMALS.index("object" if name == "Normal" else "reflection")
        )
    graph.warn(f"{describe(graph.owner, node)}: output {name} is not supported, Generated is used")
    return graph.builder.emit("generated")


def _uv_map(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    index = graph.table.attribute("uv", node.uv_map) if node.uv_map else 0
    graph.used.add(index)
    return graph.builder.emit("attribute", mode=index)


def _attribute(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    name = node.layer_name if node.type == "VERTEX_COLOR" else node.attribute_name
    if node.type == "ATTRIBUTE" and node.attribute_type != "GEOMETRY":
        graph.warn(f"{describe(graph.owner, node)}: attributes of objects are not supported, 0 is used")
        return Value((0.0, 0.0, 0.0))
    index = graph.table.attribute("color", name)
    graph.used.add(index)
    values = graph.builder.emit("attribute", mode=index)
    if source.identifier == "Alpha":
        return values.part(3)
    return graph.convert(values, "VECTOR", "VALUE") if source.identifier == "Fac" else values


def _geometry(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    name = source.identifier
    if name == "Position":
        return graph.builder.emit("position")
    if name == "Backfacing":
        return graph.builder.emit("info", mode=INFOS.index("backfacing"))
    normals = {"Normal": "shading", "True Normal": "flat", "Incoming": "incoming"}
    if name in normals:
        return graph.builder.emit("normal", mode=NORMALS.index(normals[name]))
    graph.warn(f"{describe(graph.owner, node)}: output {name} is not supported, 0 is used")
    return Value((0.0, 0.0, 0.0))


def _object_info(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    name = source.identifier.lower()
    if name in INFOS:
        return graph.builder.emit("info", mode=INFOS.index(name))
    graph.warn(f"{describe(graph.owner, node)}: output {source.name} is not supported, 0 is used")
    return Value((0.0, 0.0, 0.0))


def _fresnel(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    return graph.builder.emit("fresnel", graph.named(node, "IOR"), graph.normal_or(node))


def _layer_weight(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    mode = 0 if source.identifier == "Fresnel" else 1
    return graph.builder.emit("layer_weight", graph.named(node, "Blend"), graph.normal_or(node), mode=mode)


def _bump(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    """Heights here and a step away along both tangents."""
    builder, width = graph.builder, graph.named(node, "Filter Width")
    normal, strength, distance = (
        graph.normal_or(node),
        graph.named(node, "Strength"),
        graph.named(node, "Distance"),
    )
    if width.constant is not None:
        width = number(max(width.constant[0], 1e-3))
    heights = [graph.named(node, "Height")]
    if heights[0].constant is not None:
        return normal
    outer = builder.place
    if outer:
        graph.warn(f"{describe(graph.owner, node)}: a bump in the height of a bump is left out")
        return normal
    for place in (1, 2):
        builder.emit("shift", width, mode=place)
        builder.place = place
        heights.append(graph.named(node, "Height"))
    builder.emit("shift", width, mode=0)
    builder.place = 0
    if node.invert:
        distance = graph.math("MULTIPLY", distance, number(-1.0))
    return builder.emit("bump", *heights, strength, distance, normal, width)


def _normal_map(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    tangent = Value((0.0, 0.0, 0.0, 0.0))
    if node.space == "TANGENT":
        index = graph.table.attribute("tangent", node.uv_map)
        graph.used.add(index)
        tangent = graph.builder.emit("attribute", mode=index)
    color = graph.named(node, "Color")
    if getattr(node, "convention", "OPENGL") == "DIRECTX":
        color = graph.builder.emit(
            "copy", color, graph.math("SUBTRACT", number(1.0), color.part(1)), color.part(2)
        )
    return graph.builder.emit(
        "normal_map", color, graph.named(node, "Strength"), tangent, mode=NORMAL_SPACES.index(node.space)
    )


NODE_READERS: dict[str, NodeReader] = {
    **COLOR_READERS,
    "RGB": _constant,
    "VALUE": _constant,
    "TEX_IMAGE": _image,
    "TEX_CHECKER": _checker,
    "TEX_NOISE": _noise,
    "TEX_BRICK": _brick,
    "TEX_WAVE": _wave,
    "TEX_GRADIENT": _gradient,
    "MAPPING": _mapping,
    "TEX_COORD": _coordinates,
    "UVMAP": _uv_map,
    "ATTRIBUTE": _attribute,
    "VERTEX_COLOR": _attribute,
    "NEW_GEOMETRY": _geometry,
    "OBJECT_INFO": _object_info,
    "FRESNEL": _fresnel,
    "LAYER_WEIGHT": _layer_weight,
    "BUMP": _bump,
    "NORMAL_MAP": _normal_map,
}

"""What the nodes that reckon with colours, numbers and vectors become in a program."""

from __future__ import annotations

from collections.abc import Callable

import bpy

from ..program_builder import Value
from ..texture_ops import BLENDS, COLOR_MODELS, RANGES, TABLE_FLAG
from .texture_graph import GraphReader, number

TABLE_ROWS = 256
"""Cycles keeps ramps and curves as tables of this length."""


def _mix(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    kind = {"FLOAT": "Float", "VECTOR": "Vector", "RGBA": "Color"}.get(node.data_type)
    if kind is None:
        graph.warn(f"{graph.owner}: node {node.name!r} (Mix) of rotations is not supported, 0 is used")
        return Value((0.0, 0.0, 0.0))
    uneven = kind == "Vector" and node.factor_mode == "NON_UNIFORM"
    factor = graph.named(node, "Factor_Vector" if uneven else "Factor_Float")
    factor = factor if uneven else graph.spread(factor)
    if node.clamp_factor:
        factor = graph.clamp(factor)
    first, second = graph.named(node, f"A_{kind}"), graph.named(node, f"B_{kind}")
    if kind == "Float":
        first, second = graph.spread(first), graph.spread(second)
    blend = node.blend_type if kind == "Color" else "MIX"
    mixed = graph.builder.emit("blend", factor, first, second, mode=BLENDS.index(blend))
    return graph.clamp(mixed) if kind == "Color" and node.clamp_result else mixed


def _mix_rgb(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    factor = graph.clamp(graph.spread(graph.named(node, "Fac")))
    first, second = graph.named(node, "Color1"), graph.named(node, "Color2")
    mixed = graph.builder.emit("blend", factor, first, second, mode=BLENDS.index(node.blend_type))
    return graph.clamp(mixed) if node.use_clamp else mixed


def _math(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    names = ("Value", "Value_001", "Value_002")
    result = graph.math(node.operation, *(graph.named(node, name) for name in names))
    return graph.clamp(result) if node.use_clamp else result


def _vector_math(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    names = ("Vector", "Vector_001", "Vector_002", "Scale")
    return graph.vector_math(node.operation, *(graph.named(node, name) for name in names))


def _map_range(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    ends = ("From Min", "From Max", "To Min", "To Max", "Steps")
    if node.data_type == "FLOAT":
        inputs = [graph.spread(graph.named(node, name)) for name in ("Value", *ends)]
    else:
        names = [f"{name.replace(' ', '_')}_FLOAT3" for name in ends]
        inputs = [graph.named(node, name) for name in ("Vector", *names)]
    mapped = graph.builder.emit("map_range", *inputs, mode=RANGES.index(node.interpolation_type))
    eased = node.interpolation_type in ("SMOOTHSTEP", "SMOOTHERSTEP")
    return graph.clamp(mapped, inputs[3], inputs[4]) if node.clamp and not eased else mapped


def _ramp(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    ramp = node.color_ramp
    rows = [ramp.evaluate(row / (TABLE_ROWS - 1)) for row in range(TABLE_ROWS)]
    table = Value(tuple(float(value) for row in rows for value in row))
    smooth = ramp.interpolation != "CONSTANT"
    mode = TABLE_ROWS | (TABLE_FLAG if smooth else 0)
    texel = graph.builder.emit("ramp", graph.named(node, "Fac"), table, mode=mode)
    return texel.part(3) if source.identifier == "Alpha" else texel


def _curves(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    """Curves of each channel after the combined one, over the range that they are drawn in."""
    mapping = node.mapping
    mapping.initialize()
    single = node.type == "CURVE_FLOAT"
    curves = list(mapping.curves)
    low = min(curve.points[0].location[0] for curve in curves)
    high = max(curve.points[-1].location[0] for curve in curves)
    rows: list[float] = []
    for row in range(TABLE_ROWS):
        x = low + (high - low) * row / (TABLE_ROWS - 1)
        combined = mapping.evaluate(curves[3], x) if node.type == "CURVE_RGB" else x
        channels = curves[:1] * 3 if single else curves[:3]
        rows += [*(mapping.evaluate(curve, combined) for curve in channels), 0.0]
    value = graph.named(node, {"CURVE_RGB": "Color", "CURVE_VEC": "Vector"}.get(node.type, "Value"))
    value = graph.spread(value) if single else value
    factor = graph.named(node, "Factor" if single else "Fac")
    mode = TABLE_ROWS | (TABLE_FLAG if mapping.extend == "EXTRAPOLATED" else 0)
    return graph.builder.emit(
        "curves", factor, value, Value(tuple(rows)), number(low), number(high), mode=mode
    )


def _hue_saturation(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    hue, saturation, value = (graph.named(node, name) for name in ("Hue", "Saturation", "Value"))
    by = graph.builder.emit("copy", hue, saturation, value)
    return graph.builder.emit("adjust_hsv", graph.named(node, "Color"), by, graph.named(node, "Fac"))


def _simple(op: str, *names: str) -> Callable[[GraphReader, bpy.types.Node, bpy.types.NodeSocket], Value]:
    """A node that is one instruction of its inputs."""

    def read(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
        return graph.builder.emit(op, *(graph.named(node, name) for name in names))

    return read


def _separate(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    channel = list(node.outputs).index(source)
    if node.type == "SEPXYZ":
        return graph.named(node, "Vector").part(channel)
    mode = COLOR_MODELS.index(getattr(node, "mode", "RGB"))
    return graph.builder.emit("separate", graph.named(node, "Color"), mode=mode).part(channel)


def _combine(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    parts = [graph.input(socket) for socket in list(node.inputs)[:3]]
    mode = COLOR_MODELS.index(getattr(node, "mode", "RGB"))
    return graph.builder.emit("combine", *parts, mode=mode)


def _clamp(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    low, high = graph.named(node, "Min"), graph.named(node, "Max")
    if node.clamp_type == "RANGE":
        return graph.clamp(graph.named(node, "Value"), low, high)
    return graph.math("MINIMUM", graph.math("MAXIMUM", graph.named(node, "Value"), low), high)


def _grey(graph: GraphReader, node: bpy.types.Node, source: bpy.types.NodeSocket) -> Value:
    return graph.builder.emit("grey", graph.named(node, "Color"))


COLOR_READERS = {
    "MIX": _mix,
    "MIX_RGB": _mix_rgb,
    "MATH": _math,
    "VECT_MATH": _vector_math,
    "MAP_RANGE": _map_range,
    "VALTORGB": _ramp,
    "CURVE_RGB": _curves,
    "CURVE_VEC": _curves,
    "CURVE_FLOAT": _curves,
    "HUE_SAT": _hue_saturation,
    "BRIGHTCONTRAST": _simple("contrast", "Color", "Bright", "Contrast"),
    "INVERT": _simple("invert", "Color", "Fac"),
    "GAMMA": _simple("gamma", "Color", "Gamma"),
    "SEPARATE_COLOR": _separate,
    "SEPXYZ": _separate,
    "COMBINE_COLOR": _combine,
    "COMBXYZ": _combine,
    "CLAMP": _clamp,
    "RGBTOBW": _grey,
}

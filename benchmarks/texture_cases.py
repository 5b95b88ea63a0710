"""The node graphs that texture_agreement.py compares."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from benchmarks.texture_scene import Build
from trg_blender.engine.texture_ops import BLENDS, GRADIENTS, MATH_OPERATIONS, NOISES, VECTOR_OPERATIONS

Tree, Socket = bpy.types.NodeTree, bpy.types.NodeSocket


@dataclass(frozen=True, slots=True)
class Case:
    build: Build
    span: float = 4.0
    start: float = -1.3


def add(tree: Tree, kind: str, inputs: dict[str, Any], **settings: Any) -> bpy.types.Node:
    """A node with settings, and inputs by identifier: values, or sockets to link."""
    node = tree.nodes.new(f"ShaderNode{kind}")
    for name, value in settings.items():
        setattr(node, name, value)
    for name, value in inputs.items():
        socket = next(each for each in node.inputs if each.identifier == name)
        if isinstance(value, bpy.types.NodeSocket):
            tree.links.new(value, socket)
        else:
            socket.default_value = value
    return node


def turned(tree: Tree, uv: Socket) -> Socket:
    """The coordinates out of their plane."""
    inputs = {
        "Vector": uv,
        "Location": (0.3, 0.2, 0.7),
        "Rotation": (0.5, -0.3, 0.8),
        "Scale": (1.0, 1.2, 1.0),
    }
    return add(tree, "Mapping", inputs).outputs[0]


def texture(kind: str, output: str, inputs: dict[str, Any] | None = None, **settings: Any) -> Build:
    """A procedural at the turned coordinates, or with `flat` at the plain ones."""

    def build(tree: Tree, uv: Socket) -> Socket:
        given = dict(inputs or {})
        vector = uv if given.pop("flat", False) else turned(tree, uv)
        node = add(tree, kind, {"Vector": vector, **given}, **settings)
        return next(each for each in node.outputs if each.identifier == output)

    return build


def image(channels: str = "color", floating: bool = False, place: str = "FLAT", **settings: Any) -> Build:
    """A random image of 8 x 6 texels with alpha; `channels` is the output."""

    def build(tree: Tree, uv: Socket) -> Socket:
        rng = np.random.default_rng(7)
        made = bpy.data.images.new("made", 8, 6, alpha=channels != "opaque", float_buffer=floating)
        pixels = rng.random((6, 8, 4), np.float32)
        if channels == "opaque":
            pixels[..., 3] = 1.0
        made.pixels.foreach_set(pixels.ravel())
        made.update()
        made.pack()
        vector = uv if place == "FLAT" else turned(tree, uv)
        node = add(tree, "TexImage", {"Vector": vector}, image=made, projection=place, **settings)
        if channels != "both":
            return node.outputs["Alpha" if channels == "alpha" else "Color"]
        mixed = add(
            tree, "MixRGB", {"Color1": node.outputs["Color"], "Color2": node.outputs["Alpha"], "Fac": 0.3}
        )
        return mixed.outputs[0]

    return build


def noise_pair(tree: Tree, uv: Socket) -> tuple[Socket, Socket]:
    """Two coloured patterns to reckon with."""
    first = add(tree, "TexNoise", {"Vector": uv, "Scale": 2.0}).outputs["Color"]
    second = add(tree, "TexNoise", {"Vector": turned(tree, uv), "Scale": 3.0}).outputs["Color"]
    return first, second


def mix(blend: str) -> Build:
    def build(tree: Tree, uv: Socket) -> Socket:
        first, second = noise_pair(tree, uv)
        inputs = {"A_Color": first, "B_Color": second, "Factor_Float": 0.7}
        node = add(tree, "Mix", inputs, data_type="RGBA", blend_type=blend)
        return next(each for each in node.outputs if each.identifier == "Result_Color")

    return build


def split(tree: Tree, uv: Socket) -> list[Socket]:
    return list(add(tree, "SeparateXYZ", {"Vector": turned(tree, uv)}).outputs)


def math(operation: str) -> Build:
    def build(tree: Tree, uv: Socket) -> Socket:
        parts = split(tree, uv)
        inputs = {"Value": parts[0], "Value_001": parts[1], "Value_002": parts[2]}
        return add(tree, "Math", inputs, operation=operation).outputs[0]

    return build


def vector_math(operation: str) -> Build:
    def build(tree: Tree, uv: Socket) -> Socket:
        first, second = noise_pair(tree, uv)
        inputs = {"Vector": first, "Vector_001": second, "Vector_002": (0.1, -0.3, 0.2), "Scale": 0.7}
        node = add(tree, "VectorMath", inputs, operation=operation)
        numbers = ("DOT_PRODUCT", "DISTANCE", "LENGTH")
        return node.outputs["Value" if operation in numbers else "Vector"]

    return build


def ramp(interpolation: str) -> Build:
    def build(tree: Tree, uv: Socket) -> Socket:
        node = add(tree, "ValToRGB", {"Fac": split(tree, uv)[0]})
        node.color_ramp.interpolation = interpolation
        node.color_ramp.elements[0].color = (1.0, 0.2, 0.0, 1.0)
        middle = node.color_ramp.elements.new(0.4)
        middle.color = (0.0, 0.3, 1.0, 0.5)
        return node.outputs["Color"]

    return build


def colored(kind: str, inputs: dict[str, Any], **settings: Any) -> Build:
    """A node of one colour input."""

    def build(tree: Tree, uv: Socket) -> Socket:
        color = noise_pair(tree, uv)[0]
        name = "Vector" if kind == "VectorCurve" else "Color"
        node = add(tree, kind, {name: color, **inputs}, **settings)
        if kind.endswith("Curve"):
            node.mapping.curves[0].points.new(0.4, 0.7)
            node.mapping.update()
        return node.outputs[0]

    return build


def mapping(kind: str) -> Build:
    def build(tree: Tree, uv: Socket) -> Socket:
        inputs = {
            "Vector": uv,
            "Location": (0.3, 0.2, 0.1),
            "Rotation": (0.5, -0.3, 0.8),
            "Scale": (2, 0.7, 1.5),
        }
        return add(tree, "Mapping", inputs, vector_type=kind).outputs[0]

    return build


def map_range(kind: str) -> Build:
    def build(tree: Tree, uv: Socket) -> Socket:
        inputs = {
            "Value": split(tree, uv)[0],
            "From Min": -0.5,
            "From Max": 1.5,
            "To Min": 0.2,
            "To Max": 2.0,
        }
        return add(tree, "MapRange", inputs, interpolation_type=kind).outputs[0]

    return build


ROUGH = {"Scale": 2.0, "Detail": 3.5, "Roughness": 0.6, "Lacunarity": 2.3, "Distortion": 0.4, "W": 0.7}
CASES: dict[str, Case] = {
    **{
        f"image {channels} {filtering} {wrap}": Case(
            image(channels, interpolation=filtering, extension=wrap), 3.0, -1.0
        )
        for channels, filtering, wrap in (
            ("opaque", "Closest", "REPEAT"),
            ("opaque", "Linear", "REPEAT"),
            ("opaque", "Cubic", "REPEAT"),
            ("opaque", "Linear", "EXTEND"),
            ("opaque", "Linear", "CLIP"),
            ("opaque", "Cubic", "CLIP"),
            ("opaque", "Linear", "MIRROR"),
            ("opaque", "Cubic", "EXTEND"),
            ("color", "Linear", "REPEAT"),
            ("alpha", "Linear", "REPEAT"),
            ("both", "Linear", "REPEAT"),
        )
    },
    "image float": Case(image("opaque", True), 3.0, -1.0),
    "image float alpha": Case(image("color", True), 3.0, -1.0),
    "image box": Case(image("opaque", place="BOX", projection_blend=0.3)),
    "image sphere": Case(image("opaque", place="SPHERE")),
    "image tube": Case(image("opaque", place="TUBE")),
    "checker": Case(texture("TexChecker", "Color", {"Scale": 2.0})),
    "checker at 1e6": Case(texture("TexChecker", "Color", {"Scale": 1.0, "flat": True}), 96.0, 1e6),
    "brick": Case(texture("TexBrick", "Color", {"Scale": 3.0, "Mortar Smooth": 0.3})),
    "brick fac": Case(texture("TexBrick", "Fac", {"Scale": 3.0, "Bias": 0.2}, squash=1.4)),
    **{
        f"gradient {kind.lower()}": Case(texture("TexGradient", "Fac", gradient_type=kind))
        for kind in GRADIENTS
    },
    **{
        f"wave {kind.lower()} {profile.lower()}": Case(
            texture(
                "TexWave", "Color", {"Distortion": 2.0, "Detail": 2.5}, wave_type=kind, wave_profile=profile
            )
        )
        for kind, profile in (("BANDS", "SIN"), ("BANDS", "SAW"), ("RINGS", "TRI"))
    },
    "wave rings spherical": Case(
        texture("TexWave", "Color", wave_type="RINGS", rings_direction="SPHERICAL", wave_profile="SIN")
    ),
    **{
        f"noise {kind.lower()} {size}": Case(
            texture("TexNoise", "Color", ROUGH, noise_dimensions=size, noise_type=kind)
        )
        for kind, size in [("FBM", f"{n}D") for n in (1, 2, 4)] + [(kind, "3D") for kind in NOISES]
    },
    "noise raw": Case(texture("TexNoise", "Fac", ROUGH, normalize=False)),
    "noise at 1e6": Case(texture("TexNoise", "Color", {"Scale": 1.0, "flat": True}), 96.0, 1e6),
    **{f"mix {blend.lower()}": Case(mix(blend), 2.0) for blend in BLENDS},
    **{f"math {name.lower()}": Case(math(name)) for name in MATH_OPERATIONS},
    **{
        f"vector {name.lower()}": Case(vector_math(name), 2.0)
        for name in (*VECTOR_OPERATIONS, "ADD", "DIVIDE", "SNAP", "FRACTION", "WRAP", "MODULO")
    },
    **{
        f"ramp {kind.lower()}": Case(ramp(kind))
        for kind in ("CONSTANT", "LINEAR", "EASE", "CARDINAL", "B_SPLINE")
    },
    **{f"mapping {kind.lower()}": Case(mapping(kind)) for kind in ("POINT", "TEXTURE", "VECTOR", "NORMAL")},
    **{
        f"range {kind.lower()}": Case(map_range(kind))
        for kind in ("LINEAR", "STEPPED", "SMOOTHSTEP", "SMOOTHERSTEP")
    },
    "hue saturation": Case(
        colored("HueSaturation", {"Hue": 0.7, "Saturation": 1.4, "Value": 0.8, "Fac": 0.9})
    ),
    "bright contrast": Case(colored("BrightContrast", {"Bright": 0.1, "Contrast": 0.6})),
    "invert": Case(colored("Invert", {"Fac": 0.8})),
    "gamma": Case(colored("Gamma", {"Gamma": 2.2})),
    "curves": Case(colored("RGBCurve", {"Fac": 0.9})),
    "vector curves": Case(colored("VectorCurve", {"Fac": 0.9})),
    "separate hsv": Case(colored("SeparateColor", {}, mode="HSV")),
    "separate hsl": Case(colored("SeparateColor", {}, mode="HSL")),
    "rgb to bw": Case(colored("RGBToBW", {})),
}

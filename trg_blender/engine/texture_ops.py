"""The instructions of texture programs: their names, their modes, and the list that a program is.

An instruction takes up to 13 operands and writes up to four numbers. An operand is a register, or below 0
a constant (-1 is number 0); a vector is three in a row. `native/shade/texture_program.h` and
`reference_programs.py` run them.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

TEXTURE_OPS = (
    "attribute", "generated", "object", "position", "normal", "info", "copy", "image", "box", "project",
    "affine", "mapping", "checker", "noise", "brick", "gradient", "wave", "ramp", "curves", "blend", "math",
    "vector_math", "map_range", "adjust_hsv", "contrast", "invert", "gamma", "separate", "combine", "clamp",
    "grey", "fresnel", "layer_weight", "shift", "bump", "normal_map",
)  # fmt: skip
NORMALS = ("shading", "flat", "object", "incoming", "reflection")
INFOS = ("random", "backfacing", "location")
PROJECTIONS = ("sphere", "tube")
MAPPINGS = ("POINT", "TEXTURE", "VECTOR", "NORMAL")
NOISES = ("MULTIFRACTAL", "RIDGED_MULTIFRACTAL", "HYBRID_MULTIFRACTAL", "FBM", "HETERO_TERRAIN")
GRADIENTS = ("LINEAR", "QUADRATIC", "EASING", "DIAGONAL", "SPHERICAL", "QUADRATIC_SPHERE", "RADIAL")
BLENDS = (
    "MIX", "DARKEN", "MULTIPLY", "BURN", "LIGHTEN", "SCREEN", "DODGE", "ADD", "OVERLAY", "SOFT_LIGHT",
    "LINEAR_LIGHT", "DIFFERENCE", "EXCLUSION", "SUBTRACT", "DIVIDE", "HUE", "SATURATION", "COLOR", "VALUE",
)  # fmt: skip
MATH_OPERATIONS = (
    "ADD", "SUBTRACT", "MULTIPLY", "DIVIDE", "MULTIPLY_ADD", "POWER", "LOGARITHM", "SQRT", "INVERSE_SQRT",
    "ABSOLUTE", "EXPONENT", "MINIMUM", "MAXIMUM", "LESS_THAN", "GREATER_THAN", "SIGN", "COMPARE",
    "SMOOTH_MIN", "SMOOTH_MAX", "ROUND", "FLOOR", "CEIL", "TRUNC", "FRACT", "MODULO", "FLOORED_MODULO",
    "WRAP", "SNAP", "PINGPONG", "SINE", "COSINE", "TANGENT", "ARCSINE", "ARCCOSINE", "ARCTANGENT", "ARCTAN2",
    "SINH", "COSH", "TANH", "RADIANS", "DEGREES",
)  # fmt: skip
VECTOR_OPERATIONS = (
    "CROSS_PRODUCT", "PROJECT", "REFLECT", "REFRACT", "FACEFORWARD", "DOT_PRODUCT", "DISTANCE", "LENGTH",
    "SCALE", "NORMALIZE",
)  # fmt: skip
VECTOR_MODES = 64
"""mode of vector_math from which on VECTOR_OPERATIONS count; below it are MATH_OPERATIONS, by channel"""
RANGES = ("LINEAR", "STEPPED", "SMOOTHSTEP", "SMOOTHERSTEP")
COLOR_MODELS = ("RGB", "HSV", "HSL")
NORMAL_SPACES = ("TANGENT", "OBJECT", "WORLD", "BLENDER_OBJECT", "BLENDER_WORLD")

NOISE_KIND_SHIFT, NOISE_NORMALIZE, NOISE_COLORED = 2, 32, 64
WAVE_RINGS, WAVE_PROFILE_SHIFT = 4, 3
TABLE_FLAG = 1 << 16
REGISTERS = 256
OPERANDS = 13


@dataclass(slots=True)
class ProgramArrays:
    """All programs of a scene."""

    ops: NDArray[np.int32] = field(default_factory=lambda: np.zeros((0, 3 + OPERANDS), np.int32))
    """(n, 16) kind, mode, first register written, operands"""
    constants: NDArray[np.float32] = field(default_factory=lambda: np.zeros(0, np.float32))
    programs: NDArray[np.int32] = field(default_factory=lambda: np.zeros((0, 3), np.int32))
    """(p, 3) first instruction, how many, register of the resulting vector"""

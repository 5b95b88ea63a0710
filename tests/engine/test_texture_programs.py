"""Texture programs: the native ones give what numpy gives, instruction by instruction."""

from __future__ import annotations

import numpy as np
import pytest

from trg_blender.engine import session
from trg_blender.engine.program_builder import ProgramBuilder, ProgramPool, ProgramTooLargeError, Value
from trg_blender.engine.reference_programs import Programs
from trg_blender.engine.scene_arrays import (
    Camera,
    InstanceArrays,
    Material,
    MeshArrays,
    RenderSettings,
    SceneArrays,
    Texture,
)
from trg_blender.engine.texture_ops import (
    BLENDS,
    GRADIENTS,
    MATH_OPERATIONS,
    NOISE_COLORED,
    NOISE_KIND_SHIFT,
    NOISE_NORMALIZE,
    NOISES,
    TABLE_FLAG,
    TEXTURE_OPS,
    VECTOR_MODES,
    VECTOR_OPERATIONS,
)

trg_native = pytest.importorskip("trg_native", reason="the native core is not built")

SIDE = 24
UV = np.stack(np.meshgrid(np.arange(SIDE), np.arange(SIDE)), axis=2).reshape(-1, 2) * 0.11 - 1.2


def squares(uv: np.ndarray) -> MeshArrays:
    """One square a pixel of the picture, each with one texture coordinate."""
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(SIDE), np.arange(SIDE)))
    corner = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    places = (np.stack([x, y], axis=1)[:, None] + corner) / SIDE * 2.0 - 1.0
    vertices = np.concatenate([places, np.zeros((*places.shape[:2], 1))], axis=2).reshape(-1, 3)
    first = 4 * np.arange(SIDE * SIDE)[:, None, None]
    triangles = (first + np.array([[0, 1, 2], [0, 2, 3]])).reshape(-1, 3)
    uvs = np.repeat(uv.astype(np.float32), 6, axis=0).reshape(-1, 3, 2)
    return MeshArrays(vertices.astype(np.float32), triangles.astype(np.int32), uvs=uvs)


def native_values(pool: ProgramPool, program: int, uv: np.ndarray = UV) -> np.ndarray:
    """(n, 3) values of the program at `uv`, seen as light."""
    matrix = np.eye(3, 4)
    matrix[2, 3] = 2.0
    scene = SceneArrays(
        Camera(1, matrix, (-1.0, 1.0, -1.0, 1.0)),
        [squares(uv)],
        [InstanceArrays(0, np.eye(3, 4, dtype=np.float32)[None], np.zeros(1, np.int32))],
        [Material(0.0, 0.0, 0.0, specular=0.0, emission_r=1.0, emission_g=1.0, emission_b=1.0)],
        textures=[Texture(-1, program=program)],
        programs=pool.arrays(),
    )
    scene.materials[0].emission_texture = 0
    settings = RenderSettings(SIDE, SIDE, samples=8, max_bounces=0, threads=1)
    return session.render(scene, settings).pixels[..., :3].reshape(-1, 3).astype(np.float64)


def numpy_values(pool: ProgramPool, program: int, uv: np.ndarray = UV) -> np.ndarray:
    exact = uv.astype(np.float32).astype(np.float64)
    place = np.column_stack([exact, np.zeros(len(uv)), np.ones(len(uv))])
    return Programs(pool.arrays()).run(program, len(uv), {"attribute": lambda operands: place})


def build(op: str, mode: int) -> tuple[ProgramPool, int]:
    """A program of one instruction whose operands vary from point to point."""
    builder, rows = ProgramBuilder(), 16
    uv = builder.emit("attribute")
    rng = np.random.default_rng(3)
    operands = []
    for k in range(11):
        numbers = tuple(float(x) for x in rng.uniform(-1.0, 1.0, 12).astype(np.float32))
        operands.append(builder.emit("affine", uv, Value(numbers)) if k < 5 else Value((0.4 + 0.1 * k,) * 3))
    table = Value(tuple(float(x) for x in rng.random(4 * rows).astype(np.float32)))
    if op == "affine":
        operands[1] = Value(tuple(float(k) for k in range(12)))
    if op in ("ramp", "curves"):
        operands[1 if op == "ramp" else 2], mode = table, rows | TABLE_FLAG
    if op == "curves":
        operands[3:5] = [Value((-0.5,)), Value((0.8,))]
    if op == "brick":
        operands[4:11] = [Value((x,)) for x in (2.0, 0.1, 0.3, 0.1, 0.5, 0.25)] + [
            Value((0.5, 1.3, 2.0, 3.0))
        ]
        operands[10] = Value((0.5, 1.3, 2.0, 3.0))
    result = builder.emit(op, *operands, mode=mode)
    if op == "math":
        result = builder.emit("copy", result, result, result)
    pool = ProgramPool()
    return pool, pool.add(builder.steps, result)


NOISE = NOISE_COLORED | NOISE_NORMALIZE
CASES = [
    *(("math", k) for k in range(len(MATH_OPERATIONS))),
    *(("vector_math", VECTOR_MODES + k) for k in range(len(VECTOR_OPERATIONS))),
    *(("vector_math", MATH_OPERATIONS.index(name)) for name in ("ADD", "DIVIDE", "MODULO", "POWER")),
    *(("blend", k) for k in range(len(BLENDS))),
    *(("noise", size | NOISES.index("FBM") << NOISE_KIND_SHIFT | NOISE) for size in range(4)),
    *(("noise", 2 | kind << NOISE_KIND_SHIFT | NOISE_COLORED) for kind in range(len(NOISES))),
    *(("gradient", k) for k in range(len(GRADIENTS))),
    *(("wave", k) for k in (0, 3, 4, 7, 8 + 1, 16 + 6)),
    *((op, mode) for op in ("separate", "combine") for mode in range(3)),
    *(("map_range", k) for k in range(4)),
    *(("mapping", k) for k in range(4)),
    *(("project", k) for k in range(2)),
    *((op, 0) for op in ("copy", "affine", "checker", "brick", "ramp", "curves", "adjust_hsv", "contrast")),
    *((op, 0) for op in ("invert", "gamma", "clamp", "grey")),
]


@pytest.mark.parametrize("op, mode", CASES)
def test_native_gives_what_numpy_gives(op: str, mode: int) -> None:
    pool, program = build(op, mode)
    ours, expected = native_values(pool, program), numpy_values(pool, program)
    assert np.isfinite(ours).all()
    error = np.abs(ours - expected) / np.maximum(np.abs(expected), 1.0)
    # Steps and steep slopes fall to either side by rounding; nowhere else may the two part.
    assert (error.max(axis=1) > 1e-4).mean() <= 0.02


def test_both_sides_name_the_same_instructions() -> None:
    assert trg_native.TEXTURE_OPS == TEXTURE_OPS


def test_what_is_not_finite_becomes_nothing() -> None:
    builder = ProgramBuilder()
    uv = builder.emit("attribute")
    big = builder.emit("vector_math", uv, Value((3e38,) * 3), mode=MATH_OPERATIONS.index("MULTIPLY"))
    result = builder.emit("vector_math", big, big, mode=MATH_OPERATIONS.index("MULTIPLY"))
    pool = ProgramPool()
    values = native_values(pool, pool.add(builder.steps, result))
    assert np.isfinite(values).all()
    assert (values == 0.0).any()


@pytest.mark.parametrize("start", [1e6, -1e6])
def test_checkers_keep_their_period_a_million_away(start: float) -> None:
    """Row B14."""
    builder = ProgramBuilder()
    uv = builder.emit("attribute")
    white, black = Value((1.0, 1.0, 1.0)), Value((0.0, 0.0, 0.0))
    pool = ProgramPool()
    program = pool.add(builder.steps, builder.emit("checker", uv, white, black, Value((1.0,))))
    whole = np.stack(np.meshgrid(np.arange(SIDE), np.arange(SIDE)), axis=2).reshape(-1, 2)
    far = native_values(pool, program, whole + start + 2.5)
    near = native_values(pool, program, whole + 0.5)
    # Cycles shrinks coordinates by a millionth, that is by one cube out there.
    moved = native_values(pool, program, whole + np.array([1.5, 1.5]))
    assert np.array_equal(far, near) or np.array_equal(far, moved)


def test_noise_does_not_flatten_a_million_away() -> None:
    """Row B14: coordinates are a sixteenth apart there, and the noise differs between them."""
    builder = ProgramBuilder()
    uv = builder.emit("attribute")
    numbers = (0.0, 1.0, 0.0, 0.5, 2.0, 0.0, 1.0, 0.0)
    mode = 2 | NOISES.index("FBM") << NOISE_KIND_SHIFT | NOISE_NORMALIZE
    result = builder.emit("noise", uv, *(Value((x,)) for x in numbers), mode=mode)
    pool = ProgramPool()
    program = pool.add(builder.steps, result)
    steps = np.stack(np.meshgrid(np.arange(SIDE), np.arange(SIDE)), axis=2).reshape(-1, 2) / 16.0
    far = native_values(pool, program, steps + 1e6)
    assert far.std() > 0.5 * native_values(pool, program, steps + 40.0).std() > 0.0


def test_constants_are_worked_out_at_once() -> None:
    builder = ProgramBuilder()
    result = builder.emit("math", Value((2.0,)), Value((3.0,)), mode=MATH_OPERATIONS.index("MULTIPLY"))
    assert result.constant == (6.0,) and not builder.steps


def test_registers_are_shared_and_run_out_with_an_error() -> None:
    builder = ProgramBuilder()
    value = builder.emit("attribute")
    for k in range(300):
        value = builder.emit("math", value, Value((float(k),)))
    pool = ProgramPool()
    pool.add(builder.steps, value)
    many = [
        builder.emit("gradient", builder.emit("affine", value, Value((float(k),) * 12))) for k in range(80)
    ]
    total = many[0]
    for each in many[1:]:
        total = builder.emit("math", total, each)
    with pytest.raises(ProgramTooLargeError):
        pool.add(builder.steps, total)


@pytest.mark.parametrize("column, value", [(0, 99), (1, -1), (2, 255), (3, 300), (3, -10_000)])
def test_an_impossible_instruction_is_refused(column: int, value: int) -> None:
    pool, _ = build("math", 0)
    arrays = pool.arrays()
    arrays.ops[0, column] = value
    with pytest.raises(ValueError, match="programs: instruction 0"):
        trg_native.Scene().set_programs(arrays.ops, arrays.constants, arrays.programs)

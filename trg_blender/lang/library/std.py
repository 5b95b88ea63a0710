"""`std::` - render modes, the clock, the random seed, limits."""

from __future__ import annotations

from dataclasses import replace

from ..bind import HOST
from ..limits import MAX_CALL_DEPTH, MAX_OPERATOR_DEPTH
from ..runtime import Runtime
from .mth import Pcg32

DEVICES = ("cpu", "cuda", "glsl", "dxr", "embree")
ACCELS = ("auto", "bvh", "grid", "grid2", "tree", "none")
ANTIALIASINGS = ("none", "supersampling", "jittering", "mfaa")


def _known(rt: Runtime, what: str, name: str, names: tuple[str, ...]) -> str | None:
    if name.lower() in names:
        return name.lower()
    site = rt.site()
    if site is not None:
        rt.warn("W703", site.span, what=what, name=name[:40])
    return None


@HOST.function("std::setrndmode", "device: str", "Ask for cpu, cuda, glsl, dxr or embree.")
def _setrndmode(rt: Runtime, device: str) -> object:
    rt.modes = replace(rt.modes, device=_known(rt, "device", device, DEVICES))
    return rt.undef


@HOST.function("std::setaccel", "accel: str", "Ask for auto, bvh, grid, grid2, tree or none.")
def _setaccel(rt: Runtime, accel: str) -> object:
    rt.modes = replace(rt.modes, accel=_known(rt, "acceleration", accel, ACCELS))
    return rt.undef


@HOST.function(
    "std::setaa", "kind: str, n: num 1..4096 = 1",
    "Ask for none, supersampling, jittering or mfaa, on n x n cells of a pixel.",
)  # fmt: skip
def _setaa(rt: Runtime, kind: str, n: float) -> object:
    known = _known(rt, "antialiasing", kind, ANTIALIASINGS)
    rt.modes = replace(rt.modes, antialiasing=known, antialiasing_n=int(n))
    return rt.undef


@HOST.function("std::frame", "", "The number of the frame being built; the first is 1.", "num")
def _frame(rt: Runtime) -> object:
    return float(rt.frame + 1)


@HOST.function("std::frames", "", "How many frames the host takes.", "num")
def _frames(rt: Runtime) -> object:
    return float(rt.options.frames)


@HOST.function("std::fps", "", "Frames per second.", "num")
def _fps(rt: Runtime) -> object:
    return float(rt.options.fps)


@HOST.function("std::time", "", "std::frame() / std::fps(), in seconds.", "num")
def _time(rt: Runtime) -> object:
    return (rt.frame + 1) / rt.options.fps


@HOST.function("std::seed", "n: num 0..9007199254740992", "Start the random numbers anew.")
def _seed(rt: Runtime, n: float) -> object:
    rt.random = Pcg32(int(n))
    return rt.undef


@HOST.function("std::limits", "", "Print the limits of a program.")
def _limits(rt: Runtime) -> object:
    limits = rt.limits
    rt.write_line(f"steps in a frame: {limits.max_steps}")
    rt.write_line(f"seconds in a frame: {limits.max_seconds:g}")
    rt.write_line(f"depth of calls: {MAX_CALL_DEPTH}, of operators: {MAX_OPERATOR_DEPTH}")
    rt.write_line(f"characters of a string: {limits.max_string}")
    rt.write_line(f"megabytes of all strings: {limits.max_text_bytes // 1048576}")
    rt.write_line(f"elements of all lists: {limits.max_elements}")
    rt.write_line(f"memory blocks: {limits.max_blocks}")
    rt.write_line(f"shapes and lights: {limits.max_shapes}")
    rt.write_line(f"lines of output: {limits.output_lines_frame} in a frame, {limits.output_lines}")
    return rt.undef

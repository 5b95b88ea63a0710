"""What a render costs before its first ray: TRG beside Cycles, in one process, taking turns.

    .venv/3.13/bin/python benchmarks/f12_overhead.py [--rounds 9] [--json FILE]

Method. Both engines render the same scene at 16 x 16 pixels with one sample, no bounce, no denoiser,
no compositor, on the CPU with all threads. 256 camera rays take well under a millisecond, so the wall time
of the render call is, for both alike, what comes before the first ray (evaluating, reading the scene,
building the acceleration structure, starting threads) and what comes after the last (handing the
result over). Rounds alternate the engines, so that a machine that slows down slows both. The first
round, which loads code, is reported apart and not counted. Persistent data is off: every round reads
the scene anew.

Scenes: Blender's default cube; a wavy grid of one million triangles.
"""

from __future__ import annotations

import argparse
import json
import statistics
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks.engines import enable_engines  # noqa: E402
from trg_blender.ui import registration  # noqa: E402

ENGINES = ("TRG", "CYCLES")
GRID_SIDE = 708


@dataclass(frozen=True, slots=True)
class Timing:
    """Milliseconds of the render call of one engine on one scene, without the first round."""

    scene: str
    engine: str
    first_ms: float
    median_ms: float
    lowest_ms: float
    highest_ms: float
    rounds: int


def prepare(scene: bpy.types.Scene) -> None:
    """Sets what both engines share, and Cycles to the same work."""
    scene.render.resolution_x = scene.render.resolution_y = 16
    scene.render.resolution_percentage = 100
    scene.render.use_compositing = scene.render.use_sequencer = False
    scene.trg.samples = 1
    scene.trg.max_bounces = 0
    scene.cycles.samples = 1
    scene.cycles.max_bounces = 0
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.cycles.device = "CPU"


def load_cube() -> bpy.types.Scene:
    """Blender's default scene."""
    bpy.ops.wm.read_homefile(use_empty=False, use_factory_startup=True)
    enable_engines()
    return bpy.context.scene


def load_grid() -> bpy.types.Scene:
    """The default camera and light over a wavy grid of 999 698 triangles."""
    scene = load_cube()
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    x, y = np.meshgrid(
        np.linspace(-3, 3, GRID_SIDE, dtype=np.float32), np.linspace(-3, 3, GRID_SIDE, dtype=np.float32)
    )
    vertices = np.stack([x, y, 0.2 * np.sin(3 * x) * np.cos(2 * y)], axis=-1).reshape(-1, 3)
    index = np.arange(GRID_SIDE * GRID_SIDE, dtype=np.int32).reshape(GRID_SIDE, GRID_SIDE)
    low, right, up, far = index[:-1, :-1], index[:-1, 1:], index[1:, :-1], index[1:, 1:]
    triangles = np.stack([low, right, far, low, far, up], axis=-1).reshape(-1, 3)
    mesh = bpy.data.meshes.new("grid")
    mesh.vertices.add(len(vertices))
    mesh.vertices.foreach_set("co", vertices.ravel())
    mesh.loops.add(triangles.size)
    mesh.loops.foreach_set("vertex_index", triangles.ravel())
    mesh.polygons.add(len(triangles))
    mesh.polygons.foreach_set("loop_start", np.arange(0, triangles.size, 3, dtype=np.int32))
    mesh.update(calc_edges=True)
    scene.collection.objects.link(bpy.data.objects.new("grid", mesh))
    return scene


def time_render(scene: bpy.types.Scene, engine: str) -> float:
    """Milliseconds of one render call."""
    scene.render.engine = engine
    start = time.perf_counter()
    bpy.ops.render.render(write_still=False)
    return (time.perf_counter() - start) * 1000.0


def measure(name: str, scene: bpy.types.Scene, rounds: int) -> list[Timing]:
    """Times both engines in turns."""
    prepare(scene)
    times: dict[str, list[float]] = {engine: [] for engine in ENGINES}
    for round_index in range(rounds + 1):
        order = ENGINES if round_index % 2 == 0 else tuple(reversed(ENGINES))
        for engine in order:
            times[engine].append(time_render(scene, engine))
    return [
        Timing(name, engine, first, statistics.median(rest), min(rest), max(rest), rounds)
        for engine, (first, *rest) in times.items()
    ]


def main() -> int:
    """Measures, prints a line for each engine and scene, and writes JSON when asked."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    timings: list[Timing] = []
    for name, load in (("default cube", load_cube), ("1M triangles", load_grid)):
        timings += measure(name, load(), arguments.rounds)
    print(
        f"Blender {bpy.app.version_string}; ms of a 16x16 render, one sample, {arguments.rounds} rounds"
    )
    print(f"{'scene':<14}{'engine':<8}{'median':>9}{'lowest':>9}{'highest':>9}{'first':>9}")
    for timing in timings:
        print(
            f"{timing.scene:<14}{timing.engine:<8}{timing.median_ms:>9.1f}{timing.lowest_ms:>9.1f}"
            f"{timing.highest_ms:>9.1f}{timing.first_ms:>9.1f}"
        )
    if arguments.json:
        arguments.json.write_text(
            json.dumps([asdict(timing) for timing in timings], indent=1), encoding="utf-8"
        )
    registration.unregister()
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""What a render costs before its first ray: TRG beside Cycles, in one process, taking turns.

    .venv/3.13/bin/python benchmarks/f12_overhead.py [--rounds 9] [--scenes cube,grid] [--json FILE]

Method. Both engines render the same scene at 16 x 16 pixels with one sample, no bounce, no denoiser,
no compositor, on the CPU with all threads. 256 camera rays take well under a millisecond, so the wall time
of the render call is, for both alike, what comes before the first ray (evaluating, reading the scene,
building the acceleration structure, starting threads) and what comes after the last (handing the
result over). Rounds alternate the engines, so that a machine that slows down slows both. The first
round, which loads code, is reported apart and not counted. Persistent data is off: every round reads
the scene anew. A third engine takes its turn that does nothing at all: what a render costs Blender
itself, evaluation included. `own` is an engine's median less that one's.

Memory is measured in processes of their own, one for each engine and scene: the growth of the peak resident
size by one render, again less that of the engine that does nothing.

Scenes: Blender's default cube; a wavy grid of one million triangles; 10^4 linked cubes; 10^5 instances of
a ball by geometry nodes.
"""

from __future__ import annotations

import argparse
import json
import resource
import statistics
import subprocess
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks.engines import enable_engines  # noqa: E402
from trg_blender.engine.to_blender import instancers  # noqa: E402
from trg_blender.engine.to_blender.transforms import Decomposition  # noqa: E402
from trg_blender.ui import registration  # noqa: E402

ENGINES = ("TRG", "CYCLES", "TRG_NOTHING")
GRID_SIDE = 708


class Nothing(bpy.types.RenderEngine):
    """Renders nothing: Blender's own part of a render call."""

    bl_idname = "TRG_NOTHING"
    bl_label = "Nothing"

    def render(self, _depsgraph: bpy.types.Depsgraph) -> None:
        """Leaves the picture empty."""
        result = self.begin_result(0, 0, self.resolution_x, self.resolution_y)
        self.end_result(result)


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
    own_ms: float = 0.0
    """the median less that of the engine that does nothing"""


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


def load_objects() -> bpy.types.Scene:
    """10^4 cubes that share a mesh, each an object."""
    scene = load_cube()
    cube = bpy.data.objects["Cube"].data
    collection = bpy.data.collections.new("cubes")
    for number in range(10_000):
        each = bpy.data.objects.new("cube", cube)
        each.location = (3.0 * (number % 100), 3.0 * (number // 100), 0.0)
        collection.objects.link(each)
    scene.collection.children.link(collection)
    return scene


def load_instances() -> bpy.types.Scene:
    """10^5 copies of a ball of 320 triangles on the points of one object."""
    scene = load_cube()
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3)
    ball = bpy.context.object
    rng = np.random.default_rng(7)
    turns = rng.normal(size=(100_000, 4))
    turns /= np.linalg.norm(turns, axis=1, keepdims=True)
    exact = np.ones(100_000, bool)
    places, sizes = rng.uniform(-50, 50, (100_000, 3)), rng.uniform(0.1, 0.3, (100_000, 3))
    poses = Decomposition(places, turns, sizes, exact)
    points = bpy.data.meshes.new("points")
    instancers.write_points(points, poses)
    holder = bpy.data.objects.new("points", points)
    scene.collection.objects.link(holder)
    instancers.attach_source(holder, ball, "benchmark")
    for collection in ball.users_collection:
        collection.objects.unlink(ball)
    return scene


SCENES = {"cube": load_cube, "grid": load_grid, "objects": load_objects, "instances": load_instances}


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
        turn = round_index % len(ENGINES)
        order = ENGINES[turn:] + ENGINES[:turn]
        for engine in order:
            times[engine].append(time_render(scene, engine))
    nothing = statistics.median(times["TRG_NOTHING"][1:])
    found = []
    for engine, (first, *rest) in times.items():
        middle = statistics.median(rest)
        found.append(Timing(name, engine, first, middle, min(rest), max(rest), rounds, middle - nothing))
    return found


def peak_megabytes() -> float:
    """Peak resident size of this process."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def grow_by_render(name: str, engine: str) -> float:
    """Megabytes by which one render lets this process grow."""
    scene = SCENES[name]()
    prepare(scene)
    bpy.context.evaluated_depsgraph_get()
    before = peak_megabytes()
    time_render(scene, engine)
    return peak_megabytes() - before


def measure_memory(name: str) -> dict[str, float]:
    """Growth in megabytes by engine, each in a fresh process."""
    found = {}
    for engine in ENGINES:
        command = [sys.executable, __file__, "--child", name, engine]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        found[engine] = float(done.stdout.strip().splitlines()[-1].partition("grew ")[2])
    return found


def print_timings(timings: list[Timing], rounds: int) -> None:
    print(f"Blender {bpy.app.version_string}; ms of a 16x16 render, one sample, {rounds} rounds")
    print(f"{'scene':<11}{'engine':<13}{'own':>9}{'median':>9}{'lowest':>9}{'highest':>9}{'first':>9}")
    for timing in timings:
        print(
            f"{timing.scene:<11}{timing.engine:<13}{timing.own_ms:>9.1f}{timing.median_ms:>9.1f}"
            f"{timing.lowest_ms:>9.1f}{timing.highest_ms:>9.1f}{timing.first_ms:>9.1f}"
        )


def main() -> int:
    """Measures, prints a line for each engine and scene, and writes JSON when asked."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--scenes", default=",".join(SCENES), help="names, parted by commas")
    parser.add_argument("--no-memory", action="store_true")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--child", nargs=2, metavar=("SCENE", "ENGINE"), help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    bpy.utils.register_class(Nothing)
    if arguments.child:
        print(f"grew {grow_by_render(*arguments.child)}")
        return 0
    timings: list[Timing] = []
    memory: dict[str, dict[str, float]] = {}
    for name in arguments.scenes.split(","):
        timings += measure(name, SCENES[name](), arguments.rounds)
        if not arguments.no_memory:
            memory[name] = measure_memory(name)
    print_timings(timings, arguments.rounds)
    for name, grown in memory.items():
        base = grown["TRG_NOTHING"]
        own = {engine: value - base for engine, value in grown.items()}
        print(f"{name:<11}MB grown by a render: TRG {own['TRG']:.0f}, Cycles {own['CYCLES']:.0f}")
    if arguments.json:
        rows = [asdict(timing) for timing in timings]
        arguments.json.write_text(json.dumps({"timings": rows, "memory": memory}, indent=1), encoding="utf-8")
    bpy.utils.unregister_class(Nothing)
    registration.unregister()
    return 0


if __name__ == "__main__":
    sys.exit(main())

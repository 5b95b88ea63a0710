"""How building and tracing grow: with triangles, with instances, with threads; the paper's figure.

Usage: python -m benchmarks.scaling [triangles | instances | paper | build ...] [--rounds N]
       [--most N] [--cache FOLDER]

Times are of the clock on the wall, because the idle threads of Embree's task system use processor
time too. Every round runs each side once; figures are medians over the rounds, with the least and
the most in brackets. Scenes that `../shared` does not hold are left out, and said to be.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from .embree_c import WAYS, Embree, EmbreeScene
from .ray_scenes import ROOT, SCENES, Mesh, Rays, Results, empty_results, ray_sets, read_scene

RAYS = 1 << 17
KINDS = ("primary", "diffuse1", "diffuse2", "shadow2")
INSTANCES = 1_000_000
PAPER_SCENE, PAPER_RAYS = "flake12k", 1 << 12


@dataclass(frozen=True)
class Spread:
    median: float
    least: float
    most: float

    def __str__(self) -> str:
        return f"{self.median:.3g} [{self.least:.3g}, {self.most:.3g}]"


def spread_of(values: list[float]) -> Spread:
    return Spread(float(np.median(values)), min(values), max(values))


def seconds_of(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def wavy_torus(triangles: int) -> Mesh:
    """About so many triangles on a torus with waves of a fixed size, seen from above."""
    rows = max(4, round((triangles / 8) ** 0.5))
    u, v = np.meshgrid(np.arange(4 * rows) / (4 * rows), np.arange(rows) / rows, indexing="ij")
    u, v = 2 * np.pi * u, 2 * np.pi * v
    radius = 0.4 + 0.03 * np.sin(24 * u) * np.sin(8 * v)
    ring = 1 + radius * np.cos(v)
    points = np.stack([ring * np.cos(u), ring * np.sin(u), radius * np.sin(v)], -1).reshape(-1, 3)
    index = np.arange(4 * rows * rows).reshape(4 * rows, rows)
    right, above = np.roll(index, -1, 0), np.roll(index, -1, 1)
    corner = np.roll(right, -1, 1)
    quads = np.stack([index, right, corner, index, corner, above], -1).reshape(-1, 3)
    camera = np.array([0.0, -2.6, 2.2, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 45.0])
    light = np.array([2.0, -1.0, 4.0, 0.3])
    return Mesh(points.astype(np.float32), quads.astype(np.int32), camera, light)


def native_scene(mesh: Mesh, accel: str = "bvh") -> Any:
    """Our scene of one mesh, not built."""
    import trg_native

    scene = trg_native.Scene(accel=accel)
    scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles, None, None, None), None, None)
    return scene


def trace_native(scene: Any, rays: Rays, results: Results, threads: int = 1) -> None:
    ranges = (rays.origins, rays.directions, rays.t_min, rays.t_max)
    r = results
    if rays.shadow:
        scene.occluded(*ranges, r.hidden, threads)
    else:
        scene.intersect(*ranges, r.t, r.u, r.v, r.triangle, r.instance, threads)


def rays_of(mesh: Mesh, scene: Any, count: int) -> dict[str, Rays]:
    def nearest(rays: Rays) -> Results:
        results = empty_results(len(rays.origins))
        trace_native(scene, rays, results)
        return results

    return {rays.name: rays for rays in ray_sets(mesh, count, nearest)}


def report_triangles(arguments: argparse.Namespace) -> None:
    """Nanoseconds a ray on one thread, ours and Embree's (robust), from 10^3 triangles on."""
    embree = Embree(arguments.cache)
    robust = next(way for way in WAYS if way.name == "robust")
    say("\ntrace cost, ns a ray, one thread: ours / Embree robust, ratio Embree / ours")
    count = 1000
    while count <= arguments.most:
        mesh = wavy_torus(count)
        scene, peer = native_scene(mesh), EmbreeScene(embree, mesh, robust, 1)
        scene.build(1)
        cells = []
        for kind, rays in rays_of(mesh, scene, RAYS).items():
            if kind not in KINDS:
                continue
            results, times = empty_results(len(rays.origins)), []
            for _ in range(arguments.rounds + 1):
                ours = seconds_of(partial(trace_native, scene, rays, results))
                theirs = seconds_of(partial(peer.trace, rays, results, robust, 1))
                times.append((ours, theirs))
            ours_ns, theirs_ns = np.median(times[1:], axis=0) * 1e9 / len(rays.origins)
            ratio = spread_of([theirs / ours for ours, theirs in times[1:]])
            cells.append(f"{kind} {ours_ns:.0f} / {theirs_ns:.0f}, {ratio}")
        peer.close()
        say(f"  {len(mesh.triangles):9}  " + "; ".join(cells))
        count *= 10


def status_mb(key: str) -> float:
    """A line of this process's status, in MB: VmRSS now, VmHWM the most so far. Linux only."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(key + ":"):
            return int(line.split()[1]) / 1024
    raise KeyError(key)


def build_instances(threads: int) -> dict[str, float]:
    """Builds INSTANCES turned copies of one mesh in this process; its time and memory."""
    import trg_native

    mesh = wavy_torus(20_000)
    rng = np.random.default_rng(0)
    turns, _ = np.linalg.qr(rng.normal(size=(INSTANCES, 3, 3)))
    places = np.concatenate([turns, rng.uniform(-200, 200, (INSTANCES, 3, 1))], -1).astype(np.float32)
    scene = trg_native.Scene(accel="bvh")
    scene.add_instances(scene.add_mesh(mesh.vertices, mesh.triangles, None, None, None), places, None)
    del turns, places
    before = status_mb("VmRSS")
    Path("/proc/self/clear_refs").write_text("5")
    seconds = seconds_of(partial(scene.build, threads))
    return {"seconds": seconds, "peak": status_mb("VmHWM") - before, "kept": status_mb("VmRSS") - before}


def report_instances(arguments: argparse.Namespace) -> None:
    """Each round is a process of its own, so that peaks are its own."""
    say(f"\n{INSTANCES} instances of one mesh, in a fresh process each round")
    for threads in (1, 0):
        found = []
        for _ in range(arguments.rounds):
            command = [sys.executable, "-m", "benchmarks.scaling", "--instances-child", str(threads)]
            run = subprocess.run(command, check=True, capture_output=True, cwd=ROOT)
            found.append(json.loads(run.stdout))
        time_s, peak, kept = (spread_of([f[key] for f in found]) for key in ("seconds", "peak", "kept"))
        say(f"  {thread_words(threads)}: {time_s} s, peak +{peak} MB, kept +{kept} MB")


def report_paper(arguments: argparse.Namespace) -> None:
    """The paper's comparison on a scene of its size: every triangle tried, its tree, our bvh."""
    mesh = read_scene(PAPER_SCENE, arguments.cache)
    scenes = {accel: native_scene(mesh, accel) for accel in ("none", "tree", "bvh")}
    for scene in scenes.values():
        scene.build(1)
    say(f"\n{PAPER_SCENE}, {len(mesh.triangles)} triangles: none over tree, none over bvh, tree over bvh")
    for kind, rays in rays_of(mesh, scenes["bvh"], PAPER_RAYS).items():
        results, times = empty_results(len(rays.origins)), []
        for _ in range(arguments.rounds + 1):
            traces = [partial(trace_native, scene, rays, results) for scene in scenes.values()]
            times.append([seconds_of(trace) for trace in traces])
        pairs = ((0, 1), (0, 2), (1, 2))
        say(f"  {kind:9}" + "  ".join(str(spread_of([t[a] / t[b] for t in times[1:]])) for a, b in pairs))


def report_build(arguments: argparse.Namespace) -> None:
    """Build time over Embree medium's, one thread and all."""
    embree = Embree(arguments.cache)
    medium = next(way for way in WAYS if way.name == "medium")
    for threads in (1, 0):
        say(f"\nbuild, {thread_words(threads)}: ours s, Embree medium s, ours / Embree, bytes a triangle")
        medians = []
        for name in SCENES:
            try:
                mesh = read_scene(name, arguments.cache)
            except FileNotFoundError as error:
                say(f"  {name}: left out, {error}")
                continue
            ours, theirs, size = [], [], 0
            for _ in range(arguments.rounds):
                scene = native_scene(mesh)
                start = time.perf_counter()
                size = scene.build(threads)["bytes"]
                ours.append(time.perf_counter() - start)
                peer = EmbreeScene(embree, mesh, medium, threads or os.cpu_count() or 1)
                theirs.append(peer.wall_seconds)
                peer.close()
            ratio = spread_of([a / b for a, b in zip(ours, theirs, strict=True)])
            medians.append(ratio.median)
            per_triangle = size / len(mesh.triangles)
            say(f"  {name:9} {np.median(ours):.4f} {np.median(theirs):.4f}  {ratio}  {per_triangle:.1f}")
        if medians:
            say(f"  geometric mean {np.exp(np.mean(np.log(medians))):.2f}")


def thread_words(threads: int) -> str:
    return "one thread" if threads == 1 else f"all {os.cpu_count()} threads"


def say(line: str) -> None:
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


REPORTS = {
    "triangles": report_triangles,
    "instances": report_instances,
    "paper": report_paper,
    "build": report_build,
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("parts", nargs="*", default=list(REPORTS), metavar="PART", help=", ".join(REPORTS))
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--most", type=int, default=10_000_000, help="triangles of the largest scene")
    parser.add_argument("--cache", type=Path, default=ROOT / "build/benchmarks")
    parser.add_argument("--instances-child", type=int, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.instances_child is not None:
        say(json.dumps(build_instances(arguments.instances_child)))
        return
    for part in arguments.parts:
        REPORTS[part](arguments)


if __name__ == "__main__":
    main()

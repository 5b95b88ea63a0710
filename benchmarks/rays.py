"""Rays per second of the native core against Embree, through its C API and through embreex.

Usage: python -m benchmarks.rays [SCENE | MODEL.g3dm ...] [--rays N] [--rounds N] [--accel NAME ...]
       [--threads N] [--cache FOLDER] [--json FILE]

Every round traces the same rays once with each tracer, so that a busy machine slows all. Speeds are
the best round's, in rays per second of processor time (not of the clock on the wall); ratios are
medians over the rounds.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .embree_c import WAYS, Embree, EmbreeScene
from .ray_scenes import ROOT, SCENES, Mesh, Rays, Results, empty_results, ray_sets, read_g3dm, read_scene

Trace = Callable[[Rays, Results], None]
BUILD_ROUNDS = 3


@dataclass(frozen=True)
class Built:
    seconds: float
    """processor seconds, best of BUILD_ROUNDS"""
    bytes: int
    note: str = ""


@dataclass(frozen=True)
class Tracer:
    name: str
    trace: Trace
    shadows: bool = True
    """whether it knows any-hit queries"""


def native_tracer(mesh: Mesh, accel: str, threads: int) -> tuple[Tracer, Built]:
    """Our own core, with arrays that are there already."""
    import trg_native

    best = Built(np.inf, 0)
    for _ in range(BUILD_ROUNDS):
        scene = trg_native.Scene(accel=accel, triangle_test="watertight")
        scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles, None, None, None), None, None)
        start = time.process_time()
        stats = scene.build(threads)
        best = min(
            best, Built(time.process_time() - start, stats["bytes"], stats["accel"]), key=lambda b: b.seconds
        )

    def trace(rays: Rays, results: Results) -> None:
        ranges = (rays.origins, rays.directions, rays.t_min, rays.t_max)
        if rays.shadow:
            scene.occluded(*ranges, results.hidden, threads)
        else:
            r = results
            scene.intersect(*ranges, r.t, r.u, r.v, r.triangle, r.instance, threads)

    return Tracer(f"trg {accel}", trace), best


def embree_tracers(mesh: Mesh, embree: Embree, threads: int) -> tuple[list[Tracer], dict[str, Built]]:
    """Embree in all WAYS; ways of the same tree share it."""
    scenes: dict[tuple[str, bool], EmbreeScene] = {}
    built: dict[str, Built] = {}
    tracers = []
    for way in WAYS:
        key = (way.quality, way.robust)
        if key not in scenes:
            seconds = []
            for _ in range(BUILD_ROUNDS):
                if key in scenes:
                    scenes[key].close()
                scenes[key] = EmbreeScene(embree, mesh, way, threads)
                seconds.append(scenes[key].seconds)
            built[f"embree {way.name}"] = Built(min(seconds), scenes[key].bytes)

        def trace(rays: Rays, results: Results, way: object = way, scene: EmbreeScene = scenes[key]) -> None:
            scene.trace(rays, results, way, threads)

        tracers.append(Tracer(f"embree {way.name}", trace))
    return tracers, built


def embreex_tracer(mesh: Mesh) -> Tracer:
    """embreex: one ray after the other through Python buffers, closest hits only."""
    from embreex import rtcore_scene
    from embreex.mesh_construction import TriangleMesh

    scene = rtcore_scene.EmbreeScene()
    TriangleMesh(scene, mesh.vertices, mesh.triangles)
    scene.run(np.zeros((1, 3), np.float32), np.ones((1, 3), np.float32))

    def trace(rays: Rays, results: Results) -> None:
        results.triangle[:] = scene.run(rays.origins, rays.directions)

    return Tracer("embreex", trace, shadows=False)


Times = dict[str, NDArray[np.float64]]


def measure(tracers: list[Tracer], rays: Rays, rounds: int) -> Times:
    """Processor seconds of each tracer, round by round; a first round that warms up is not counted."""
    results = empty_results(len(rays.origins))
    able = [t for t in tracers if t.shadows or not rays.shadow]
    times = np.empty((rounds + 1, len(able)))
    for row in times:
        for column, tracer in enumerate(able):
            start = time.process_time()
            tracer.trace(rays, results)
            row[column] = time.process_time() - start
    return {tracer.name: times[1:, column] for column, tracer in enumerate(able)}


def agreement(tracers: list[Tracer], rays: Rays) -> float:
    """Share of rays for which the first tracer and Embree robust say the same."""
    answers = []
    for tracer in tracers:
        results = empty_results(len(rays.origins))
        tracer.trace(rays, results)
        answers.append(results.hidden if rays.shadow else results.triangle)
    return float(np.mean(answers[0] == answers[1]))


def ratios(times: Times, ours: str) -> dict[str, float]:
    """Our speed over those that the targets name: medians over the rounds."""

    def over(*peers: str) -> float:
        return float(np.median(np.min([times[f"embree {p}"] for p in peers], axis=0) / times[ours]))

    result = {
        "robust": over("robust"),
        "single": over("medium", "high"),
        "packets": over("packets", "coherent"),
        "better": over("medium", "high", "packets", "coherent"),
    }
    if "embreex" in times:
        result["embreex"] = float(np.median(times["embreex"] / times[ours]))
    return result


def report_scene(name: str, mesh: Mesh, embree: Embree, arguments: argparse.Namespace) -> dict[str, object]:
    """Builds, traces and prints one scene; returns what was found."""
    threads = arguments.threads
    natives = [native_tracer(mesh, accel, threads) for accel in arguments.accel]
    peers, built = embree_tracers(mesh, embree, threads)
    tracers = [tracer for tracer, _ in natives] + peers
    if threads == 1 and not arguments.no_embreex:
        tracers.append(embreex_tracer(mesh))
    built = {tracer.name: b for tracer, b in natives} | built
    count = len(mesh.triangles)
    say(f"\n{name}: {count} triangles, {threads} thread(s)")
    for tracer_name, b in built.items():
        say(f"  build {tracer_name:16} {b.seconds:7.3f} CPU s {b.bytes / count:6.1f} B/triangle")

    def nearest(rays: Rays) -> Results:
        results = empty_results(len(rays.origins))
        tracers[0].trace(rays, results)
        return results

    rows: dict[str, object] = {}
    say(
        "  Mrays/s  "
        + " ".join(f"{t.name.removeprefix('embree '):>9}" for t in tracers)
        + "  trg / robust single packets embreex"
    )
    for rays in ray_sets(mesh, arguments.rays, nearest):
        times = measure(tracers, rays, arguments.rounds)
        found = ratios(times, tracers[0].name)
        speeds = {name: len(rays.origins) * threads / np.min(t) / 1e6 for name, t in times.items()}
        rows[rays.name] = {"speeds": speeds, "ratios": found, "count": len(rays.origins)}
        shown = " ".join(f"{speeds.get(t.name, np.nan):9.2f}" for t in tracers)
        same = agreement([tracers[0], peers[0]], rays)
        say(
            f"  {rays.name:8} {shown}  {found['robust']:10.2f} {found['single']:6.2f} {found['packets']:7.2f}"
            f" {found.get('embreex', np.nan):7.2f}  same {same:.6f}"
        )
    builds = {k: (b.seconds, b.bytes / count) for k, b in built.items()}
    return {"rays": rows, "build": builds, "triangles": count}


def geometric_means(found: dict[str, dict[str, object]]) -> None:
    """Prints the mean over scenes of every ratio, and of build time and memory."""
    say("\ngeometric means over " + ", ".join(found))
    first = next(iter(found.values()))
    for kind in first["rays"]:
        rows = [scene["rays"][kind]["ratios"] for scene in found.values()]
        means = {key: float(np.exp(np.mean(np.log([row[key] for row in rows])))) for key in rows[0]}
        say(f"  {kind:8} " + "  ".join(f"{key} {value:.2f}" for key, value in means.items()))
    ours = next(iter(first["build"]))
    times = [scene["build"][ours][0] / scene["build"]["embree medium"][0] for scene in found.values()]
    space = [scene["build"][ours][1] for scene in found.values()]
    mean_time, mean_space = np.exp(np.mean(np.log([times, space]), axis=1))
    say(f"  build time / Embree medium {mean_time:.2f}, bytes a triangle {mean_space:.1f}")


def say(line: str) -> None:
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="*", default=list(SCENES))
    parser.add_argument("--rays", type=int, default=1 << 18)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--accel", nargs="+", default=["bvh"])
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--cache", type=Path, default=ROOT / "build/benchmarks")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--no-embreex", action="store_true")
    arguments = parser.parse_args()
    embree = Embree(arguments.cache)
    found = {}
    for scene in arguments.scenes:
        mesh = read_g3dm(Path(scene)) if scene.endswith(".g3dm") else read_scene(scene, arguments.cache)
        found[Path(scene).stem] = report_scene(scene, mesh, embree, arguments)
    geometric_means(found)
    if arguments.json:
        arguments.json.write_text(json.dumps(found, indent=1))


if __name__ == "__main__":
    main()

"""Calls the native core at random: right and wrong arguments, in any order, and checks what it promises.

    python tools/fuzz_native.py [CALLS] [SEED] [--threads N]

A call must succeed or raise ValueError, RuntimeError, TypeError or OverflowError; what it fills must keep
the contract (docs/tracing.md). Ends with status 1 on a finding, after naming the seed and the number of
the call that repeat it. With threads, N of them use the same scenes at once. `tools/fuzz_native.sh` runs it
under the sanitizers.
"""

from __future__ import annotations

import argparse
import random
import sys
import threading
import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import trg_native

sys.path.insert(0, str(Path(__file__).resolve().parent))
from fuzz_values import Values  # noqa: E402

REFUSALS = (ValueError, RuntimeError, TypeError, OverflowError)
ACCELS = ("auto", "bvh", "grid", "grid2", "tree", "none")
TESTS = ("watertight", "classic")
SETS = ("auto", "baseline", "avx2", "avx512")
SCENES = 4
MOST_PARTS = 60
ENOUGH = 20_000
"""after so many calls each kind must have succeeded: else the contract has changed and this tool has not"""


class BrokenPromise(Exception):
    """The native core returned what its contract excludes."""


def expect(kept: bool, what: str) -> None:
    if not kept:
        raise BrokenPromise(what)


def shown(rays: list[Any], rows: Any, *results: Any) -> str:
    """The first ray of `rows`, exactly, with its results."""
    if not rows.any():
        return ""
    k = int(np.flatnonzero(rows)[0])
    return repr([a[k].tolist() for a in (*rays, *results)])


@dataclass
class Subject:
    """A scene, and how many vertices and triangles its meshes have."""

    scene: Any
    sizes: list[tuple[int, int]] = field(default_factory=list)
    instances: int = 0


def plain_materials(count: int) -> Any:
    names = trg_native.MATERIAL_FIELDS
    plain = {"ior": 1.5, "coat_ior": 1.5, **{name: -1 for name in names if name.endswith("_texture")}}
    plain.update({"interface": 0, "multiscatter": 1, "metal_grazing": 0, "alpha": 1})
    plain.update({"translucent": 0, "mix_first": 0, "mix_count": 0, "holdout": 0})
    return np.tile(np.array([plain.get(name, 0.5) for name in names], np.float32), (count, 1))


class Fuzzer:
    """A row of calls that `seed` decides. `subjects` may be shared with others that run at once."""

    def __init__(self, seed: int, subjects: list[Subject] | None = None) -> None:
        self.random = random.Random(seed)
        self.values = Values(self.random, seed)
        self.alone = subjects is None
        self.subjects: list[Subject] = [] if subjects is None else subjects
        self.sets = SETS[: SETS.index(trg_native.info()["instruction_set"]) + 1]
        self.jobs: list[tuple[Any, tuple[int, int]]] = []
        self.done: dict[str, int] = {}
        """successful calls by name"""
        weights = {
            self.new_scene: 3, self.add_mesh: 8, self.add_shape: 3, self.add_instance: 8,
            self.add_instances: 3, self.set_tables: 6, self.set_texture_data: 4, self.set_camera: 4,
            self.build: 10, self.update_transforms: 5, self.update_vertices: 5, self.query: 25,
            self.query_badly: 5, self.start_render: 4, self.use_job: 8, self.drop: 2,
            self.set_surroundings: 3, self.scatter: 2,
        }  # fmt: skip
        self.calls: list[Callable[[], None]] = list(weights)
        self.weights = list(weights.values())

    def call(self) -> str:
        """Makes one call; returns what was wrong with it, normally nothing."""
        chosen = self.random.choices(self.calls, self.weights)[0]
        try:
            if not self.subjects:
                self.new_scene()
            chosen()
            self.done[chosen.__name__] = self.done.get(chosen.__name__, 0) + 1
        except REFUSALS:
            return ""
        except BrokenPromise as broken:
            return f"{chosen.__name__}: {broken}"
        except Exception:
            return f"{chosen.__name__}: {traceback.format_exc()}"
        return ""

    def subject(self) -> Subject:
        """One of the scenes; one that has grown large makes room for a new one."""
        at = self.random.randrange(len(self.subjects))
        if self.subjects[at].instances + len(self.subjects[at].sizes) > MOST_PARTS:
            self.subjects[at] = self.fresh_subject()
        return self.subjects[at]

    def scene(self) -> Any:
        return self.subject().scene

    def built_scene(self) -> Any:
        """Mostly built, so that queries and renders are not all refused."""
        scene = self.scene()
        if self.random.random() < 0.8:
            try:
                scene.build(1)
            except RuntimeError:
                return scene
        return scene

    def new_scene(self) -> None:
        subject = self.fresh_subject()
        if len(self.subjects) < SCENES:
            self.subjects.append(subject)
        else:
            self.subjects[self.random.randrange(SCENES)] = subject

    def fresh_subject(self) -> Subject:
        pick = self.values.pick
        subject = Subject(trg_native.Scene(pick(ACCELS), pick(TESTS), pick(self.sets)))
        if self.values.flip(0.9):
            subject.scene.set_materials(plain_materials(3))
            matrix = np.column_stack([np.eye(3), (0, 0, 3)])
            subject.scene.set_camera(0, matrix, np.array([-1.0, 1, -1, 1]), 1e-6, 1e30)
        return subject

    def add_mesh(self) -> None:
        v = self.values
        vertices, count = v.vertices()
        faces = v.triangles(count)
        m = len(faces)
        extra = v.maybe(v.floats((m, 3, 3))), v.maybe(v.floats((m, 3, 2))), v.maybe(v.slots(m))
        subject = self.subject()
        subject.scene.add_mesh(v.spoil(vertices), v.spoil(faces), *(v.spoil(e) for e in extra))
        subject.sizes.append((count, m))

    def add_shape(self) -> None:
        subject = self.subject()
        (subject.scene.add_sphere if self.random.random() < 0.6 else subject.scene.add_plane)()
        subject.sizes.append((0, 0))

    def add_instance(self) -> None:
        v, subject = self.values, self.subject()
        mesh = v.index(len(subject.sizes) or 1)
        subject.scene.add_instance(mesh, v.maybe(v.spoil(v.transforms(1)[0])), v.maybe(v.slots(2)))
        subject.instances += 1

    def add_instances(self) -> None:
        v, subject = self.values, self.subject()
        rows = v.transforms(v.pick((0, 1, 3, 40)))
        subject.scene.add_instances(v.index(len(subject.sizes) or 1), v.spoil(rows), v.maybe(v.slots(2)))
        subject.instances += len(rows)

    def set_texture_data(self) -> None:
        v, subject = self.values, self.subject()
        scene, action, mesh = subject.scene, self.random.randrange(4), v.index(len(subject.sizes) or 1)
        if action == 0:
            scene.set_randoms(v.spoil(v.floats((subject.instances,))))
        elif action == 1:
            scene.set_texture_space(mesh, tuple(v.floats((3,)).tolist()), (0.0, 1.0, 2.0))
        elif action == 2:
            rows = subject.sizes[mesh][1] if 0 <= mesh < len(subject.sizes) else 1
            scene.set_attribute(mesh, v.index(4), v.spoil(v.floats((rows, 3, self.random.randrange(6)))))
        else:
            scene.set_programs(*(v.spoil(a) for a in v.programs()))

    def set_tables(self) -> None:
        v, scene = self.values, self.scene()
        action = self.random.randrange(5)
        if action == 0:
            scene.add_image(v.spoil(v.pixels()), self.random.random() < 0.5)
        elif action == 1:
            scene.set_textures(v.spoil(v.textures(trg_native.TEXTURE_FIELDS)))
        elif action == 2:
            scene.set_lights(v.spoil(v.lights(trg_native.LIGHT_FIELDS)))
        elif action == 3:
            scene.set_world(*v.floats((3,)).tolist())
        else:
            scene.set_materials(v.spoil(v.materials(trg_native.MATERIAL_FIELDS)))

    def set_camera(self) -> None:
        v = self.values
        clip = v.pick(((0.0, 1e30), (1e-3, 10.0), (1.0, 0.0), (float("nan"), 1.0)))
        matrix = v.transforms(1)[0].astype(np.float64)
        self.scene().set_camera(v.index(3), v.spoil(matrix), v.spoil(v.window()), *clip, *v.lens())

    def set_surroundings(self) -> None:
        """An environment, or the filter of the film."""
        v, scene = self.values, self.scene()
        if v.flip(0.3):
            subject = self.subject()
            scene, count = subject.scene, v.pick((subject.instances, subject.instances, 0, 5))
            masks = self.values.numbers.integers(0, 256, count).astype(np.uint8)
            scene.set_visibility(v.spoil(masks), v.spoil(masks & 1), v.flip())
            return
        if v.flip():
            names = ("box", "gaussian", "blackman_harris", "tent")
            scene.set_filter(v.pick(names), v.pick((1.0, 1.5, 0.01, 1e30, 0.0, np.nan)))
            return
        pixels = np.abs(v.floats((v.pick((1, 2, 9)), v.pick((1, 3, 16)), 3)))
        rotation = v.transforms(1)[0][:, :3].astype(np.float64)
        scene.set_environment(v.spoil(pixels), v.spoil(np.ascontiguousarray(rotation)), v.flip())

    def scatter(self) -> None:
        """One material alone: its values and samples are finite, however it is lit."""
        v = self.values
        table = np.minimum(v.materials(trg_native.MATERIAL_FIELDS), np.float32(1e6))
        directions = v.floats((2, 20, 3)) + np.float32([0, 0, 1e-3])
        directions[0, :, 2] = np.abs(directions[0, :, 2])
        with np.errstate(all="ignore"):
            wo, wi = directions / np.linalg.norm(directions, axis=2, keepdims=True)
        value, pdf = np.full((20, 3), np.nan, np.float32), np.full(20, np.nan, np.float32)
        trg_native.bsdf_eval(v.spoil(table[0]), v.spoil(wo), v.spoil(wi), v.flip(), value, pdf)
        sound = np.isfinite(wo).all(1) & np.isfinite(wi).all(1)
        expect(
            bool(np.isfinite(value[sound]).all() and (pdf[sound] >= 0).all()),
            f"bsdf_eval: {table[0].tolist()}",
        )
        uniforms = v.numbers.random((20, 3)).astype(np.float32)
        drawn, weight = np.full((2, 20, 3), np.nan, np.float32)
        trg_native.bsdf_sample(table[0], wo, v.spoil(uniforms), v.flip(), drawn, weight, pdf)
        sound = np.isfinite(wo).all(1) & (pdf >= 0)
        expect(bool(np.isfinite(weight[sound]).all()), f"bsdf_sample: {table[0].tolist()}")

    def build(self) -> None:
        stats = self.scene().build(self.values.threads(), self.values.pick((0, 1, 1e9, 1e300, -1, np.nan)))
        expect(stats["accel"] in ACCELS[1:] and stats["bytes"] >= 0, f"build: {stats}")

    def update_transforms(self) -> None:
        v, subject = self.values, self.subject()
        rows = v.transforms(v.pick((0, 1, 1, 2)))
        first = v.index(subject.instances or 1)
        subject.scene.update_transforms(first, v.spoil(rows), v.threads())

    def update_vertices(self) -> None:
        v, subject = self.values, self.subject()
        mesh = v.index(len(subject.sizes) or 1)
        vertices, triangles = subject.sizes[mesh] if 0 <= mesh < len(subject.sizes) else (1, 1)
        moved, normals = v.floats((vertices, 3)), v.maybe(v.floats((triangles, 3, 3)))
        subject.scene.update_vertices(mesh, v.spoil(moved), v.spoil(normals), v.threads())

    def query(self) -> None:
        """Both kinds of query with right arguments, and the contract of what they fill."""
        rays = self.values.rays()
        count = len(rays[0])
        t, u, v = np.full((3, count), np.nan, np.float32)
        triangle, instance = np.full((2, count), -7, np.int32)
        hidden = np.full(count, 7, np.uint8)
        scene, threads = self.built_scene(), self.values.pick((1, 1, 2))
        scene.intersect(*rays, t, u, v, triangle, instance, threads)
        met = triangle >= 0
        expect(bool((triangle[~met] == -1).all() and (instance[~met] == -1).all()), "a miss is marked")
        expect(bool(np.isposinf(t[~met]).all()), "a miss is infinitely far")
        expect(bool((instance[met] >= 0).all()), "a hit has its instance")
        finite = np.isfinite(np.stack([t, u, v])).all(0) | ~met
        expect(bool(finite.all()), f"a hit has finite numbers: {shown(rays, ~finite, t, u, v, triangle)}")
        away = met & ~((t >= rays[2]) & (t <= rays[3]))
        expect(not away.any(), f"t lies in its range: {shown(rays, away, t)}")
        scene.occluded(*rays, hidden, threads)
        expect(bool((hidden <= 1).all()), "hidden is 0 or 1")
        if self.alone:
            other = (hidden == 1) != met
            expect(not other.any(), f"any hit is where a nearest one is: {shown(rays, other, t, hidden)}")

    def query_badly(self) -> None:
        v = self.values
        rays = v.rays()
        count = len(rays[0])
        outs = [np.zeros(count, d) for d in (np.float32,) * 3 + (np.int32,) * 2]
        arrays = [*rays, *outs]
        for _ in range(self.random.randrange(3)):
            # Arrays that are wrong, and the same array in two places.
            k = self.random.randrange(len(arrays))
            right = isinstance(arrays[k], np.ndarray) and v.flip()
            arrays[k] = v.spoil(arrays[k], always=True) if right else v.pick(arrays)
        self.built_scene().intersect(*arrays, v.threads())

    def start_render(self) -> None:
        v = self.values
        width, height = v.size(), v.size()
        passes = v.passes()
        border = v.pick((None, None, (0, 0, 1, 1), (1, 0, 3, 2), (2, 2, 1, 1), "abcd"))
        scene = self.built_scene()
        job = scene.start_render(
            width, height, v.pick((1, 2, 9, 20, 0)), v.pick((0, 1 << 63)), v.pick((0, 1, 4, 4, -1)),
            v.threads(), passes, border, *v.stops(), rules=v.rules(),
        )  # fmt: skip
        size = (height, width) if border is None else (border[3] - border[1], border[2] - border[0])
        self.jobs.append((job, size))
        if len(self.jobs) > 3:
            self.jobs.pop(self.random.randrange(4))

    def use_job(self) -> None:
        if not self.jobs:
            return
        job, (height, width) = self.random.choice(self.jobs)
        v, action = self.values, self.random.randrange(7)
        out = np.full((height, width, 4), np.nan, np.float32)
        if action == 0:
            job.cancel()
        elif action == 1:
            state = job.poll(v.pick((0, 0.001, 5.0, -1, np.nan)))
            expect(0 <= state["samples"] <= state["target"], f"poll: {state}")
        elif action == 2:
            job.combined(v.spoil(out))
        elif action == 3:
            job.combined(out)
            expect(bool(np.isfinite(out).all()), "a picture is finite")
            (job.depth if v.flip() else job.normal)(out[:, :, 0].copy() if v.flip() else out[:, :, :3].copy())
        elif action == 4:
            error = job.error()
            expect(error["mse"] is None or error["mse"] >= 0, f"error: {error}")
        elif action == 5:
            half_width, flags = (
                np.full((height, width), np.nan, np.float32),
                np.zeros((height, width), np.uint8),
            )
            job.pixel_error(v.spoil(half_width), v.spoil(flags))
        else:
            sums, counts = np.empty((8, height, width, 3)), np.empty(8, np.int64)
            job.replicates(v.spoil(sums), v.spoil(counts))

    def drop(self) -> None:
        """Frees a scene or a job, which may be running."""
        if self.jobs and self.random.random() < 0.7:
            self.jobs.pop(self.random.randrange(len(self.jobs)))
        elif self.alone:
            self.subjects.pop(self.random.randrange(len(self.subjects)))


def run(fuzzer: Fuzzer, calls: int, findings: list[str]) -> None:
    np.seterr(all="ignore")
    for number in range(calls):
        fault = fuzzer.call()
        if fault:
            findings.append(f"call {number}: {fault}")
            return


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("calls", type=int, nargs="?", default=100_000)
    parser.add_argument("seed", type=int, nargs="?", default=1)
    parser.add_argument("--threads", type=int, default=1)
    arguments = parser.parse_args()
    start = time.perf_counter()
    findings: list[str] = []
    shared = [Subject(trg_native.Scene()) for _ in range(4)] if arguments.threads > 1 else None
    fuzzers = [Fuzzer(arguments.seed + k, shared) for k in range(arguments.threads)]
    runs = [
        threading.Thread(target=run, args=(f, arguments.calls // arguments.threads, findings))
        for f in fuzzers
    ]
    for thread in runs:
        thread.start()
    for thread in runs:
        thread.join()
    succeeded = {
        name: sum(f.done.get(name, 0) for f in fuzzers)
        for name in sorted(set().union(*(f.done for f in fuzzers)))
    }
    seconds = time.perf_counter() - start
    sys.stdout.write(f"{arguments.calls} calls, seed {arguments.seed}, {seconds:.0f} s\n")
    sys.stdout.write(f"succeeded: {succeeded}\n")
    if arguments.calls >= ENOUGH:
        findings += [
            f"{c.__name__} never succeeded" for c in fuzzers[0].calls if not succeeded.get(c.__name__)
        ]
    for finding in findings:
        sys.stdout.write(f"seed {arguments.seed}, {finding}\n")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())

"""Where digits are lost: every stage in single precision against the same in double or better."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from ..engine.native import Hits
from ..engine.scene_arrays import Material
from .lobes import evaluate, evaluate_reference
from .meshes import Float32, Float64, Mesh, icosphere, mesh_of, scene_of
from .ray_rows import Extended, Outward, Rays, exact_hits, slivers
from .stage import Camera as StageCamera
from .stage import Settings, finish, new_scene, start


@dataclass(frozen=True, slots=True)
class Digits:
    """The error of one number of one stage."""

    stage: str
    quantity: str
    most: float
    """99.9 % of the errors are below"""
    worst: float


def digits(stage: str, quantity: str, errors: Extended | Float64) -> Digits:
    errors = np.asarray(errors, np.float64).ravel()
    return Digits(stage, quantity, float(np.quantile(errors, 0.999)), float(errors.max()))


def intersection(name: str, mesh: Mesh, rays: Rays, seed: int) -> Iterator[Digits]:
    """t relative, u and v as they are: they lie between 0 and 1."""
    hits: Hits = scene_of(mesh, "bvh").intersect(*rays)
    met = hits.triangle >= 0
    some = rays[0][met], rays[1][met]
    t, u, v = exact_hits(mesh.vertices[mesh.triangles[hits.triangle[met]]], some)
    stage = f"intersection, {name}"
    yield digits(stage, "t", np.abs(hits.t[met] / t - 1))
    yield digits(stage, "u, v (absolute)", np.maximum(np.abs(hits.u[met] - u), np.abs(hits.v[met] - v)))


def intersections(count: int, seed: int) -> Iterator[Digits]:
    anywhere = Outward(at_random=True)
    for name, mesh in (
        ("ball", icosphere(4)),
        ("ball of 1e-6", icosphere(4, 1e-6)),
        ("ball at 1e4 of its size", icosphere(3, 1.0, 1e4)),
    ):
        yield from intersection(name, mesh, anywhere.shoot(mesh, count, 1 + seed), seed)
    mesh = icosphere(4)
    far = 1e4 * np.random.default_rng(seed).normal(size=(count, 3))
    aims = 0.4 * np.random.default_rng(seed + 1).normal(size=(count, 3))
    yield from intersection(
        "ball from 1e4", mesh, (far.astype(np.float32), (aims - far).astype(np.float32)), seed
    )
    lone = slivers(1e5)(min(count, 2000), seed)
    # Far enough apart that a ray at one passes by the others.
    steps = 100.0 * np.stack(
        [np.arange(len(lone.origins)), 0 * lone.origins[:, 0], 0 * lone.origins[:, 0]], 1
    )
    spread = mesh_of(lone.mesh.vertices + np.repeat(steps, 3, axis=0), lone.mesh.triangles)
    rays = (lone.origins + steps).astype(np.float32), lone.directions
    yield from intersection("slivers of 1e5 : 1, up to 2e5 away", spread, rays, seed)


ALONE = {"multiscatter": 0.0}
MATERIALS = {
    "diffuse": Material(specular=0.0),
    "rough diffuse": Material(specular=0.0, diffuse_roughness=1.0),
    "metal, roughness 0.3": Material(metallic=1.0, roughness=0.3, **ALONE),
    "metal, roughness 0.05": Material(metallic=1.0, roughness=0.05, **ALONE),
    "glass, roughness 0.3": Material(1.0, 1.0, 1.0, transmission=1.0, roughness=0.3, **ALONE),
    "glass, roughness 0.05": Material(1.0, 1.0, 1.0, transmission=1.0, roughness=0.05, **ALONE),
    "glass of index 1.001": Material(1.0, 1.0, 1.0, transmission=1.0, roughness=0.3, ior=1.001, **ALONE),
    "metal with energy kept (tables)": Material(metallic=1.0, roughness=0.3),
    "plastic (tables)": Material(roughness=0.3),
    "coat (tables)": Material(coat=1.0, coat_roughness=0.2),
    "sheen": Material(sheen_r=1.0, sheen_g=1.0, sheen_b=1.0),
}
"""Where energy is kept both renderers read tables that they have computed on their own: that difference is no
matter of digits."""
ONE_LOBE = ("diffuse", "rough diffuse", "metal, roughness 0.3", "metal, roughness 0.05")
"""Others share out their density among lobes, each renderer in its own way."""


def directions(count: int, seed: int) -> Float32:
    """Even over the sphere."""
    rows = np.random.default_rng(seed).normal(size=(count, 3))
    return (rows / np.linalg.norm(rows, axis=1, keepdims=True)).astype(np.float32)


def shading(count: int, seed: int) -> Iterator[Digits]:
    """Relative to the larger of the value and a millionth of the material's largest."""
    wo, wi = directions(count, seed), directions(count, seed + 1)
    wo[:, 2] = np.maximum(np.abs(wo[:, 2]), 1e-3)
    wo = (wo / np.linalg.norm(wo, axis=1, keepdims=True)).astype(np.float32)
    for name, material in MATERIALS.items():
        found, wanted = evaluate(material, wo, wi), evaluate_reference(material, wo, wi)
        for quantity, single, double in zip(("value", "density"), found, wanted, strict=True):
            if quantity == "density" and name not in ONE_LOBE:
                continue
            floor = 1e-6 * np.abs(double).max()
            yield digits(
                f"shading, {name}", quantity, np.abs(single - double) / np.maximum(np.abs(double), floor)
            )


def accumulation(count: int, seed: int) -> Iterator[Digits]:
    """Means of a constant world by the film, whose sums are double, and by a sum in single precision."""
    value = float(np.float32(0.1))
    scene = new_scene([], world=0.1)
    StageCamera().apply(scene)
    scene.build(1)
    job = start(scene, Settings(1, 1, samples=count, seed=seed))
    finish(job)
    sums, counts, pixel = np.zeros((8, 1, 1, 3)), np.zeros(8, np.int64), np.zeros((1, 1, 4), np.float32)
    job.replicates(sums, counts)
    job.combined(pixel)
    means = sums[:, 0, 0] / counts[:, None]
    yield digits(f"accumulation, film sums of {count:g}", "mean of a replicate", np.abs(means / value - 1))
    yield digits(f"accumulation, film sums of {count:g}", "pixel", np.abs(pixel[0, 0, :3] / value - 1))
    running = np.cumsum(np.full(count, 0.1, np.float32), dtype=np.float32)[-1] / count
    yield digits(
        f"for comparison, a float32 sum of {count:g}", "pixel", np.abs(np.array([running / value - 1]))
    )


STAGES: tuple[Callable[[int, int], Iterator[Digits]], ...] = (intersections, shading, accumulation)


def measure_digits(count: int, seed: int = 0) -> list[Digits]:
    """Every stage with about `count` rays, pairs of directions, or samples."""
    return [one for stage in STAGES for one in stage(count, seed)]

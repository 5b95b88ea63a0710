"""Rows of spheres and planes that rays meet in double precision: G13, G14, P01."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..engine.native import RayScene
from .case import Case, Outcome, Row
from .meshes import ACCELS, Float32, Float64


def scene_with(transform: Float32 | None, shape: str = "sphere", accel: str = "auto") -> RayScene:
    scene = RayScene(accel)
    mesh = scene.add_sphere() if shape == "sphere" else scene.add_plane()
    scene.add_instance(mesh, transform)
    scene.build()
    return scene


def exact_sphere(origins: Float32, directions: Float32, radius: float) -> tuple[Float64, Float64]:
    """Distance to the sphere round the origin in extended precision (NaN: missed), and the distance
    between the line and the centre."""
    o, d = origins.astype(np.longdouble), directions.astype(np.longdouble)
    dd, od = (d * d).sum(1), (o * d).sum(1)
    q = o - d * (od / dd)[:, None]
    across = (q * q).sum(1)
    with np.errstate(invalid="ignore"):
        half = np.sqrt((np.longdouble(radius) ** 2 - across) / dd)
    near, far = -od / dd - half, -od / dd + half
    return np.where(near > 0, near, far), np.sqrt(across)


def sphere_from(distance: float) -> Row:
    """P01: rays at and just past the unit sphere; those within 1e-9 of its rim count as neither."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        rng = np.random.default_rng(1 + seed)
        origins = rng.normal(size=(count, 3))
        origins *= distance / np.linalg.norm(origins, axis=1, keepdims=True)
        aims = rng.normal(size=origins.shape)
        aims *= (1.2 * rng.random(len(origins)) / np.linalg.norm(aims, axis=1))[:, None]
        given = origins.astype(np.float32)
        directions = (aims - given).astype(np.float32)
        hits = scene_with(None, accel=accel).intersect(given, directions)
        t, across = exact_sphere(given, directions, 1.0)
        met, inside = hits.triangle == 0, across < 1
        with np.errstate(invalid="ignore"):
            wrong = (met != inside) | (met & (np.abs(hits.t / t - 1) > 1e-6))
        return Outcome(int((wrong & (np.abs(across - 1) > 1e-9)).sum()), count)

    return row


def planet(accel: str, count: int, seed: int = 0) -> Outcome:
    """G14: rays just above and below the horizon of a sphere of 6.4e6 m seen from 1.7 m."""
    radius, eye = 6.4e6, 1.7
    transform = np.column_stack([np.eye(3) * radius, (0, 0, -radius)]).astype(np.float32)
    scene = scene_with(transform, accel=accel)
    dip = np.arccos(radius / (radius + float(np.float32(eye))))
    half, rng = count // 2, np.random.default_rng(seed)
    angles = np.concatenate([dip * (1 + rng.uniform(1e-4, 5, half)), dip * (1 - rng.uniform(1e-4, 1, half))])
    directions = np.stack([np.cos(angles), 0 * angles, -np.sin(angles)], axis=1).astype(np.float32)
    hits = scene.intersect(np.tile(np.float32([0, 0, eye]), (2 * half, 1)), directions)
    wrong = int(((hits.triangle == 0) != (np.arange(2 * half) < half)).sum())
    down = scene.intersect(np.float32([[0, 0, eye]]), np.float32([[0, 0, -1]])).t[0]
    wrong += abs(down / np.float32(eye) - 1) > 1e-6
    return Outcome(wrong, 2 * half, f"{wrong} of {2 * half}, dip {np.degrees(dip):.4f} deg")


def endless_plane(accel: str, count: int, seed: int = 0) -> Outcome:
    """G13: the plane z = 0 from 1.7 above: met by every ray that sinks, by no other; t to 1e-6."""
    scene, rng = scene_with(None, "plane", accel), np.random.default_rng(seed)
    slopes, turn = 10.0 ** rng.uniform(-12, 0, count), rng.uniform(0, 2 * np.pi, count)
    directions = np.stack([np.cos(turn), np.sin(turn), -slopes], axis=1).astype(np.float32)
    origins = np.tile(np.float32([0, 0, 1.7]), (count, 1))
    exact = float(np.float32(1.7)) / -directions[:, 2].astype(np.float64)
    failed = int((~(np.abs(scene.intersect(origins, directions).t / exact - 1) <= 1e-6)).sum())
    for turned in (-1, 0):
        directions[:, 2] = np.abs(directions[:, 2]) * -turned
        failed += int((scene.intersect(origins, directions).triangle >= 0).sum())
    return Outcome(failed, 3 * count)


def cases() -> Iterator[Case]:
    """G13, G14, P01."""
    yield Case("G13", "endless plane", endless_plane, ACCELS, 512 * 512, 2000)
    yield Case("G14", "sphere of 6.4e6, eye 1.7 above", planet, ACCELS, 1_000_000, 2000)
    for distance in (1e1, 1e2, 1e3, 1e4, 1e5):
        yield Case("P01", f"from {distance:g}", sphere_from(distance), ACCELS, 1_000_000, 2000)

"""Rows of balls of any size and place, of instances, and of smooth normals: S01, S02, S09, S10."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..engine.native import RayScene
from ..engine.scene_arrays import Light
from .case import ONCE, PICTURES, Case, Outcome, Row, within
from .leaving_rows import film
from .meshes import ACCELS, INDICES, Float64, edge_and_vertex_rays, icosphere, mesh_of, random_rays
from .ray_rows import exact_hits
from .stage import SUN, WHITE, Camera, add_object, make_sphere, new_scene, picture, place

PICTURE = 1_000_000
"""camera rays of a picture"""


def white_ball(scale: float, offset: float, shape: str, tolerance: float) -> Row:
    """S01, S02: a white ball in a white world; `offset` is in radii."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        scene, x = new_scene([WHITE], world=1.0, accel=accel), offset * scale
        if shape == "mesh":
            # Finer ones are not convex any more when their vertices are rounded so far away.
            ball = icosphere(4 if offset < 1e4 else 2 if offset < 1e5 else 1, scale, x)
            add_object(scene, (ball.vertices, ball.triangles))
        else:
            scene.add_instance(scene.add_sphere(), place(x, x, x, scale), np.zeros(1, np.int32))
        camera = Camera(eye=(x, x, x + 3 * scale), half_width=1.2 * scale)
        pixels = picture(scene, film(count, 0, seed), camera)[..., :3].astype(np.float64)
        mean, least = abs(pixels.mean() - 1), pixels.min()
        return Outcome(
            int(not (mean <= tolerance and least >= 0.99)), 1, f"mean off {mean:.1e}, least {least:.4f}"
        )

    return row


def rotation(seed: int) -> Float64:
    matrix, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return matrix


def placed(linear: Float64, translation: tuple[float, float, float] = (0, 0, 0)) -> Float64:
    return np.concatenate([linear, np.reshape(translation, (3, 1))], axis=1).astype(np.float32)


TRANSFORMS = {
    "moved": placed(np.eye(3), (0.3, -0.2, 0.1)),
    "turned": placed(rotation(1)),
    "mirrored": placed(np.diag([-1.0, 1, 1]), (1, 0, 0)),
    "sheared by 10": placed(np.eye(3) + 10 * np.outer([1, 0, 0], [0, 1, 0])),
    "scaled by 1e-6": placed(1e-6 * rotation(2)),
    "scaled by 1e6": placed(1e6 * rotation(3)),
    "at 1e4": placed(rotation(4), (1e4, -1e4, 1e4)),
}


def instance_leaks(name: str) -> Row:
    """S09: rays from inside an instance at its edges and vertices that meet nothing."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        transform, mesh = TRANSFORMS[name].astype(np.float64), icosphere(3)
        scene = instance_of(mesh_of(mesh.vertices, mesh.triangles), name, accel)
        origins, directions = edge_and_vertex_rays(mesh, count, 6 + seed)
        origins = (origins @ transform[:, :3].T + transform[:, 3]).astype(np.float32)
        directions = (directions @ transform[:, :3].T).astype(np.float32)
        hits = scene.intersect(origins, directions)
        return Outcome(int(((hits.triangle < 0) | ~scene.occluded(origins, directions)).sum()), count)

    return row


def instance_of(mesh: object, name: str, accel: str) -> RayScene:
    scene = RayScene(accel)
    scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles), TRANSFORMS[name])
    scene.build()
    return scene


def as_baked(name: str) -> Row:
    """S09: distance to an instance against that to the same triangles baked in double precision."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        transform, mesh = TRANSFORMS[name].astype(np.float64), icosphere(3)
        local_origins, local_directions = random_rays(count, 5 + seed, 3)
        origins = (local_origins @ transform[:, :3].T + transform[:, 3]).astype(np.float32)
        directions = (local_directions @ transform[:, :3].T).astype(np.float32)
        hits = instance_of(mesh, name, accel).intersect(origins, directions)
        met = hits.triangle >= 0
        world = mesh.vertices.astype(np.float64) @ transform[:, :3].T + transform[:, 3]
        corners = world[mesh.triangles[hits.triangle[met]]]
        t, _, _ = exact_hits(corners, (origins[met], directions[met]))
        lengths = np.linalg.norm(directions[met], axis=1) / np.linalg.norm(transform[:, :3], 2)
        return within(float((np.abs(hits.t[met] - t) * lengths).max()), 1e-5)

    return row


def smooth_ball() -> tuple[Float64, np.ndarray, Float64]:
    vertices, triangles = make_sphere(8)
    return vertices, triangles, np.ascontiguousarray(vertices[triangles])


def terminator(accel: str, count: int, seed: int = 0) -> Outcome:
    """S10: of the pixels that smooth normals light by a grazing sun, the share that is black."""
    sun = Light(SUN, np.pi, np.pi, np.pi, direction_x=1.0, direction_y=0.0, direction_z=0.05)
    scene = new_scene([WHITE], lights=[sun], accel=accel)
    vertices, triangles, normals = smooth_ball()
    add_object(scene, (vertices, triangles), normals=normals)
    settings = film(count, 0, seed)
    pixels = picture(scene, settings, Camera(half_width=1.1))
    side = settings.width
    x, y = (np.arange(side) + 0.5) / side * 2.2 - 1.1, (np.arange(side) + 0.5) / side * 2.2 - 1.1
    x, y = np.meshgrid(x, y)
    inside = x * x + y * y < 0.85
    z = np.sqrt(np.maximum(1 - x * x - y * y, 0))
    lit = inside & (x + 0.05 * z > 0.02)
    black = lit & (pixels[..., 0] <= 0)
    share = black.sum() / lit.sum()
    return Outcome(int(share > 0.02), 1, f"{100 * share:.1f} % of lit pixels black")


def smooth_furnace(accel: str, count: int, seed: int = 0) -> Outcome:
    """S10: the same ball, white in a white world: nowhere brighter, and its mean."""
    scene = new_scene([WHITE], world=1.0, accel=accel)
    vertices, triangles, normals = smooth_ball()
    add_object(scene, (vertices, triangles), normals=normals)
    pixels = picture(scene, film(count, 16, seed), Camera(half_width=0.6))[..., 0].astype(np.float64)
    noise = 4 * pixels.std() / np.sqrt(pixels.size)
    return Outcome(int(not pixels.mean() <= 1 + 1e-3 + noise), 1, f"mean {pixels.mean():.4f}")


def cases() -> Iterator[Case]:
    """S01, S02, S09, S10."""
    for scale in (1e-6, 1e-3, 1.0, 1e3, 1e6):
        for shape in ("mesh", "sphere"):
            yield Case("S01", f"{shape} of radius {scale:g}", white_ball(scale, 0, shape, 1e-6),
                       (*INDICES, PICTURES), PICTURE, 4000)  # fmt: skip
    for offset in (1e2, 1e4, 1e5):
        for shape in ("mesh", "sphere"):
            yield Case("S02", f"{shape} at {offset:g} radii", white_ball(1, offset, shape, 1e-5),
                       (*INDICES, PICTURES), PICTURE, 4000)  # fmt: skip
    for name in TRANSFORMS:
        yield Case("S09", f"{name}, leaks", instance_leaks(name), ACCELS, 1_000_000, 2000)
        yield Case("S09", f"{name}, as baked", as_baked(name), ACCELS, 100_000, 2000)
    yield Case("S10", "grazing sun", terminator, ONCE, 4_000_000, 40_000)
    yield Case("S10", "white in white", smooth_furnace, ONCE, PICTURE, 20_000)

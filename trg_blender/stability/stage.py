"""Little scenes built straight on trg_native, or told to the reference renderer, and their pictures."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..engine.native import load_native
from ..engine.scene_arrays import LIGHT_FIELDS, MATERIAL_FIELDS, Light, Material, pack_table
from .told import ToldScene

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]
SUN, POINT, SPOT, RECTANGLE, ELLIPSE = range(5)
WHITE = Material(1.0, 1.0, 1.0, specular=0.0)
GREY = Material(0.5, 0.5, 0.5, specular=0.0)
BLACK = Material(0.0, 0.0, 0.0, specular=0.0)
GLOW = Material(0.0, 0.0, 0.0, specular=0.0, emission_r=1.0, emission_g=1.0, emission_b=1.0)


@dataclass
class Camera:
    """Looks from `eye` along -Z of `axes` (columns x, y, z)."""

    eye: tuple[float, float, float] = (0.0, 0.0, 3.0)
    axes: Float64 = field(default_factory=lambda: np.eye(3))
    half_width: float = 1.0
    kind: int = 1
    clip: tuple[float, float] = (1e-6, 1e30)

    def apply(self, scene: Any) -> None:
        matrix = np.column_stack([self.axes, np.array(self.eye)])
        w = self.half_width
        scene.set_camera(self.kind, matrix, np.array([-w, w, -w, w]), *self.clip)


@dataclass
class Settings:
    width: int = 32
    height: int = 32
    samples: int = 64
    seed: int = 1
    bounces: int = 8
    threads: int = 2
    passes: tuple[str, ...] = ()
    border: tuple[int, int, int, int] | None = None


def make_sphere(rings: int = 48) -> tuple[Float32, NDArray[np.int32]]:
    """Vertices and triangles of a unit sphere, outside counter-clockwise."""
    polar = np.linspace(0.0, np.pi, rings + 1)
    around = np.linspace(0.0, 2.0 * np.pi, 2 * rings, endpoint=False)
    t, p = (a.ravel() for a in np.meshgrid(polar, around, indexing="ij"))
    vertices = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=1)
    ring, step = (a.ravel() for a in np.meshgrid(np.arange(rings), np.arange(2 * rings), indexing="ij"))
    a, b = ring * 2 * rings + step, ring * 2 * rings + (step + 1) % (2 * rings)
    c, d = a + 2 * rings, b + 2 * rings
    upper, lower = np.stack([a, c, b], axis=1)[ring > 0], np.stack([b, c, d], axis=1)[ring < rings - 1]
    return vertices.astype(np.float32), np.concatenate([upper, lower]).astype(np.int32)


def make_floor(half: float = 1.0, z: float = 0.0) -> tuple[Float32, NDArray[np.int32]]:
    """A square that faces +Z."""
    corners = [(-half, -half, z), (half, -half, z), (half, half, z), (-half, half, z)]
    return np.array(corners, np.float32), np.array([(0, 1, 2), (0, 2, 3)], np.int32)


def new_scene(
    materials: list[Material], world: float = 0.0, lights: list[Light] | None = None, accel: str = "auto"
) -> Any:
    """A trg_native.Scene, or for `embree` one that takes the same calls for the reference renderer."""
    if accel == "embree":
        return ToldScene(materials, lights or [], (world, world, world))
    scene = load_native().Scene(accel)
    scene.set_materials(pack_table(materials, MATERIAL_FIELDS))
    scene.set_lights(pack_table(lights or [], LIGHT_FIELDS))
    scene.set_world(world, world, world)
    return scene


def add_object(
    scene: Any,
    shape: tuple[Float32, NDArray[np.int32]],
    material: int = 0,
    transform: Float32 | None = None,
    normals: Float32 | None = None,
) -> None:
    mesh = scene.add_mesh(shape[0], shape[1], normals, None, None)
    scene.add_instance(mesh, transform, np.array([material], np.int32))


def place(x: float, y: float, z: float, scale: float = 1.0) -> Float32:
    return np.column_stack([np.eye(3) * scale, (x, y, z)]).astype(np.float32)


class RejectedSamples(Exception):
    """Samples of a row's picture were not finite."""

    def __init__(self, count: int) -> None:
        super().__init__(f"{count} samples are not finite")


def start(scene: Any, settings: Settings) -> Any:
    return scene.start_render(
        settings.width,
        settings.height,
        settings.samples,
        settings.seed,
        settings.bounces,
        settings.threads,
        settings.passes,
        settings.border,
    )


def finish(job: Any) -> dict[str, Any]:
    """The last state of the job."""
    while not (state := job.poll(1.0))["done"]:
        pass
    return dict(state)


def film_size(settings: Settings) -> tuple[int, int]:
    if settings.border is None:
        return settings.height, settings.width
    x_min, y_min, x_max, y_max = settings.border
    return y_max - y_min, x_max - x_min


def picture(scene: Any, settings: Settings, camera: Camera | None = None) -> Float32:
    """(h, w, 4) of the finished render; the scene is built first. Raises RejectedSamples."""
    (camera or Camera()).apply(scene)
    scene.build(1)
    job = start(scene, settings)
    if rejected := finish(job)["rejected_samples"]:
        raise RejectedSamples(rejected)
    out = np.full((*film_size(settings), 4), np.nan, np.float32)
    job.combined(out)
    return out

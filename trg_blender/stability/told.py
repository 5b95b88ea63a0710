"""A scene that is told as trg_native is, and rendered by the reference renderer."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..engine.scene_arrays import (
    Camera,
    Environment,
    Float32,
    Float64,
    InstanceArrays,
    Int32,
    Light,
    Material,
    MeshArrays,
    RenderSettings,
    SceneArrays,
)
from ..engine.session import start_reference

NO_VERTICES, NO_TRIANGLES = np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32)


class ToldScene:
    """The methods of trg_native.Scene that rows call. Rendering raises ImportError without embreex."""

    def __init__(
        self, materials: list[Material], lights: list[Light], world: tuple[float, float, float]
    ) -> None:
        camera = Camera(1, np.eye(3, 4), (-1.0, 1.0, -1.0, 1.0))
        self._scene = SceneArrays(camera, materials=list(materials), lights=list(lights), world=world)

    def add_mesh(
        self,
        vertices: Float32,
        triangles: Int32,
        normals: Float32 | None = None,
        uvs: Float32 | None = None,
        slots: Int32 | None = None,
    ) -> int:
        return self._add(MeshArrays(vertices, triangles, normals, uvs, slots))

    def add_sphere(self) -> int:
        return self._add(MeshArrays(NO_VERTICES, NO_TRIANGLES, shape="sphere"))

    def add_plane(self) -> int:
        return self._add(MeshArrays(NO_VERTICES, NO_TRIANGLES, shape="plane"))

    def add_instance(
        self, mesh: int, transform: Float32 | None = None, materials: Int32 | None = None
    ) -> None:
        matrix = np.eye(3, 4, dtype=np.float32) if transform is None else transform
        slots = np.zeros(1, np.int32) if materials is None else materials
        self._scene.instances.append(InstanceArrays(mesh, matrix[None], slots))

    def set_environment(self, pixels: Float32, rotation: Float64, seen: bool = True) -> None:
        self._scene.environment = Environment(pixels, rotation, seen)

    def set_camera(
        self, kind: int, matrix: Float64, window: Float64, clip_start: float, clip_end: float
    ) -> None:
        left, right, bottom, top = (float(value) for value in window)
        self._scene.camera = Camera(kind, matrix, (left, right, bottom, top), clip_start, clip_end)

    def build(self, threads: int = 0) -> None:
        """Nothing to do before the render starts."""

    def start_render(self, width: int, height: int, samples: int, seed: int, bounces: int, *rest: Any) -> Any:
        """A job of the reference renderer; `rest` is threads, passes, border."""
        _, passes, border = rest
        settings = RenderSettings(
            width, height, samples, seed, max_bounces=bounces, device="embree", passes=passes, border=border
        )
        return start_reference(self._scene, settings).job

    def _add(self, mesh: MeshArrays) -> int:
        self._scene.meshes.append(mesh)
        return len(self._scene.meshes) - 1

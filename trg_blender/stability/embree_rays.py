"""Rays against one mesh through embreex, with the methods of RayScene that rows need."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..engine.native import Hits

Float32 = NDArray[np.float32]
FAR = 1e37


class EmbreeRays:
    """Embree in its robust mode, as the reference renderer uses it. Raises ImportError without embreex."""

    def __init__(self, vertices: Float32, triangles: NDArray[np.int32]) -> None:
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        self._scene = EmbreeScene(robust=True)
        self._corners = np.ascontiguousarray(vertices[triangles].reshape(-1, 3), np.float32)
        TriangleMesh(self._scene, self._corners, np.arange(len(self._corners), dtype=np.int32).reshape(-1, 3))

    def intersect(self, origins: Float32, directions: Float32) -> Hits:
        """Nearest hits of rays float32 (n, 3) that begin at t = 0."""
        found = self._run(origins, directions, "INTERSECT", True)
        triangle = np.asarray(found["primID"], np.int32)
        met = triangle >= 0
        t = np.where(met, found["tfar"], np.inf).astype(np.float32)
        u, v = (np.where(met, found[name], 0).astype(np.float32) for name in ("u", "v"))
        return Hits(t, u, v, triangle, np.where(met, 0, -1).astype(np.int32))

    def occluded(self, origins: Float32, directions: Float32) -> NDArray[np.bool_]:
        """(n,) true where a ray meets anything."""
        return np.asarray(self._run(origins, directions, "OCCLUDED", False)) >= 0

    def _run(self, origins: Float32, directions: Float32, query: str, output: bool) -> object:
        far = np.full(len(origins), FAR, np.float32)
        rays = (np.ascontiguousarray(rows, np.float32) for rows in (origins, directions))
        return self._scene.run(*rays, far, query, output)

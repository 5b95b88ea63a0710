"""Surfaces that lie exactly upon one another (row S06 of the catalogue): found by their numbers alone.

Of two coincident surfaces rays meet one, and which one is nobody's intention: a warning says where.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from .scene_arrays import Float32, InstanceArrays, MeshArrays, SceneArrays

MOST_TRIANGLES = 100_000
"""Larger meshes are not searched: it would cost more than it is worth."""
ODD = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], np.uint64)


def coincidence_warnings(scene: SceneArrays) -> Iterator[str]:
    """One for each mesh with triangles that are there twice, and for each pair of equal objects in one
    place."""
    for mesh in scene.meshes:
        if mesh.shape == "triangles" and len(mesh.triangles) <= MOST_TRIANGLES:
            double = double_triangles(mesh)
            if double:
                yield f"mesh {mesh.origin!r}: {double} triangles lie exactly on others of the same mesh"
    kinds = same_meshes(scene.meshes)
    seen: dict[tuple[int, int], str] = {}
    for instance in scene.instances:
        yield from double_copies(instance, kinds[instance.mesh], seen)


def double_triangles(mesh: MeshArrays) -> int:
    """How many have the three places of another one before them."""
    if len(mesh.triangles) < 2:
        return 0
    # The sum does not depend on the order of the corners, so it finds turned triangles, too.
    keys = mixed(place_keys(mesh.vertices))[mesh.triangles].sum(axis=1)
    return len(keys) - len(np.unique(keys))


def place_keys(places: Float32) -> NDArray[np.uint64]:
    """(n,) numbers that are equal for equal places (n, 3)."""
    bits = (np.ascontiguousarray(places, np.float32) + np.float32(0.0)).view(np.uint32)
    return (bits.astype(np.uint64) * ODD).sum(axis=1, dtype=np.uint64)


def mixed(keys: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """Bits well stirred, so that sums of keys are equal for equal sets alone."""
    keys = (keys ^ (keys >> np.uint64(31))) * ODD[0]
    return (keys ^ (keys >> np.uint64(29))) * ODD[1]


def same_meshes(meshes: list[MeshArrays]) -> list[int]:
    """For each mesh the first one that has the same triangles."""
    found: dict[tuple[str, int, int, int], int] = {}
    kinds = []
    for number, mesh in enumerate(meshes):
        few = mesh.vertices[:64]
        key = (mesh.shape, len(mesh.vertices), len(mesh.triangles), int(mixed(place_keys(few)).sum()))
        first = found.setdefault(key, number)
        other = meshes[first]
        same = np.array_equal(other.vertices, mesh.vertices)
        kinds.append(first if same and np.array_equal(other.triangles, mesh.triangles) else number)
    return kinds


def double_copies(instance: InstanceArrays, kind: int, seen: dict[tuple[int, int], str]) -> Iterator[str]:
    """Copies where an equal one stands already; `seen` remembers who stands where."""
    rows = np.ascontiguousarray(instance.transforms, np.float32).reshape(-1, 4, 3)
    keys = (
        mixed(place_keys(rows.reshape(-1, 3))).reshape(-1, 4) * (ODD[0] + np.arange(4, dtype=np.uint64) * 2)
    ).sum(axis=1)
    unique = np.unique(keys)
    if len(unique) < len(keys):
        yield f"object {instance.origin!r}: {len(keys) - len(unique)} copies lie exactly on others"
    others = {seen[kind, int(key)] for key in unique if (kind, int(key)) in seen}
    for other in sorted(others):
        yield f"objects {other!r} and {instance.origin!r}: the same mesh in the same place"
    seen.update(((kind, int(key)), instance.origin) for key in unique)

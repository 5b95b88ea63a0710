"""The scene of the reference renderer: instances baked to world triangles, hits refined in float64,
spheres and planes met beside them.

Embree finds which triangle a ray meets, in float32; distance and barycentrics are computed again from
that triangle in float64, so that only the choice of the triangle rests on single precision.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .reference_math import dot, normalize
from .reference_shapes import Shape, each_copy, meet_shape, place_shapes
from .scene_arrays import EVERY_RAY, Float64, InstanceArrays, MeshArrays, SceneArrays

MISS = -1
MOST_HIDDEN = 4096
FAR = 1e37
"""Where Embree's rays end."""


@dataclass(frozen=True, slots=True)
class Triangles:
    """All triangles of all instances in world space, then a row without area for each shape."""

    corners: Float64
    """(n, 3, 3)"""
    outside: Float64
    """(n, 3) unit geometric normals on the side that the artist sees as outside"""
    normals: Float64
    """(n, 3, 3) corner normals by the inverse transpose; rows of flat triangles repeat `outside`"""
    uvs: Float64
    """(n, 3, 2)"""
    material: NDArray[np.int64]
    """(n,) index into SceneArrays.materials"""
    area: Float64
    """(n,)"""
    copy: NDArray[np.int64]
    """(n,) which of the scene's copies of meshes, counted over all instances, it belongs to"""
    face: NDArray[np.int64]
    """(n,) its number in its mesh"""
    shapes: tuple[Shape, ...] = ()
    """what the last rows stand for: shape k is row `first_shape` + k"""

    @property
    def first_shape(self) -> int:
        return len(self.area) - len(self.shapes)


@dataclass(frozen=True, slots=True)
class Rays:
    origin: Float64
    """(n, 3)"""
    direction: Float64
    """(n, 3) unit"""
    far: Float64
    """(n,) hits beyond it do not count"""
    mask: NDArray[np.uint8] | None = None
    """(n,) bits of the instances that they meet; None: all"""


@dataclass(frozen=True, slots=True)
class Hits:
    triangle: NDArray[np.int64]
    """(n,) or MISS"""
    t: Float64
    """(n,) inf for a miss"""
    u: Float64
    v: Float64
    """weights of the second and third corner; coordinates on a shape"""


@dataclass(frozen=True, slots=True)
class TracedScene:
    triangles: Triangles
    embree: Any
    """embreex.rtcore_scene.EmbreeScene, or None when there is no triangle"""
    masks: NDArray[np.uint8] | None = None
    """(copies,) of the instances; None where all rays meet all"""

    def intersect(self, rays: Rays) -> Hits:
        """The nearest hit of each ray with what it may meet."""
        hits = self._nearest(rays)
        if self.masks is None or rays.mask is None:
            return hits
        for _ in range(MOST_HIDDEN):
            met = hits.triangle != MISS
            unseen = (self.masks[self.triangles.copy[hits.triangle]] & rays.mask) == 0
            rows = np.flatnonzero(met & unseen)
            if len(rows) == 0:
                break
            hits = look_beyond(self._nearest, rays, hits, rows)
        return hits

    def _nearest(self, rays: Rays) -> Hits:
        count = len(rays.origin)
        if self.embree is None or count == 0:
            miss = np.full(count, MISS, dtype=np.int64)
            hits = Hits(miss, np.full(count, np.inf), np.zeros(count), np.zeros(count))
        else:
            found = self._run(rays, "INTERSECT", output=True)
            hits = refine_hits(self.triangles, rays, found["primID"].astype(np.int64))
        return nearer_shapes(self.triangles, rays, hits)

    def occluded(self, rays: Rays) -> NDArray[np.bool_]:
        """Whether anything stands between origin and `far`."""
        if self.masks is not None:
            return np.asarray(self.intersect(rays).triangle != MISS)
        hidden = np.zeros(len(rays.origin), dtype=bool)
        if self.embree is not None and len(rays.origin):
            hidden |= np.asarray(self._run(rays, "OCCLUDED", output=False)) != MISS
        for shape in self.triangles.shapes:
            hidden |= np.isfinite(meet_shape(shape, rays.origin, rays.direction, rays.far).t)
        return hidden

    def _run(self, rays: Rays, query: str, output: bool) -> Any:
        origin = np.ascontiguousarray(rays.origin, dtype=np.float32)
        direction = np.ascontiguousarray(rays.direction, dtype=np.float32)
        far = np.minimum(rays.far, FAR).astype(np.float32)
        return self.embree.run(origin, direction, far, query, output)


def refine_hits(triangles: Triangles, rays: Rays, index: NDArray[np.int64]) -> Hits:
    """Distance and barycentrics of the known triangles in float64 (Moeller and Trumbore 1997)."""
    corners = triangles.corners[index]
    edge1, edge2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    p = np.cross(rays.direction, edge2)
    determinant = dot(edge1, p)
    inverse = 1.0 / np.where(determinant == 0.0, np.inf, determinant)
    offset = rays.origin - corners[:, 0]
    q = np.cross(offset, edge1)
    hit = index != MISS
    t = np.where(hit, np.maximum(dot(edge2, q) * inverse, 0.0), np.inf)
    return Hits(index, t, dot(offset, p) * inverse, dot(rays.direction, q) * inverse)


def nearer_shapes(triangles: Triangles, rays: Rays, hits: Hits) -> Hits:
    """`hits`, replaced where a shape is met before."""
    for number, shape in enumerate(triangles.shapes):
        met = meet_shape(shape, rays.origin, rays.direction, np.minimum(rays.far, hits.t))
        nearer = np.isfinite(met.t)
        row = triangles.first_shape + number
        hits = Hits(
            np.where(nearer, row, hits.triangle),
            np.where(nearer, met.t, hits.t),
            np.where(nearer, met.u, hits.u),
            np.where(nearer, met.v, hits.v),
        )
    return hits


def look_beyond(find: Callable[[Rays], Hits], rays: Rays, hits: Hits, rows: NDArray[np.int64]) -> Hits:
    """`hits` with those of `rows` replaced by what `find` finds behind them; distances are from the rays'
    start."""
    origin, direction = rays.origin[rows], rays.direction[rows]
    place = origin + hits.t[rows, None] * direction
    step = hits.t[rows] + 1e-6 + 4e-6 * np.abs(place).max(axis=1, initial=0.0)
    left = np.maximum(rays.far[rows] - step, 0.0)
    mask = None if rays.mask is None else rays.mask[rows]
    found = find(Rays(origin + step[:, None] * direction, direction, left, mask))
    parts = [part.copy() for part in (hits.triangle, hits.t, hits.u, hits.v)]
    for part, new in zip(parts, (found.triangle, found.t + step, found.u, found.v), strict=True):
        part[rows] = new
    return Hits(*parts)


def masks_of(scene: SceneArrays) -> NDArray[np.uint8] | None:
    """(copies,) of all instances; None where all rays meet all."""
    if all(one.mask == EVERY_RAY for one in scene.instances):
        return None
    copies = [len(one.transforms) for one in scene.instances]
    return np.repeat(np.array([one.mask for one in scene.instances], np.uint8), copies)


def with_shapes(triangles: Triangles, shapes: tuple[Shape, ...]) -> Triangles:
    count = len(shapes)
    zero = np.zeros((count, 3, 3))
    rows = Triangles(
        zero,
        np.zeros((count, 3)),
        zero,
        np.zeros((count, 3, 2)),
        np.array([shape.material for shape in shapes], dtype=np.int64),
        np.zeros(count),
        np.array([shape.copy for shape in shapes], dtype=np.int64),
        np.zeros(count, np.int64),
    )
    return replace(join_triangles([triangles, rows]), shapes=shapes)


def build_traced_scene(scene: SceneArrays) -> TracedScene:
    """Bakes the instances and hands them to Embree.

    Triangles with non-finite corners or without area are left out. Raises ImportError without embreex.
    """
    from embreex.mesh_construction import TriangleMesh
    from embreex.rtcore_scene import EmbreeScene

    parts = [
        bake_instance(scene.meshes[one.mesh], one, transform, copy)
        for copy, (one, transform) in enumerate(each_copy(scene))
        if scene.meshes[one.mesh].shape == "triangles"
    ]
    triangles = join_triangles(parts)
    shapes = tuple(place_shapes(scene))
    if len(triangles.area) == 0:
        return TracedScene(with_shapes(triangles, shapes), None, masks_of(scene))
    embree = EmbreeScene(robust=True)
    indices = np.arange(3 * len(triangles.area), dtype=np.int32).reshape(-1, 3)
    TriangleMesh(embree, np.ascontiguousarray(triangles.corners.reshape(-1, 3), dtype=np.float32), indices)
    return TracedScene(with_shapes(triangles, shapes), embree, masks_of(scene))


def bake_instance(mesh: MeshArrays, instance: InstanceArrays, transform: Float64, copy: int) -> Triangles:
    """The world triangles of copy number `copy`; `transform` is (3, 4) object to world."""
    linear = transform[:, :3]
    world = np.asarray(mesh.vertices, dtype=np.float64) @ linear.T + transform[:, 3]
    corners = world[mesh.triangles].reshape(-1, 3, 3)
    # A mirrored copy turns the winding; the sign keeps the artist's outside.
    side = -1.0 if np.linalg.det(linear) < 0.0 else 1.0
    cross = side * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    outside = normalize(cross)
    count = len(corners)
    if mesh.normals is None:
        normals = np.repeat(outside[:, None, :], 3, axis=1)
    else:
        normals = np.asarray(mesh.normals, dtype=np.float64) @ np.linalg.pinv(linear)
    uvs = np.zeros((count, 3, 2)) if mesh.uvs is None else np.asarray(mesh.uvs, dtype=np.float64)
    slots = np.zeros(count, dtype=np.int64) if mesh.slots is None else np.asarray(mesh.slots, dtype=np.int64)
    # As in Blender, a slot beyond the last means the last.
    slot_materials = np.asarray(instance.slot_materials, dtype=np.int64)
    material = slot_materials[np.minimum(slots, len(slot_materials) - 1)].reshape(count)
    area = 0.5 * np.linalg.norm(cross, axis=1)
    with np.errstate(invalid="ignore"):
        keep = np.isfinite(corners).all(axis=(1, 2)) & (area > 0.0)
    face = np.flatnonzero(keep)
    return Triangles(
        corners[keep],
        outside[keep],
        normals[keep],
        uvs[keep],
        material[keep],
        area[keep],
        np.full(len(face), copy, np.int64),
        face,
    )


def join_triangles(parts: list[Triangles]) -> Triangles:
    """One after the other; no part gives empty arrays."""
    if not parts:
        zero, none = np.zeros((0, 3, 3)), np.zeros(0, np.int64)
        return Triangles(zero, np.zeros((0, 3)), zero, np.zeros((0, 3, 2)), none, np.zeros(0), none, none)
    names = [one.name for one in fields(Triangles) if one.name != "shapes"]
    return Triangles(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))

"""Points on surfaces as texture programs of the reference renderer see them, and what lies beside them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .reference_math import dot, normalize
from .reference_scene import Triangles
from .scene_arrays import CAMERA_KINDS, Camera, Float64, SceneArrays


@dataclass(frozen=True, slots=True)
class Copies:
    """Every copy of a mesh, in the order of Triangles.copy."""

    mesh: NDArray[np.int64]
    """(c,) index into SceneArrays.meshes"""
    linear: Float64
    """(c, 3, 3) of object to world"""
    translation: Float64
    inverse: Float64
    """(c, 3, 3) of `linear`"""
    random: Float64
    """(c,) 0 to 1"""


def build_copies(scene: SceneArrays) -> Copies:
    mesh, transforms, randoms = [], [], []
    for one in scene.instances:
        count = len(one.transforms)
        mesh += [one.mesh] * count
        transforms.append(np.asarray(one.transforms, np.float64).reshape(count, 3, 4))
        randoms.append(np.zeros(count) if one.randoms is None else np.asarray(one.randoms, np.float64))
    placed = np.concatenate([np.zeros((0, 3, 4)), *transforms])
    linear = placed[:, :, :3]
    inverse = np.linalg.pinv(linear) if len(linear) else linear
    return Copies(
        np.array(mesh, np.int64), linear, placed[:, :, 3], inverse, np.concatenate([np.zeros(0), *randoms])
    )


@dataclass(frozen=True, slots=True)
class Points:
    """n places on surfaces, each seen from somewhere."""

    triangle: NDArray[np.int64]
    """(n,) row of Triangles"""
    b1: Float64
    b2: Float64
    """weights of the second and third corner"""
    uv: Float64
    """(n, 2)"""
    position: Float64
    normal: Float64
    """(n, 3) unit shading normal, on the viewer's side"""
    flat: Float64
    """(n, 3) unit geometric normal, on the viewer's side"""
    wo: Float64
    """(n, 3) unit, to the viewer"""
    outside: NDArray[np.bool_]
    """whether the viewer is"""

    def take(self, rows: NDArray[np.bool_]) -> Points:
        return Points(*(getattr(self, name)[rows] for name in Points.__slots__))


@dataclass(frozen=True, slots=True)
class PointSpace:
    """What of a scene its points rest on."""

    scene: SceneArrays
    triangles: Triangles
    copies: Copies
    pixel_spread: float
    """a pixel's side, at distance 1 where the camera is not orthographic"""

    def copy_of(self, points: Points) -> NDArray[np.int64]:
        return self.triangles.copy[points.triangle]

    def local(self, points: Points) -> Float64:
        """(n, 3) the points in their objects' spaces"""
        copy = self.copy_of(points)
        offset = points.position - self.copies.translation[copy]
        return np.einsum("nij,nj->ni", self.copies.inverse[copy], offset)

    def normals_into(self, points: Points, normals: Float64) -> Float64:
        """World normals in the objects' spaces, unit."""
        linear = self.copies.linear[self.copy_of(points)]
        return normalize(np.einsum("nij,ni->nj", linear, normals))

    def normals_out_of(self, points: Points, normals: Float64) -> Float64:
        """Objects' normals in the world, unit."""
        inverse = self.copies.inverse[self.copy_of(points)]
        return normalize(np.einsum("nij,ni->nj", inverse, normals))

    def step(self, points: Points) -> Float64:
        """(n,) how far away bumps look for their slope: docs/architecture.md, section 4"""
        camera: Camera = self.scene.camera
        origin = np.asarray(camera.matrix, np.float64)[:, 3]
        distance = np.linalg.norm(points.position - origin, axis=1)
        if CAMERA_KINDS[camera.kind] == "orthographic":
            distance = np.ones_like(distance)
        least = 2e-4 * np.abs(points.position).max(axis=1, initial=0.0) + 1e-9
        return np.maximum(self.pixel_spread * distance, least)

    def attribute(self, points: Points, number: int) -> Float64:
        """(n, 4) corner attribute `number`; (0, 0, 0, 1) where a mesh has none."""
        out = np.tile([0.0, 0.0, 0.0, 1.0], (len(points.b1), 1))
        if number == 0:
            out[:, :2] = points.uv
            return out
        meshes = self.copies.mesh[self.copy_of(points)]
        weights = np.stack([1.0 - points.b1 - points.b2, points.b1, points.b2], axis=1)
        for mesh in np.unique(meshes):
            values = self.scene.meshes[mesh].attributes.get(number)
            if values is None:
                continue
            rows = meshes == mesh
            corners = np.asarray(values, np.float64)[self.triangles.face[points.triangle[rows]]]
            out[rows, : corners.shape[2]] = np.einsum("nc,nck->nk", weights[rows], corners)
        return out

    def generated(self, points: Points) -> Float64:
        """(n, 3) places in the meshes' texture spaces"""
        meshes = self.copies.mesh[self.copy_of(points)]
        out = self.local(points)
        for mesh in np.unique(meshes):
            space = self.scene.meshes[mesh].texture_space
            if space is not None:
                rows = meshes == mesh
                out[rows] = out[rows] * np.asarray(space[0]) + np.asarray(space[1])
        return out

    def move(self, points: Points, by: Float64) -> Points:
        """The points moved by the small vectors `by` (n, 3) along their surfaces."""
        corners = self.triangles.corners[points.triangle]
        edge1, edge2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        aa, ab, bb = dot(edge1, edge1), dot(edge1, edge2), dot(edge2, edge2)
        a, b, det = dot(by, edge1), dot(by, edge2), aa * bb - ab * ab
        usable = det > 0.0
        whole = np.where(usable, det, 1.0)
        d1 = np.where(usable, (a * bb - b * ab) / whole, 0.0)
        d2 = np.where(usable, (b * aa - a * ab) / whole, 0.0)
        uvs = self.triangles.uvs[points.triangle]
        uv = points.uv + d1[:, None] * (uvs[:, 1] - uvs[:, 0]) + d2[:, None] * (uvs[:, 2] - uvs[:, 0])
        moved = replace(points, position=points.position + by, b1=points.b1 + d1, b2=points.b2 + d2, uv=uv)
        rows = points.triangle >= self.triangles.first_shape
        if rows.any():
            moved.uv[rows] = self._shape_uv(moved.take(rows))
        return moved

    def _shape_uv(self, points: Points) -> Float64:
        p = self.local(points)
        meshes = self.copies.mesh[self.copy_of(points)]
        plane = np.array([self.scene.meshes[mesh].shape == "plane" for mesh in meshes])
        u = np.arctan2(p[:, 0], -p[:, 1]) / (2.0 * np.pi) % 1.0
        v = 0.5 + np.arctan2(p[:, 2], np.hypot(p[:, 0], p[:, 1])) / np.pi
        return np.where(plane[:, None], p[:, :2], np.stack([u, v], axis=1))

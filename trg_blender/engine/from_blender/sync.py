"""The whole scene in one call: the parts of this package put together."""

from __future__ import annotations

from dataclasses import dataclass, field

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from ..errors import SceneError
from ..scene_arrays import Camera, Float32, Identity, InstanceArrays, MeshArrays, SceneArrays
from .camera import read_camera
from .classic import read_ambient
from .identities import NEEDS_IDENTITIES, read_identities, read_pass_data
from .known_data import KnownData, KnownMeshes
from .lights import read_light
from .materials import MaterialTable
from .meshes import MeshRequest, read_mesh
from .motion import FrameSet, Motion, read_motion, shutter_of
from .objects import Found, MeshGroup, find_objects
from .shapes import is_unedited

FLAT_DETERMINANT = 1e-18
"""Instances squeezed flatter than this are stored in world space: no renderer can invert them."""


@dataclass(slots=True)
class SceneReader:
    """Reads depsgraphs."""

    fast: bool = True
    """look at Blender's mesh arrays in place where that is safe"""

    passes: tuple[str, ...] = ()
    """those that will be asked for: some need names or UV maps that are else left out"""
    frame_set: FrameSet | None = None
    """moves the depsgraph in time, for motion blur; None: there is none"""
    camera: Camera | None = None
    """takes the place of the scene's, which need not have one then"""
    known: KnownData | None = None
    """meshes, images and world of the reading before; what is unchanged is the same object again"""

    def read(
        self, scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph, size: tuple[int, int]
    ) -> SceneArrays:
        """Arrays for a picture of `size` pixels; they own their memory.

        `scene` is the evaluated scene. Raises SceneError when there is nothing to render from: no
        camera, or a picture without pixels. Anything merely not supported is a line in `warnings`.
        """
        if size[0] < 1 or size[1] < 1:
            raise SceneError(f"the picture of scene {scene.name!r} has no pixels ({size[0]} x {size[1]})")
        warnings: list[str] = []
        shutter = shutter_of(scene, warnings) if self.frame_set is not None else None
        if shutter is None or self.frame_set is None:
            return self._read(scene, depsgraph, size, (None, warnings))
        try:
            motion = read_motion(depsgraph, shutter, self.frame_set, warnings)
            return self._read(scene, depsgraph, size, (motion, warnings))
        finally:
            self.frame_set(shutter.now)

    def _read(
        self,
        scene: bpy.types.Scene,
        depsgraph: bpy.types.Depsgraph,
        size: tuple[int, int],
        beside: tuple[Motion | None, list[str]],
    ) -> SceneArrays:
        motion, warnings = beside
        known = self.known or KnownData()
        known.begin(depsgraph)
        camera = self.camera or read_camera(scene, depsgraph, size, warnings)
        camera.motion = None if motion is None else motion.camera
        found = find_objects(depsgraph, warnings)
        table = MaterialTable(warnings)
        table.textures.pool.known = known.images
        world = known.world(scene.world, warnings)
        arrays = SceneArrays(
            camera=camera,
            world=world.color,
            environment=world.environment,
            ambient=read_ambient(scene.world),
            transparent_film=scene.render.film_transparent,
        )
        identities = read_identities(depsgraph) if NEEDS_IDENTITIES.intersection(self.passes) else []
        meshes = _Meshes(arrays, table, self.fast, warnings, "uv" in self.passes, identities, motion)
        meshes.store = known.meshes
        meshes.add_all(found)
        known.end()
        if world.sun is not None:
            arrays.lights.append(world.sun)
        for owner, row in found.lights:
            light = read_light(owner, _matrix(found.transforms[row]), warnings)
            if light is not None:
                arrays.lights.append(light)
        arrays.materials, arrays.classic = table.rows, table.classic
        arrays.pass_data = read_pass_data(scene, depsgraph.view_layer_eval, table.identities, self.passes)
        textures = table.textures
        arrays.textures, arrays.images = textures.textures, textures.pool.images
        arrays.programs, arrays.attributes = textures.programs.arrays(), textures.attributes
        arrays.warnings = list(dict.fromkeys(warnings))
        return arrays


def _matrix(rows: Float32) -> Matrix:
    return Matrix([*rows.tolist(), [0.0, 0.0, 0.0, 1.0]])


@dataclass(slots=True)
class _Meshes:
    """Turns groups into meshes and instances; a mesh used by several groups is read once."""

    arrays: SceneArrays
    table: MaterialTable
    fast: bool
    warnings: list[str]
    with_uvs: bool
    """of every mesh, whether its materials ask for them or not"""
    identities: list[Identity]
    """by rows of Found.transforms; empty when no pass needs them"""
    motion: Motion | None = None
    known: dict[tuple[int, int, tuple[int, ...], str], int] = field(default_factory=dict)
    store: KnownMeshes = field(default_factory=KnownMeshes)

    def add_all(self, found: Found) -> None:
        for group in found.groups:
            identities = np.array([self.identities[row] for row in group.rows if self.identities], object)
            self._add(group, found.transforms[group.rows], found.randoms[group.rows], identities)

    def _motion(self, group: MeshGroup, kept: np.ndarray) -> Float32 | None:
        """Of the instances of a group that are kept."""
        rows = [row for row, keep in zip(group.rows, kept, strict=True) if keep]
        return None if self.motion is None else self.motion.of(rows)

    def _add(
        self, group: MeshGroup, transforms: Float32, randoms: Float32, identities: NDArray[np.object_]
    ) -> None:
        slots = tuple(self.table.add(material, group.medium) for material in group.materials)
        index = self._mesh(group, slots)
        mesh = self.arrays.meshes[index]
        if not len(mesh.triangles):
            return
        finite = np.isfinite(transforms).all(axis=(1, 2))
        if not finite.all():
            self.warnings.append(f"object {group.origin!r}: a transform that is not finite is left out")
            transforms, randoms = transforms[finite], randoms[finite]
            identities = identities[finite] if len(identities) else identities
        volume = np.abs(np.linalg.det(transforms[:, :, :3].astype(np.float64)))
        has_volume = volume > FLAT_DETERMINANT
        solid = transforms[has_volume]
        kept = finite.copy()
        kept[finite] = has_volume
        materials = np.array(slots, np.int32)
        if len(solid):
            self.arrays.instances.append(
                InstanceArrays(
                    index,
                    np.ascontiguousarray(solid),
                    materials,
                    group.origin,
                    randoms[has_volume],
                    tuple(identities[has_volume]) if len(identities) else (),
                    self._motion(group, kept),
                    group.mask,
                    group.holdout,
                )
            )
        for row in np.flatnonzero(~has_volume):
            who = tuple(identities[row : row + 1])
            self._add_flat(mesh, transforms[row], materials, (group, who))

    def _add_flat(
        self,
        mesh: MeshArrays,
        transform: Float32,
        materials: np.ndarray,
        named: tuple[MeshGroup, tuple[Identity, ...]],
    ) -> None:
        """One instance scaled to a sheet, a line or a point, as a mesh of its own in world space."""
        if np.linalg.matrix_rank(transform[:, :3]) < 2:
            return
        vertices = mesh.vertices @ transform[:, :3].T + transform[:, 3]
        baked = MeshArrays(vertices, mesh.triangles, None, mesh.uvs, mesh.slots, mesh.origin)
        baked.attributes = mesh.attributes
        self.arrays.meshes.append(baked)
        identity = np.eye(3, 4, dtype=np.float32)[None]
        group, who = named
        self.arrays.instances.append(
            InstanceArrays(
                len(self.arrays.meshes) - 1,
                identity,
                materials,
                group.origin,
                None,
                who,
                None,
                group.mask,
                group.holdout,
            )
        )

    def _mesh(self, group: MeshGroup, slots: tuple[int, ...]) -> int:
        wanted = self.table.attributes_of(slots)
        key = (group.mesh.as_pointer(), len(slots), wanted, group.shape)
        if key not in self.known:
            names = self.table.textures.attributes
            extra = tuple((number, names[number]) for number in wanted if number)
            request = MeshRequest(len(slots), self.with_uvs or 0 in wanted, extra, self.fast)
            self.known[key] = len(self.arrays.meshes)
            asked = (group.mesh.as_pointer(), group.shape, request)
            mesh = self.store.find(asked, group.owners)
            if mesh is None:
                mesh = read_mesh(group.mesh, request, self.warnings)
                if is_unedited(mesh, group.shape):
                    mesh.shape = group.shape
                self.store.keep(asked, group.owners, mesh)
            self.arrays.meshes.append(mesh)
        return self.known[key]

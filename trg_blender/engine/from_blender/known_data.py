"""What a viewport keeps of the scene from one reading to the next, by what Blender says has changed.

Only updates that Blender names are believed: after a change of frame, which names none, everything is read
again.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import bpy

from ..scene_arrays import MeshArrays
from .image_reader import KnownImages
from .meshes import MeshRequest
from .world import WorldLight, read_world

Asked = tuple[int, str, MeshRequest]
"""pointer of the evaluated mesh, the shape that it may stand for, and what of it is wanted"""


@dataclass(slots=True)
class _KnownMesh:
    arrays: MeshArrays
    owners: frozenset[str]
    used: bool = True


@dataclass(slots=True)
class KnownMeshes:
    """Meshes by what was asked; those that the last reading had no use for are forgotten."""

    _meshes: dict[Asked, _KnownMesh] = field(default_factory=dict)

    def find(self, asked: Asked, owners: set[str]) -> MeshArrays | None:
        """The same object as before; None when it was not read so, or for other objects."""
        found = self._meshes.get(asked)
        if found is None or found.owners != owners:
            return None
        found.used = True
        return found.arrays

    def keep(self, asked: Asked, owners: set[str], arrays: MeshArrays) -> None:
        self._meshes[asked] = _KnownMesh(arrays, frozenset(owners))

    def begin(self, changed: set[str], meshes: set[str]) -> None:
        """Forgets what belongs to changed objects or meshes, by name."""
        self._meshes = {
            asked: known
            for asked, known in self._meshes.items()
            if not known.owners & changed and known.arrays.origin not in meshes
        }
        for known in self._meshes.values():
            known.used = False

    def end(self) -> None:
        self._meshes = {asked: known for asked, known in self._meshes.items() if known.used}

    def clear(self) -> None:
        self._meshes.clear()


@dataclass(slots=True)
class KnownData:
    """All of it; empty at first. `begin` and `end` enclose a reading."""

    meshes: KnownMeshes = field(default_factory=KnownMeshes)
    images: KnownImages = field(default_factory=KnownImages)
    _world: tuple[str, WorldLight, list[str]] | None = None

    def begin(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Forgets what `depsgraph` says has changed since."""
        changed, meshes, anything = set(), set(), False
        for update in depsgraph.updates:
            anything = True
            owner = update.id
            if isinstance(owner, bpy.types.Object) and update.is_updated_geometry:
                changed.add(owner.name)
            elif isinstance(owner, bpy.types.Mesh):
                meshes.add(owner.name)
            elif isinstance(owner, bpy.types.Image):
                self.images.forget(owner.name)
                self._world = None
            elif isinstance(owner, bpy.types.World):
                self._world = None
        if anything:
            self.meshes.begin(changed, meshes)
        else:
            self.clear()

    def end(self) -> None:
        self.meshes.end()

    def world(self, world: bpy.types.World | None, warnings: list[str]) -> WorldLight:
        """As read_world; the same object as before while nothing of it has changed."""
        name = "" if world is None else world.name
        if self._world is None or self._world[0] != name:
            said: list[str] = []
            self._world = (name, read_world(world, said), said)
        warnings.extend(self._world[2])
        return self._world[1]

    def clear(self) -> None:
        """Everything is read again."""
        self.meshes.clear()
        self.images.clear()
        self._world = None

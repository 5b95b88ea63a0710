"""The border to the native core: the only module that imports `trg_native`.

Inside Blender the extension's wheel puts `trg_native` on the path; elsewhere
`tools/build_native.sh` or an installed wheel does.
"""

from __future__ import annotations

import importlib
from dataclasses import dataclass
from types import ModuleType

import numpy as np
from numpy.typing import ArrayLike, NDArray

Float32 = NDArray[np.float32]
Int32 = NDArray[np.int32]
ACCELERATORS = ("auto", "bvh", "grid", "grid2", "tree", "none")
TRIANGLE_TESTS = ("watertight", "classic")


class NativeMissing(RuntimeError):
    """The native core cannot be loaded; the message says why and what to do."""


def load_native() -> ModuleType:
    """The module `trg_native`. Raises NativeMissing with the reason when it cannot be imported."""
    try:
        return importlib.import_module("trg_native")
    except ImportError as error:
        raise NativeMissing(
            f"the native core trg_native cannot be loaded ({error}); "
            "install the extension's wheel or run tools/build_native.sh"
        ) from error


@dataclass(frozen=True, slots=True)
class Hits:
    """Nearest hits of n rays; a miss has t = inf, triangle = instance = -1."""

    t: Float32
    """(n,) ray parameter: P = origin + t direction"""
    u: Float32
    """(n,) weight of the triangle's second corner"""
    v: Float32
    """(n,) weight of the third corner"""
    triangle: Int32
    """(n,) row of the mesh's triangles"""
    instance: Int32
    """(n,) as add_instance numbered it"""


@dataclass(frozen=True, slots=True)
class BuildStats:
    """What a build made."""

    seconds: float
    bytes: int
    nodes: int
    triangles: int
    """triangles that can be hit, those of a mesh counted once however often it is placed"""
    instances: int
    degenerate_triangles: int
    """triangles left out: coordinates not finite or above 1e18, or no area"""
    built_trees: int
    """indices of meshes that were built"""
    kept_trees: int
    """and that came along from a scene before"""
    accel: str
    """bvh, grid, grid2, tree or none"""
    reason: str
    """why this accelerator"""


@dataclass(frozen=True, slots=True)
class UpdateStats:
    """What a change of a built scene took."""

    seconds: float
    rebuilt: bool
    """more than what moved had to be built anew"""
    growth: float
    """cost of the moved mesh's tree over what it was when it was built; 0 where it has none"""


class RayScene:
    """Triangle meshes that rays can be traced against, without materials or light.

    `accel` is one of ACCELERATORS. `triangle_test` is `watertight` (no ray slips between triangles
    that share an edge or corner) or `classic` (plane and two dot products, as in the TRG paper).
    Arguments of wrong shape, type or range raise ValueError naming the argument and the first bad
    row. Queries may run in several Python threads at once; a change meanwhile raises RuntimeError.
    """

    def __init__(
        self, accel: str = "auto", triangle_test: str = "watertight", instruction_set: str = "auto"
    ) -> None:
        """`instruction_set` is auto (the machine's best), baseline, avx2 or avx512."""
        self._scene = load_native().Scene(
            accel=accel, triangle_test=triangle_test, instruction_set=instruction_set
        )

    def add_mesh(self, vertices: ArrayLike, triangles: ArrayLike) -> int:
        """Index of a mesh with `vertices` float32 (n, 3) and `triangles` int32 (m, 3)."""
        mesh: int = self._scene.add_mesh(
            _contiguous("vertices", vertices, np.float32),
            _contiguous("triangles", triangles, np.int32),
        )
        return mesh

    def add_sphere(self) -> int:
        """Index of a mesh that is the unit sphere round the origin, met in double precision.

        Its hits have triangle 0; u turns about z from -y towards x, v rises from the lower pole to
        the upper one, both from 0 to 1.
        """
        mesh: int = self._scene.add_sphere()
        return mesh

    def add_plane(self) -> int:
        """Index of a mesh that is the infinite plane z = 0. Its hits have triangle 0, and x and y
        as u and v."""
        mesh: int = self._scene.add_plane()
        return mesh

    def add_instance(self, mesh: int, transform: ArrayLike | None = None) -> int:
        """Index of a copy of `mesh` placed by `transform` float32 (3, 4); None is the identity.

        A mesh shows only through instances. A singular transform raises ValueError.
        """
        matrix = None if transform is None else _contiguous("transform", transform, np.float32)
        instance: int = self._scene.add_instance(mesh, matrix)
        return instance

    def add_instances(self, mesh: int, transforms: ArrayLike) -> int:
        """Index of the first of as many copies of `mesh` as `transforms` float32 (n, 3, 4) has rows."""
        first: int = self._scene.add_instances(mesh, _contiguous("transforms", transforms, np.float32))
        return first

    def update_transforms(self, first: int, transforms: ArrayLike, threads: int = 0) -> UpdateStats:
        """Moves instances `first` and on of a built scene to `transforms` float32 (n, 3, 4).

        Only the top level is built anew, unless one of them was merged with others that stood still.
        """
        rows = _contiguous("transforms", transforms, np.float32)
        return UpdateStats(**self._scene.update_transforms(first, rows, threads))

    def update_vertices(self, mesh: int, vertices: ArrayLike, threads: int = 0) -> UpdateStats:
        """Moves the vertices of `mesh` of a built scene to float32 (n, 3), as many as it had.

        The boxes of its tree are fitted to them; the tree is built anew when its cost has grown by
        more than half, other accelerators always are.
        """
        rows = _contiguous("vertices", vertices, np.float32)
        return UpdateStats(**self._scene.update_vertices(mesh, rows, None, threads))

    def build(self, threads: int = 0, rays: float = 0) -> BuildStats:
        """Builds the index over everything added; `threads` 0 takes all cores.

        `auto` chooses the accelerator for about `rays` rays; 0 is an unknown number, a million.
        """
        return BuildStats(**self._scene.build(threads, rays))

    def intersect(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        threads: int = 0,
    ) -> Hits:
        """Nearest hits with tmin < t < tmax of rays float32 (n, 3); a tmin below 0 counts as 0.

        `tmin` and `tmax` are numbers or (n,). Directions need not be unit. Rays with numbers that
        are not finite, or without direction, miss. Of equal hits the lowest (instance, triangle)
        counts, whatever the accelerator and the number of threads.
        """
        rays = _rays(origins, directions, tmin, tmax)
        count = len(rays[0])
        hits = Hits(
            t=np.empty(count, np.float32),
            u=np.empty(count, np.float32),
            v=np.empty(count, np.float32),
            triangle=np.empty(count, np.int32),
            instance=np.empty(count, np.int32),
        )
        self._scene.intersect(*rays, hits.t, hits.u, hits.v, hits.triangle, hits.instance, threads)
        return hits

    def occluded(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        threads: int = 0,
    ) -> NDArray[np.bool_]:
        """(n,) true where a ray meets anything with tmin < t < tmax; arguments as `intersect`."""
        rays = _rays(origins, directions, tmin, tmax)
        hidden = np.empty(len(rays[0]), np.uint8)
        self._scene.occluded(*rays, hidden, threads)
        return hidden.view(np.bool_)


def _contiguous(
    name: str, values: ArrayLike, dtype: type[np.float32] | type[np.int32]
) -> NDArray[np.float32] | NDArray[np.int32]:
    """`values` as a C-contiguous array of `dtype`; an array of another type is no number list."""
    array = np.asarray(values)
    if isinstance(values, np.ndarray) and array.dtype != dtype:
        raise ValueError(f"{name}: expected {np.dtype(dtype).name}, got {array.dtype.name}")
    try:
        rows = np.ascontiguousarray(array, dtype=dtype)
        return rows if rows.flags.aligned else rows.copy()
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name}: expected {np.dtype(dtype).name} numbers ({error})") from error


def _rays(
    origins: ArrayLike, directions: ArrayLike, tmin: ArrayLike, tmax: ArrayLike
) -> tuple[Float32, Float32, Float32, Float32]:
    origin_rows = _contiguous("origins", origins, np.float32)
    direction_rows = _contiguous("directions", directions, np.float32)
    count = len(origin_rows) if origin_rows.ndim else 0
    return (
        origin_rows,
        direction_rows,
        _limits("tmin", tmin, count),
        _limits("tmax", tmax, count),
    )


def _limits(name: str, values: ArrayLike, count: int) -> Float32:
    """(count,) float32 of one number or of one a ray."""
    array = np.asarray(values, dtype=np.float32)
    if array.ndim == 0:
        return np.full(count, array, dtype=np.float32)
    if array.shape != (count,):
        raise ValueError(f"{name}: expected shape ({count},), got {array.shape}")
    return _contiguous(name, array, np.float32)

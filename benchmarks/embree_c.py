"""Embree through its C API: the library inside the embreex wheel, looped over by embree_loop.c.

Needs a C compiler; the loop is compiled once into a folder of the caller's choice.
"""

from __future__ import annotations

import ctypes
import importlib
import importlib.util
import os
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from .ray_scenes import Mesh, Rays, Results

SOURCE = Path(__file__).with_name("embree_loop.c")
QUALITIES = {"low": 0, "medium": 1, "high": 2}


class _MeshBuild(ctypes.Structure):
    _fields_ = (
        ("vertices", ctypes.c_void_p),
        ("triangles", ctypes.c_void_p),
        ("vertex_count", ctypes.c_int64),
        ("triangle_count", ctypes.c_int64),
        ("quality", ctypes.c_int),
        ("robust", ctypes.c_int),
    )


class _Query(ctypes.Structure):
    _fields_ = (
        ("scene", ctypes.c_void_p),
        ("origins", ctypes.c_void_p),
        ("directions", ctypes.c_void_p),
        ("t_min", ctypes.c_void_p),
        ("t_max", ctypes.c_void_p),
        ("t", ctypes.c_void_p),
        ("u", ctypes.c_void_p),
        ("v", ctypes.c_void_p),
        ("triangle", ctypes.c_void_p),
        ("hidden", ctypes.c_void_p),
        ("count", ctypes.c_int64),
        ("packets", ctypes.c_int),
        ("coherent", ctypes.c_int),
        ("threads", ctypes.c_int),
    )


@dataclass(frozen=True)
class Way:
    """One way to ask Embree: which tree, and one ray or sixteen at a time."""

    name: str
    quality: str
    robust: bool
    packets: bool = False
    coherent: bool = False


WAYS = (
    Way("robust", "medium", True),
    Way("medium", "medium", False),
    Way("high", "high", False),
    Way("packets", "high", False, packets=True),
    Way("coherent", "high", False, packets=True, coherent=True),
)


def embree_library() -> Path:
    """The shared library that the embreex wheel carries. Raises FileNotFoundError without one."""
    spec = importlib.util.find_spec("embreex")
    if spec is None or spec.origin is None:
        raise FileNotFoundError("embreex is not installed")
    for path in sorted(Path(spec.origin).parents[1].glob("embreex.libs/libembree*")):
        return path
    raise FileNotFoundError("the embreex wheel has no Embree library of its own")


def _address(array: NDArray[Any]) -> int:
    return int(array.ctypes.data)


class Embree:
    """The loaded library. `folder` keeps the compiled loop."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        loop = folder / "embree_loop.so"
        if not loop.exists() or loop.stat().st_mtime < SOURCE.stat().st_mtime:
            compiler = os.environ.get("CC", "cc")
            command = [compiler, "-O2", "-shared", "-fPIC", str(SOURCE), "-o", str(loop), "-lpthread", "-ldl"]
            subprocess.run(command, check=True)
        importlib.import_module("embreex")  # loads the libraries that Embree itself needs
        self.api = ctypes.CDLL(str(loop))
        if self.api.load_embree(str(embree_library()).encode()):
            raise OSError(f"cannot load {embree_library()}")
        for name in ("new_device", "new_scene"):
            getattr(self.api, name).restype = ctypes.c_void_p


@dataclass
class EmbreeScene:
    """One mesh, built in one quality; `seconds` are processor seconds of the build alone, those of
    threads that only wait for work among them, `wall_seconds` those of the clock on the wall."""

    embree: Embree
    mesh: Mesh
    way: Way
    threads: int
    seconds: float = field(init=False)
    wall_seconds: float = field(init=False)
    bytes: int = field(init=False)

    def __post_init__(self) -> None:
        api = self.embree.api
        self._bytes = ctypes.c_int64(0)
        config = f"threads={self.threads}".encode()
        self._device = ctypes.c_void_p(api.new_device(config, ctypes.byref(self._bytes)))
        mesh = _MeshBuild(
            _address(self.mesh.vertices),
            _address(self.mesh.triangles),
            len(self.mesh.vertices),
            len(self.mesh.triangles),
            QUALITIES[self.way.quality],
            self.way.robust,
        )
        self._scene = ctypes.c_void_p(api.new_scene(self._device, ctypes.byref(mesh)))
        given = self._bytes.value
        start, wall_start = time.process_time(), time.perf_counter()
        api.build_scene(self._scene)
        self.seconds = time.process_time() - start
        self.wall_seconds = time.perf_counter() - wall_start
        self.bytes = self._bytes.value - given

    def trace(self, rays: Rays, results: Results, way: Way, threads: int) -> None:
        """Fills `results`: `hidden` for shadow rays, the others for the rest."""
        query = _Query(
            self._scene.value,
            *(_address(a) for a in (rays.origins, rays.directions, rays.t_min, rays.t_max)),
            *(_address(a) for a in (results.t, results.u, results.v, results.triangle)),
            _address(results.hidden) if rays.shadow else None,
            len(rays.origins),
            way.packets,
            way.coherent,
            threads,
        )
        self.embree.api.trace(ctypes.byref(query))

    def close(self) -> None:
        self.embree.api.release_scene(self._scene)
        self.embree.api.release_device(self._device)

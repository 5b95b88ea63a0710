"""Meshes and rays of the ray tests: those of `trg stability`, and where big data may lie."""

from __future__ import annotations

import os
from pathlib import Path

from trg_blender.stability.meshes import (
    ACCELS,
    INDICES,
    Float32,
    Float64,
    Int32,
    Mesh,
    bipyramid,
    brute_force,
    cube,
    edge_and_vertex_rays,
    icosphere,
    mesh_of,
    random_rays,
    same_hits,
    scene_of,
    soup,
)

__all__ = [
    "ACCELS",
    "INDICES",
    "SHARED",
    "Float32",
    "Float64",
    "Int32",
    "Mesh",
    "bipyramid",
    "brute_force",
    "cube",
    "edge_and_vertex_rays",
    "icosphere",
    "mesh_of",
    "random_rays",
    "same_hits",
    "scene_of",
    "soup",
]

SHARED = Path(os.environ.get("TRG_SHARED", Path(__file__).resolve().parents[3] / "shared"))

"""The built-ins. Importing this package fills the host table."""

from __future__ import annotations

from . import core, lights, lists, material, mth, scene_methods, shapes, std  # noqa: F401

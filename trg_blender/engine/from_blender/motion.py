"""Where everything is while Blender's shutter is open: places read at its opening, middle and closing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import bpy
import numpy as np

from ..motion import turning_keys
from ..scene_arrays import Float32, Float64

FrameSet = Callable[[float], None]
"""moves the depsgraph that is read to a frame, whole or not"""
STEPS = (-0.5, 0.0, 0.5)
"""times of the keys, in shutters from the middle: those of Cycles unless an object asks for more"""


@dataclass(frozen=True, slots=True)
class Shutter:
    """In frames."""

    now: float
    middle: float
    length: float


@dataclass(slots=True)
class Motion:
    """Places of all instances of the depsgraph at the keys."""

    instances: Float32 | None
    """(keys, n, 3, 4), rows as Found.transforms has them; None where they cannot be told apart"""
    camera: Float64 | None
    """(keys, 3, 4); None: it stands still"""

    def of(self, rows: list[int]) -> Float32 | None:
        """(k, keys, 3, 4) of some instances, None when none of them moves."""
        if self.instances is None:
            return None
        places = self.instances[:, rows].transpose(1, 0, 2, 3).astype(np.float64)
        if not (places != places[:, :1]).any():
            return None
        if not np.isfinite(places).all() or (np.linalg.det(places[..., :3]) == 0.0).any():
            return None
        keys = [turning_keys(each) for each in places]
        most = max(len(each) for each in keys)
        return np.stack([_resample(each, most) for each in keys]).astype(np.float32)


def _resample(keys: Float64, count: int) -> Float64:
    """The same way by `count` keys, which is no fewer."""
    if len(keys) == count:
        return keys
    old, new = np.linspace(0.0, 1.0, len(keys)), np.linspace(0.0, 1.0, count)
    flat = keys.reshape(len(keys), 12)
    return np.stack([np.interp(new, old, column) for column in flat.T], axis=1).reshape(count, 3, 4)


def shutter_of(scene: bpy.types.Scene, warnings: list[str]) -> Shutter | None:
    """None without motion blur."""
    render = scene.render
    if not render.use_motion_blur or render.motion_blur_shutter <= 0.0:
        return None
    now = scene.frame_current + scene.frame_subframe
    position = getattr(render, "motion_blur_position", None) or scene.cycles.motion_blur_position
    offset = {"START": 0.5, "CENTER": 0.0, "END": -0.5}[position]
    curve = render.motion_blur_shutter_curve
    heights = [point.location[1] for point in curve.curves[0].points]
    if max(heights) - min(heights) > 1e-3:
        warnings.append(f"scene {scene.name!r}: the shutter opens and closes at once, not by its curve")
    length = float(render.motion_blur_shutter)
    return Shutter(now, now + offset * length, length)


def read_motion(
    depsgraph: bpy.types.Depsgraph, shutter: Shutter, frame_set: FrameSet, warnings: list[str]
) -> Motion:
    """Places at the keys. Leaves `depsgraph` at the middle of the shutter."""
    instances, randoms, cameras, shapes = [], [], [], []
    for step in STEPS:
        frame_set(shutter.middle + step * shutter.length)
        places, numbers = _places(depsgraph)
        instances.append(places)
        randoms.append(numbers)
        shapes.append(_shapes(depsgraph))
        camera = depsgraph.scene_eval.camera
        cameras.append(None if camera is None else _rigid(camera.evaluated_get(depsgraph)))
    frame_set(shutter.middle)
    same = all(len(each) == len(randoms[0]) and (each == randoms[0]).all() for each in randoms)
    if not same:
        warnings.append("objects come or go while the shutter is open: none of them is blurred")
    changed = sorted(
        name for name, shape in shapes[0].items() if any(each.get(name) != shape for each in shapes)
    )
    if changed:
        more = f" and {len(changed) - 1} more" if len(changed) > 1 else ""
        warnings.append(
            f"object {changed[0]!r}{more}: a mesh that changes while the shutter is open "
            "is shown as it is in the middle"
        )
    return Motion(np.stack(instances) if same else None, _camera_keys(cameras))


def _shapes(depsgraph: bpy.types.Depsgraph) -> dict[str, int]:
    """What tells the vertices of each mesh object from others."""
    shapes: dict[str, int] = {}
    for instance in depsgraph.object_instances:
        owner = instance.object
        if owner.type == "MESH" and owner.name not in shapes:
            mesh = owner.data
            flat = np.zeros(len(mesh.vertices) * 3, np.float32)
            if len(flat):
                mesh.attributes["position"].data.foreach_get("vector", flat)
            shapes[owner.name] = hash(flat.tobytes())
    return shapes


def _places(depsgraph: bpy.types.Depsgraph) -> tuple[Float32, np.ndarray]:
    """(n, 3, 4) transforms and (n,) numbers that tell instances apart."""
    found = depsgraph.object_instances
    flat, numbers = np.empty(len(found) * 16, np.float32), np.empty(len(found), np.int32)
    found.foreach_get("matrix_world", flat)
    found.foreach_get("random_id", numbers)
    return flat.reshape(-1, 4, 4).transpose(0, 2, 1)[:, :3].copy(), numbers


def _rigid(owner: bpy.types.Object) -> Float64:
    return np.array(owner.matrix_world.normalized(), dtype=np.float64)[:3]


def _camera_keys(cameras: list[Float64 | None]) -> Float64 | None:
    places = [each for each in cameras if each is not None]
    if len(places) < len(cameras) or not np.isfinite(places).all() or not np.ptp(places, axis=0).any():
        return None
    return turning_keys(np.stack(places))

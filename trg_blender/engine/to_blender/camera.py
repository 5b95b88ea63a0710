"""The camera of a program, and the picture size that goes with it."""

from __future__ import annotations

from math import radians, tan

import bpy
import numpy as np
from mathutils import Matrix

from ...lang.scene import CameraRecord
from .axes import vector_to_blender
from .transforms import frame_of_direction

SENSOR_MM = 36.0
CLIP_START = 1e-3
CLIP_END = 1e5
KEEP_SIZE = "trg_keep_size"
"""custom property of a scene: when true its picture size is the user's, not the program's"""


def write_camera(camera: bpy.types.Camera, record: CameraRecord) -> None:
    """Lens and clipping: `fov_degrees` spans the shorter side of the picture."""
    camera.type = "PERSP"
    camera.sensor_fit = "VERTICAL" if record.width >= record.height else "HORIZONTAL"
    camera.sensor_width = camera.sensor_height = SENSOR_MM
    camera.lens_unit = "MILLIMETERS"
    camera.lens = SENSOR_MM / 2.0 / tan(radians(record.fov_degrees) / 2.0)
    camera.shift_x = camera.shift_y = 0.0
    camera.clip_start, camera.clip_end = CLIP_START, CLIP_END
    camera.dof.use_dof = False


def camera_matrix(record: CameraRecord) -> Matrix:
    """Camera to Blender's world; it looks along its -Z."""
    location = np.array(vector_to_blender(record.location))
    forward = np.array(vector_to_blender(record.target)) - location
    matrix = np.eye(4)
    matrix[:3, :3] = frame_of_direction(forward, np.array(vector_to_blender(record.up)))
    matrix[:3, 3] = location
    return Matrix(matrix.tolist())


def write_picture_size(scene: bpy.types.Scene, record: CameraRecord) -> bool:
    """Give the scene the picture size of CamSet; tells whether it had another.

    Blender honours it only before a render starts (handler render_init, or earlier). A scene whose
    property `trg_keep_size` is true keeps its own.
    """
    render = scene.render
    if scene.get(KEEP_SIZE):
        return False
    wanted = (record.width, record.height)
    if (render.resolution_x, render.resolution_y) == wanted:
        return False
    render.resolution_x, render.resolution_y = wanted
    return True

"""What tests inside Blender share: the default scene, and EXR files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy


def default_cube(size: tuple[int, int], samples: int) -> Any:
    """Blender's default scene for TRG, a picture of `size` pixels."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    scene = bpy.context.scene
    scene.render.engine = "TRG"
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.trg.samples = samples
    return scene


def write_exr(scene: Any, path: Path, layers: bool) -> None:
    """Renders `scene` to an EXR of 32 bit, with all its layers or Combined alone."""
    image = scene.render.image_settings
    if hasattr(image, "media_type"):
        image.media_type = "MULTI_LAYER_IMAGE" if layers else "IMAGE"
    image.file_format = "OPEN_EXR_MULTILAYER" if layers else "OPEN_EXR"
    image.color_mode, image.color_depth = "RGBA", "32"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def read_exr(path: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    """All channels by name, (h, w) float32, and the headers of all parts as one."""
    import numpy as np
    import OpenEXR

    channels: dict[str, Any] = {}
    header: dict[str, Any] = {}
    with OpenEXR.File(str(path), separate_channels=True) as file:
        for part in file.parts:
            header.update(part.header)
            channels.update({name: np.array(each.pixels) for name, each in part.channels.items()})
    return channels, header

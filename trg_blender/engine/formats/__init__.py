"""Readers and writers of the files that TRG programs name: numpy only, no bpy.

`read_model` and `read_g24` are what the rest of the engine uses; both give a whole, checked result or
raise FormatError, and never allocate more than in proportion to the file.
"""

from __future__ import annotations

from pathlib import Path

from .errors import FormatError
from .g3d import read_g3d, write_g3d
from .g3dm import read_g3dm, write_g3dm
from .g24 import read_g24, write_g24
from .model import Model, ModelMaterial, ModelTexture, Primitive
from .obj import read_obj

MODEL_READERS = {".g3dm": read_g3dm, ".g3d": read_g3d, ".obj": read_obj, ".object": read_obj}
IMAGE_SUFFIXES = (".g24", ".g32", ".gsm")

__all__ = [
    "IMAGE_SUFFIXES",
    "MODEL_READERS",
    "FormatError",
    "Model",
    "ModelMaterial",
    "ModelTexture",
    "Primitive",
    "read_g3d",
    "read_g3dm",
    "read_g24",
    "read_model",
    "read_obj",
    "write_g3d",
    "write_g3dm",
    "write_g24",
]


def read_model(path: str | Path) -> Model:
    """The model in `path`, read as its suffix says (any case).

    Raises FormatError for a damaged file or a suffix that is not in MODEL_READERS, OSError for a file
    that cannot be read.
    """
    reader = MODEL_READERS.get(Path(path).suffix.lower())
    if reader is None:
        known = ", ".join(sorted(MODEL_READERS))
        raise FormatError(str(path), 0, f"a model file whose name ends with one of {known}")
    return reader(path)

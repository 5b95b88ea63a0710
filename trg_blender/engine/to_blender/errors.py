"""What is wrong with a scene that a program asked for."""

from __future__ import annotations

from ...lang.source import Span
from .. import errors


class SceneError(errors.SceneError):
    """The scene that a program describes is impossible.

    `origin` is the place in the program that asked for it, where known.
    Raised before anything of the frame is written to Blender.
    """

    def __init__(self, message: str, origin: Span | None = None, key: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.origin = origin
        self.key = key

    def __str__(self) -> str:
        where = f"{self.origin}: error: " if self.origin is not None else ""
        return f"{where}{self.message}"

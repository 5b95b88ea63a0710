"""Files for the program in a text of a .blend: its other texts, then the folders it may read.

The folders are the one the text was loaded from, the one the .blend lies in, those that the user allowed
in the preferences, and TRG's own library.
"""

from __future__ import annotations

from pathlib import Path

import bpy

from ...lang.files import DiskFiles, FileError, NoFiles, clean_name
from ...lang.source import SourceFile
from .user_settings import user_folders


class TextFiles:
    """A FileResolver (lang/files.py) that remembers what it was asked, to tell whether it changed."""

    def __init__(self, text: bpy.types.Text) -> None:
        folders = allowed_folders(text)
        self._disk = DiskFiles(folders[0], tuple(folders[1:])) if folders else NoFiles()
        self._folders = folders
        self._own_name = text.name
        self._asked: list[tuple[str, str, SourceFile]] = []
        """(name, asking file, what was found)"""
        self.read: dict[str, Path | None] = {}
        """models and images that the program asked for, by the name it wrote; None: not found"""

    def resolve_include(self, name: str, from_file: str) -> SourceFile:
        """See FileResolver: a text of the .blend comes before a file. Raises FileError."""
        source = self._find(name, from_file)
        self._asked.append((name, from_file, source))
        return source

    def resolve_file(self, name: str, from_file: str) -> Path | None:
        """See FileResolver."""
        self.read[name] = None
        found = self._disk.resolve_file(name, from_file)
        self.read[name] = found
        return found

    @property
    def sources(self) -> dict[str, SourceFile]:
        """Every text that was included, by its canonical name."""
        return {source.name: source for _, _, source in self._asked}

    def is_current(self, text: bpy.types.Text) -> bool:
        """Whether the folders are the same and every include still gives what it gave."""
        if allowed_folders(text) != self._folders:
            return False
        try:
            return all(self._find(name, asking) == found for name, asking, found in self._asked)
        except FileError:
            return False

    def _find(self, name: str, from_file: str) -> SourceFile:
        parts = clean_name(name)
        folder = tuple(from_file.replace("\\", "/").split("/")[:-1])
        for tried in dict.fromkeys(("/".join((*folder, *parts)), "/".join(parts))):
            text = bpy.data.texts.get(tried)
            if text is not None and text.name != self._own_name:
                return SourceFile.from_text(tried, text.as_string())
        return self._disk.resolve_include(name, from_file)


def allowed_folders(text: bpy.types.Text) -> list[Path]:
    """Folder of the text's file, then of the .blend, then the user's, as far as there are any."""
    folders: list[Path] = []
    if text.filepath:
        folders.append(Path(bpy.path.abspath(text.filepath, library=text.library)).parent)
    if bpy.data.filepath:
        folders.append(Path(bpy.data.filepath).parent)
    folders += user_folders()
    return [folder for folder in dict.fromkeys(folders) if folder.is_dir()]

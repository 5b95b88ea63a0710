"""Where a program's files come from, and the fence around them.

A name is relative: to the folder of the text that names it, then to the project, then to the
folders that the user allowed, then to the library that TRG brings (`stl/`). No name leads out.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from .limits import MAX_SOURCE
from .source import SourceFile

_DRIVE_OR_URL = re.compile(r"^[A-Za-z][A-Za-z0-9+.-]*:")
_MAX_NAME = 512
_MAX_FOLDER_ENTRIES = 20_000
# Windows opens devices under these names in every folder, whatever follows them.
_DEVICE_NAMES = re.compile(
    r"^(?:con|conin\$|conout\$|prn|aux|nul|(?:com|lpt)[0-9\u00b9\u00b2\u00b3]) *(?:\..*)?$", re.IGNORECASE
)


class FileError(Exception):
    """`code` is of the message table: E510 outside the fence, E511 not found, E512 unreadable."""

    def __init__(self, code: str, name: str) -> None:
        super().__init__(f"{code}: {name}")
        self.code = code
        self.name = name


class FileResolver(Protocol):
    """What a host implements to give programs their files."""

    def resolve_include(self, name: str, from_file: str) -> SourceFile:
        """The text that `include(name)` in `from_file` means, under its canonical name.

        Raises FileError.
        """
        ...

    def resolve_file(self, name: str, from_file: str) -> Path | None:
        """Where the texture or model `name` lies; None when it is missing. Raises FileError."""
        ...


def clean_name(name: str) -> tuple[str, ...]:
    """The parts of a relative name, `\\` taken as `/`. Raises FileError E510 for any other name."""
    text = name.replace("\\", "/")
    outside = not text or len(text) > _MAX_NAME or text.startswith(("/", "~"))
    if outside or _DRIVE_OR_URL.match(text) or any(ord(c) < 32 for c in text):
        raise FileError("E510", name)
    parts = tuple(part for part in text.split("/") if part not in ("", "."))
    for part in parts:
        # A dot or space at the end is none to Windows: `.. ` would be the folder above.
        if part.endswith((".", " ")) or ":" in part or _DEVICE_NAMES.match(part):
            raise FileError("E510", name)
    if not parts:
        raise FileError("E510", name)
    return parts


def bundled_library() -> Path | None:
    """The folder that holds `stl/`: it lies beside the package, in a checkout and when installed."""
    for root in Path(__file__).resolve().parents[1:4]:
        if (root / "stl").is_dir():
            return root
    return None


class NoFiles:
    """A resolver for programs without a folder: the bundled library only."""

    def __init__(self) -> None:
        self._bundled = bundled_library()

    def resolve_include(self, name: str, from_file: str) -> SourceFile:
        parts = clean_name(name)
        found = None
        if self._bundled is not None and parts[0].lower() == "stl":
            found = find_inside(self._bundled, parts)
        if found is None:
            raise FileError("E511", name)
        return read_source(found, "/".join(parts), name)

    def resolve_file(self, name: str, from_file: str) -> Path | None:
        clean_name(name)
        return None


@dataclass(frozen=True, slots=True)
class DiskFiles:
    """Files below `project`, the `allowed` folders, and the bundled library; nothing else."""

    project: Path
    allowed: tuple[Path, ...] = ()

    def resolve_include(self, name: str, from_file: str) -> SourceFile:
        """See FileResolver. Canonical names are relative to the root where the text was found."""
        parts = clean_name(name)
        for root, tried in self._places(parts, from_file):
            found = find_inside(root, tried)
            if found is not None:
                canonical = found.resolve().relative_to(root.resolve()).as_posix()
                return read_source(found, canonical, name)
        raise FileError("E511", name)

    def resolve_file(self, name: str, from_file: str) -> Path | None:
        """See FileResolver."""
        parts = clean_name(name)
        for root, tried in self._places(parts, from_file):
            found = find_inside(root, tried)
            if found is not None:
                return found
        return None

    def _places(self, parts: tuple[str, ...], from_file: str) -> list[tuple[Path, tuple[str, ...]]]:
        folder = tuple(from_file.replace("\\", "/").split("/")[:-1])
        places: list[tuple[Path, tuple[str, ...]]] = []
        bundled = bundled_library()
        if folder and ".." not in folder:
            places.append((self.project, folder + parts))
            if folder[0] == "stl" and bundled is not None:
                places.append((bundled, folder + parts))
        places.append((self.project, parts))
        places += [(root, parts) for root in self.allowed]
        if bundled is not None and parts[0].lower() == "stl":
            places.append((bundled, parts))
        return places


def find_inside(root: Path, parts: tuple[str, ...]) -> Path | None:
    """The regular file `parts` below `root`, or None.

    A part that is not there is looked for without regard to case, since the paper's programs come
    from Windows. A link that leads out of `root` raises FileError E510.
    """
    here = root
    for part in parts:
        try:
            exact = here / part
            step = exact if exact.exists() else _ignoring_case(here, part)
        except OSError:
            return None
        if step is None:
            return None
        here = step
    if not here.is_file():
        return None
    if not here.resolve().is_relative_to(root.resolve()):
        raise FileError("E510", "/".join(parts))
    return here


def _ignoring_case(folder: Path, part: str) -> Path | None:
    if not folder.is_dir():
        return None
    wanted = part.casefold()
    for count, entry in enumerate(sorted(folder.iterdir())):
        if entry.name.casefold() == wanted:
            return entry
        if count > _MAX_FOLDER_ENTRIES:
            return None
    return None


def read_source(path: Path, canonical: str, name: str) -> SourceFile:
    """Read a program text as UTF-8. Raises FileError E512 when that fails."""
    try:
        if path.stat().st_size > MAX_SOURCE * 4:
            raise FileError("E512", name)
        return SourceFile.from_text(canonical, path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise FileError("E512", name) from error

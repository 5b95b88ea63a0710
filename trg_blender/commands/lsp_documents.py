"""Open documents of the language server: their analysis, and places in its client's units.

The protocol counts lines from 0 and columns in the units that were agreed with the client (UTF-16
unless it offers others); the language counts both from 1, columns in characters.
"""

from __future__ import annotations

from pathlib import Path

from lsprotocol import types as lsp
from pygls import uris
from pygls.workspace import PositionCodec, TextDocument, Workspace

from ..lang import DiskFiles, FileResolver, NoFiles, SourceFile, Span
from ..lang.analysis import Analysis, analyse_source
from ..lang.files import bundled_library


class Documents:
    """The analyses of open documents, one for each version."""

    def __init__(self, language: str) -> None:
        self.language = language
        self._analyses: dict[str, tuple[str, Analysis]] = {}

    def analysis(self, document: TextDocument) -> Analysis:
        """The analysis of the document's present text."""
        kept = self._analyses.get(document.uri)
        if kept is not None and kept[0] == document.source:
            return kept[1]
        made = analyse_source(document.source, file_name(document), resolver_of(document), self.language)
        self._analyses[document.uri] = (document.source, made)
        return made

    def forget(self, uri: str) -> None:
        self._analyses.pop(uri, None)


def file_name(document: TextDocument) -> str:
    """What diagnostics call the document."""
    return Path(document.path).name if document.path else document.uri.rpartition("/")[2]


def resolver_of(document: TextDocument) -> FileResolver:
    """Includes of a file on disk are looked for beside it; a text without a file has the library only."""
    path = uris.to_fs_path(document.uri)
    return NoFiles() if path is None else DiskFiles(Path(path).resolve().parent)


def file_of(document: TextDocument, name: str) -> Path | None:
    """Where a source of the document's program lies, by its canonical name."""
    path = uris.to_fs_path(document.uri)
    roots = [] if path is None else [Path(path).resolve().parent]
    library = bundled_library()
    roots += [] if library is None else [library]
    return next((root / name for root in roots if (root / name).is_file()), None)


class Places:
    """Turns places of one source text into the client's, and back."""

    def __init__(self, source: SourceFile, workspace: Workspace) -> None:
        self.source = source
        self.codec: PositionCodec = workspace.position_codec
        self.lines = [line + "\n" for line in source.lines]

    def range_of(self, span: Span) -> lsp.Range:
        """The client's range of a span. Ends behind the text are moved to its end."""
        plain = lsp.Range(
            lsp.Position(span.line - 1, span.col - 1), lsp.Position(span.end_line - 1, span.end_col - 1)
        )
        return self.codec.range_to_client_units(self.lines, plain)

    def place_of(self, position: lsp.Position) -> tuple[int, int]:
        """Line and column of the client's position."""
        plain = self.codec.position_from_client_units(self.lines, position)
        return plain.line + 1, plain.character + 1

"""The language server: what a client asks, answered from the analysis of the open document."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence

from lsprotocol import types as lsp
from pygls.lsp.server import LanguageServer
from pygls.workspace import TextDocument

from .. import __version__
from ..lang import Diagnostic, ProgramError, SourceFile, Span
from ..lang.analysis import Analysis
from ..lang.completion import SuggestionKind, complete
from ..lang.format import format_source
from ..lang.hover import define, describe
from .lsp_documents import Documents, Places, file_of

PAUSE_S = 0.25
"""How long the author must have stopped typing before the program is looked at."""

_SEVERITIES = {
    "error": lsp.DiagnosticSeverity.Error,
    "warning": lsp.DiagnosticSeverity.Warning,
    "lint": lsp.DiagnosticSeverity.Information,
}
_KINDS: dict[SuggestionKind, lsp.CompletionItemKind] = {
    "function": lsp.CompletionItemKind.Function,
    "method": lsp.CompletionItemKind.Method,
    "constant": lsp.CompletionItemKind.Constant,
    "variable": lsp.CompletionItemKind.Variable,
    "field": lsp.CompletionItemKind.Field,
    "keyword": lsp.CompletionItemKind.Keyword,
    "space": lsp.CompletionItemKind.Module,
    "type": lsp.CompletionItemKind.TypeParameter,
}


class TrgServer(LanguageServer):
    """A server with its documents and the checks that wait for the author to pause."""

    def __init__(self, language: str) -> None:
        super().__init__("trg", __version__)
        self.documents = Documents(language)
        self.waiting: dict[str, asyncio.Task[None]] = {}

    def understood(self, uri: str) -> tuple[TextDocument, Analysis, Places]:
        """The open document, its analysis, and its places."""
        document = self.workspace.get_text_document(uri)
        analysis = self.documents.analysis(document)
        return document, analysis, Places(analysis.sources[analysis.main], self.workspace)

    def publish(self, uri: str) -> None:
        """Send the diagnostics of the document; those of included files stay with those files."""
        document, analysis, places = self.understood(uri)
        shown = [
            self._diagnostic(document, analysis, places, d)
            for d in analysis.diagnostics
            if d.span.file == analysis.main
        ]
        self.text_document_publish_diagnostics(
            lsp.PublishDiagnosticsParams(uri, shown, version=document.version)
        )

    def _diagnostic(
        self, document: TextDocument, analysis: Analysis, places: Places, found: Diagnostic
    ) -> lsp.Diagnostic:
        related = [
            lsp.DiagnosticRelatedInformation(location, text)
            for span, text in found.related
            if (location := self.location(document, analysis, span)) is not None
        ]
        message = found.message if found.hint is None else f"{found.message}\n{found.hint}"
        return lsp.Diagnostic(
            places.range_of(found.span),
            message,
            severity=_SEVERITIES[found.severity],
            code=found.code,
            source="trg",
            related_information=related or None,
        )

    def location(self, document: TextDocument, analysis: Analysis, span: Span) -> lsp.Location | None:
        """Where a span lies for the client; None when its file is not on this machine."""
        source = analysis.sources.get(span.file)
        if source is None:
            return None
        uri = document.uri
        if span.file != analysis.main:
            path = file_of(document, span.file)
            if path is None:
                return None
            uri = path.as_uri()
        return lsp.Location(uri, Places(source, self.workspace).range_of(span))

    async def publish_after_pause(self, uri: str) -> None:
        """Publish when no change came for PAUSE_S; a newer call takes the place of this one."""
        await asyncio.sleep(PAUSE_S)
        self.waiting.pop(uri, None)
        if uri in self.workspace.text_documents:
            self.publish(uri)

    def stop_waiting(self, uri: str) -> None:
        task = self.waiting.pop(uri, None)
        if task is not None:
            task.cancel()


def make_server(language: str = "en") -> TrgServer:
    """A server that answers with messages in `language`; `start_io()` runs it."""
    server = TrgServer(language)
    _add_documents(server)
    _add_reading(server)
    _add_editing(server)
    return server


def _add_documents(server: TrgServer) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_DID_OPEN)
    def opened(params: lsp.DidOpenTextDocumentParams) -> None:
        server.publish(params.text_document.uri)

    @server.feature(lsp.TEXT_DOCUMENT_DID_CHANGE)
    async def changed(params: lsp.DidChangeTextDocumentParams) -> None:
        uri = params.text_document.uri
        server.stop_waiting(uri)
        server.waiting[uri] = asyncio.get_running_loop().create_task(server.publish_after_pause(uri))

    @server.feature(lsp.TEXT_DOCUMENT_DID_SAVE)
    def saved(params: lsp.DidSaveTextDocumentParams) -> None:
        # An included file may have changed on disk: look again, even if this text has not.
        server.documents.forget(params.text_document.uri)
        server.publish(params.text_document.uri)

    @server.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def closed(params: lsp.DidCloseTextDocumentParams) -> None:
        uri = params.text_document.uri
        server.stop_waiting(uri)
        server.documents.forget(uri)
        server.text_document_publish_diagnostics(lsp.PublishDiagnosticsParams(uri, []))


def _add_reading(server: TrgServer) -> None:
    triggers = lsp.CompletionOptions(trigger_characters=[".", ":", "#", "~"])

    @server.feature(lsp.TEXT_DOCUMENT_COMPLETION, triggers)
    def completion(params: lsp.CompletionParams) -> lsp.CompletionList:
        _, analysis, places = server.understood(params.text_document.uri)
        found = complete(analysis, *places.place_of(params.position))
        items = [
            lsp.CompletionItem(
                s.label, kind=_KINDS[s.kind], detail=s.detail or None, documentation=s.doc or None
            )
            for s in found
        ]
        return lsp.CompletionList(is_incomplete=False, items=items)

    @server.feature(lsp.TEXT_DOCUMENT_HOVER)
    def hover(params: lsp.HoverParams) -> lsp.Hover | None:
        _, analysis, places = server.understood(params.text_document.uri)
        found = describe(analysis, *places.place_of(params.position))
        if found is None:
            return None
        content = lsp.MarkupContent(lsp.MarkupKind.Markdown, found[0])
        return lsp.Hover(content, places.range_of(found[1]))

    @server.feature(lsp.TEXT_DOCUMENT_DEFINITION)
    def definition(params: lsp.DefinitionParams) -> lsp.Location | None:
        document, analysis, places = server.understood(params.text_document.uri)
        span = define(analysis, *places.place_of(params.position))
        return None if span is None else server.location(document, analysis, span)


def _add_editing(server: TrgServer) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_FORMATTING)
    def formatting(params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit]:
        document, analysis, places = server.understood(params.text_document.uri)
        try:
            made = format_source(document.source, analysis.main)
        except ProgramError:
            return []
        if "\r\n" in document.source:
            made = made.replace("\n", "\r\n")
        return [] if made == document.source else [lsp.TextEdit(_whole(places.source), made)]

    kinds = lsp.CodeActionOptions(code_action_kinds=[lsp.CodeActionKind.QuickFix])

    @server.feature(lsp.TEXT_DOCUMENT_CODE_ACTION, kinds)
    def code_actions(params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
        document, analysis, places = server.understood(params.text_document.uri)
        return _fixes(document.uri, analysis.diagnostics, places, params)


def _whole(source: SourceFile) -> lsp.Range:
    return lsp.Range(lsp.Position(0, 0), lsp.Position(len(source.lines), 0))


def _fixes(
    uri: str, diagnostics: Sequence[Diagnostic], places: Places, params: lsp.CodeActionParams
) -> list[lsp.CodeAction]:
    """One action for each certain fix of a diagnostic that touches the asked range."""
    made = []
    for found in diagnostics:
        if found.fix is None or found.span.file != places.source.name:
            continue
        if not _touch(places.range_of(found.span), params.range):
            continue
        span, text = found.fix
        edit = lsp.WorkspaceEdit(changes={uri: [lsp.TextEdit(places.range_of(span), text)]})
        of = [d for d in params.context.diagnostics if d.code == found.code]
        title = found.hint or f"{found.message}: {text}"
        action = lsp.CodeAction(title, lsp.CodeActionKind.QuickFix, of or None, is_preferred=True, edit=edit)
        made.append(action)
    return made


def _touch(a: lsp.Range, b: lsp.Range) -> bool:
    return a.start <= b.end and b.start <= a.end

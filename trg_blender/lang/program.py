"""From source texts to a program that can be run: parse, include, resolve, translate, check, compile."""

from __future__ import annotations

import ast as py
import warnings
from dataclasses import dataclass, field
from types import CodeType

from . import ast
from .bind import HOST
from .check import check_tree
from .diagnostics import Diagnostic, DiagnosticBag, Notice, ProgramError
from .emit import emit_file
from .emit_expr import ProgramParts
from .exports import Export, read_exports
from .files import FileError, FileResolver, NoFiles
from .limits import MAX_INCLUDE_DEPTH, MAX_INCLUDES, MAX_SOURCE
from .memory import collecting_seldom
from .parse import parse_source
from .recover import resolve_despite_errors
from .resolve import FunctionInfo, Resolution, resolve_program
from .runtime import Site
from .source import SourceFile, Span
from .yields import YieldAnalysis

_COLLECT_AFTER = 10_000_000  # more than a program at its limit takes, and none is garbage


@dataclass(frozen=True, slots=True)
class FunctionFacts:
    """What messages say of a function."""

    name: str
    wanted: str
    takes_self: bool
    """The first parameter is called `self`: a call through a field passes the object."""


@dataclass(frozen=True, slots=True)
class Program:
    """A compiled program; the same one may be run any number of times.

    `diagnostics` are lints: a program with errors does not come to be.
    """

    main: str
    """Name of the file that was compiled."""
    sources: dict[str, SourceFile]
    resolver: FileResolver
    diagnostics: tuple[Diagnostic, ...]
    codes: tuple[CodeType, ...] = field(repr=False)
    """One for each file; the first is the main one."""
    sites: dict[Span, Site] = field(repr=False)
    strings: dict[str, str] = field(repr=False)
    """String constants by text: the name under which translated code finds each."""
    places: dict[tuple[str, Span], str] = field(repr=False)
    """Calls that make things, by built-in and place: the name under which translated code finds each."""
    global_names: tuple[str, ...] = field(repr=False)
    functions: tuple[FunctionFacts, ...] = field(repr=False)
    exports: dict[str, Export] = field(default_factory=dict)
    """Parameters that the host may set, by name, in the order in which they stand."""

    @property
    def start(self) -> Span:
        """The first character of the main file."""
        return Span(self.main, 1, 1, 1, 1)

    def function_name(self, code_name: str) -> str:
        """The author's name of the function compiled as `code_name`."""
        return self.functions[int(code_name.removeprefix("f_"))].name


class Loader:
    """Reads the main text and everything it includes, in the order in which they run."""

    def __init__(self, resolver: FileResolver, bag: DiagnosticBag) -> None:
        self.resolver = resolver
        self.bag = bag
        self.sources: dict[str, SourceFile] = {}
        self.trees: list[ast.FileTree] = []
        self.exports: dict[str, Export] = {}
        self.total = 0
        self._open: list[str] = []

    def load(self, source: SourceFile) -> None:
        """Parse `source`, then the files it includes; errors go to the bag."""
        self.sources[source.name] = source
        self.total += len(source.text)
        if self.total > MAX_SOURCE:
            start = Span(source.name, 1, 1, 1, 1)
            self.bag.add(Notice("E109", start, {"limit": MAX_SOURCE}, "fixed_limit"))
            return
        tree = parse_source(source, self.bag)
        self.trees.append(tree)
        self._open.append(source.name)
        for statement in tree.statements:
            if isinstance(statement, ast.Include):
                self._include(statement, tree)
        self._open.pop()

    def _include(self, node: ast.Include, tree: ast.FileTree) -> None:
        try:
            source = self.resolver.resolve_include(node.name, tree.name)
        except FileError as error:
            self._error(error.code, node, name=node.name[:80])
            return
        if source.name in self._open:
            self._error("E320", node, name=source.name)
        elif source.name in self.sources:
            return
        elif len(self.sources) > MAX_INCLUDES:
            self._error("E321", node, limit=MAX_INCLUDES)
        elif len(self._open) > MAX_INCLUDE_DEPTH:
            self._error("E322", node, limit=MAX_INCLUDE_DEPTH)
        else:
            tree.includes[node.span] = source.name
            self.load(source)

    def _error(self, code: str, node: ast.Include, **values: object) -> None:
        hint = "fixed_limit" if "limit" in values else None
        self.bag.add(Notice(code, node.name_span, values, hint))


def compile_source(
    text: str, file_name: str, resolver: FileResolver | None = None, language: str = "en"
) -> Program:
    """Compile a program.

    `file_name` is what diagnostics call the text, and where its includes are relative to;
    `language` that of messages, `en` or `ru`. Without a resolver only the bundled library can be
    included and no file is found. Raises ProgramError with all errors found (at most 20).
    """
    bag = DiagnosticBag(language)
    resolver = resolver or NoFiles()
    try:
        with collecting_seldom(_COLLECT_AFTER):
            return _compile(SourceFile.from_text(file_name, text), resolver, bag)
    except RecursionError:
        # The caller's own stack was nearly full: our limits on nesting assume a fresh one.
        bag.add(Notice("E220", Span(file_name, 1, 1, 1, 1), {"limit": "stack"}))
        raise ProgramError(bag.in_order()) from None


def _compile(source: SourceFile, resolver: FileResolver, bag: DiagnosticBag) -> Program:
    loader, resolution = understand(source, resolver, bag)
    if bag.error_count:
        raise ProgramError(without_consequences(bag), loader.sources)
    analysis = YieldAnalysis(resolution)
    analysis.run()
    parts = ProgramParts(resolution, analysis, HOST.placed_names)
    codes = tuple(compile_file(parts, loader.trees, n) for n in range(len(loader.trees)))
    return Program(
        main=source.name,
        sources=loader.sources,
        resolver=resolver,
        diagnostics=bag.in_order(),
        codes=codes,
        sites=parts.sites,
        strings=parts.strings,
        places=parts.places,
        global_names=tuple(resolution.globals),
        functions=facts_of(resolution),
        exports=loader.exports,
    )


def understand(source: SourceFile, resolver: FileResolver, bag: DiagnosticBag) -> tuple[Loader, Resolution]:
    """Read and resolve a program, its includes too; all errors go to `bag`.

    A program with errors of syntax is resolved as far as it was understood.
    """
    loader = Loader(resolver, bag)
    loader.load(source)
    if bag.error_count:
        resolution = resolve_despite_errors(loader.trees, loader.sources, bag)
    else:
        resolution = resolve_program(loader.trees, HOST.names, bag)
    loader.exports = read_exports(loader.trees, loader.sources, bag)
    return loader, resolution


def without_consequences(bag: DiagnosticBag) -> tuple[Diagnostic, ...]:
    """The diagnostics in order, without what follows on a line that the scanner already reported."""
    scanned = {(d.span.file, d.span.line) for d in bag.items if d.code.startswith("E1")}
    return tuple(
        d
        for d in bag.in_order()
        if d.code[:2] not in ("E2", "E3") or (d.span.file, d.span.line) not in scanned
    )


def compile_file(parts: ProgramParts, trees: list[ast.FileTree], index: int) -> CodeType:
    """The code of one file: its functions, and `m_<index>`, which runs it."""
    tree = trees[index]
    numbers = {t.name: n for n, t in enumerate(trees)}
    includes = {span: numbers[name] for span, name in tree.includes.items()}
    module = emit_file(parts, tree, index, includes)
    check_tree(module)
    return _compile_tree(module, tree.name)


def _compile_tree(module: py.Module, file_name: str) -> CodeType:
    with warnings.catch_warnings():
        # Python warns of calls of numbers and the like; the language reports them itself.
        warnings.simplefilter("ignore")
        return compile(module, file_name, "exec", dont_inherit=True)


def facts_of(resolution: Resolution) -> tuple[FunctionFacts, ...]:
    """What messages say of every function, by its index."""
    ordered = sorted(resolution.functions.values(), key=lambda info: info.index)
    return tuple(FunctionFacts(i.name, _wanted(i), i.takes_self) for i in ordered)


def _wanted(info: FunctionInfo) -> str:
    most = len(info.node.parameters)
    least = sum(p.default is None for p in info.node.parameters)
    return str(most) if least == most else f"{least} to {most}"

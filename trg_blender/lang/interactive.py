"""A program that is entered piece by piece: every entry is a file that runs after the ones before.

Variables, objects, the scene and included files stay. Each entry has a budget of its own, as a frame
has. Entries that do not compile leave nothing behind; one that fails while it runs keeps what it did.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import CodeType
from typing import cast

from . import ast
from .bind import HOST
from .cursor import MAX_DEPTH
from .diagnostics import Diagnostic, DiagnosticBag, Notice, ProgramError
from .emit_expr import ProgramParts
from .exports import read_exports
from .faults import FaultReader
from .files import FileResolver
from .helpers import PAUSE, Helpers
from .library.mth import Pcg32
from .library.scene_methods import SceneObject
from .limits import HostOptions
from .parse import parse_source
from .program import Loader, Program, compile_file, facts_of, without_consequences
from .resolve import Resolution, resolve_program
from .runtime import CALL_LEVELS, Runtime
from .scan import scan_source
from .source import SourceFile, Span
from .values import TrgError, Undef, format_value
from .yields import YieldAnalysis

LAST_VALUE = "last::value"
"""The global that holds the value of the last entry that was an expression."""


_LAST = "g_" + LAST_VALUE


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of an entry. `value` is its last expression's in words, None when it has none."""

    value: str | None
    output: tuple[str, ...]
    diagnostics: tuple[Diagnostic, ...]
    frames: int
    """How often it called Scene.Render()."""

    @property
    def failed(self) -> bool:
        return any(d.severity == "error" for d in self.diagnostics)


class Interactive:
    """Takes entries one after the other. `sources` are the texts that diagnostics point into."""

    def __init__(self, resolver: FileResolver, options: HostOptions) -> None:
        self._resolver = resolver
        self._options = options
        self._count = 0
        self._trees: list[ast.FileTree] = []
        self._codes: list[CodeType] = []
        self._plain: set[int] = set()
        """Indices of functions whose translation cannot suspend."""
        self.sources: dict[str, SourceFile] = {}
        start = Program("<0>", {}, resolver, (), (), {}, {}, {}, (), (), {})
        self._rt = Runtime(start, options)
        self._rt.scene = SceneObject(self._rt)
        self._rt.random = Pcg32(0)

    @property
    def global_names(self) -> tuple[str, ...]:
        """The variables that entries have assigned."""
        return tuple(name for name in self._rt.program.global_names if name != LAST_VALUE)

    def cancel(self) -> None:
        """Let the running entry end at its next slice. May be called from a signal handler."""
        self._rt.cancelled = True

    def enter(self, text: str) -> Outcome:
        """Compile and run one entry."""
        self._count += 1
        name = f"<{self._count}>"
        shown, warned = len(self._rt.output), len(self._rt.bag.items)
        self.sources[name] = SourceFile.from_text(name, text)
        try:
            lints = self._compile(self.sources[name])
        except ProgramError as error:
            return Outcome(None, (), error.diagnostics, 0)
        tree = next(n for n, tree in enumerate(self._trees) if tree.name == name)
        before = self._rt.globals.get(_LAST)
        frames, failure = self._run(f"m_{tree}")
        found = [*lints, *self._rt.bag.items[warned:]]
        value = None
        if failure is None and frames < self._options.frames and _keeps_value(self._trees[tree]):
            value = self._take_value(before)
        return Outcome(
            value,
            tuple(self._rt.output[shown:]),
            tuple(found if failure is None else [*found, failure]),
            frames,
        )

    def _take_value(self, before: object) -> str | None:
        """The value that an entry left, in words; without one the value `before` it stays."""
        value = self._rt.globals[_LAST]
        if type(value) is not Undef:
            return format_value(value)
        self._rt.globals[_LAST] = before
        return None

    # Compiling.

    def _compile(self, source: SourceFile) -> list[Diagnostic]:
        """Add an entry to the program; its lints. Raises ProgramError, and then nothing is added."""
        bag = DiagnosticBag(self._options.language)
        loader = Loader(self._resolver, bag)
        loader.trees, before = list(self._trees), len(self._trees)
        loader.sources = {tree.name: self.sources[tree.name] for tree in self._trees}
        loader.load(source)
        if bag.error_count:
            raise ProgramError(without_consequences(bag))
        loader.trees[before] = _keeping_value(loader.trees[before])
        new = {tree.name for tree in loader.trees[before:]}
        resolution = self._resolve(loader.trees, bag)
        exports = read_exports(loader.trees[before:], loader.sources, bag)
        if bag.error_count:
            raise ProgramError(without_consequences(bag))
        self.sources.update(loader.sources)
        self._adopt(loader.trees, resolution, before, bag)
        self._rt.program.exports.update(exports)
        return [d for d in bag.in_order() if d.span.file in new or d.code == "W704"]

    @staticmethod
    def _resolve(trees: list[ast.FileTree], bag: DiagnosticBag) -> Resolution:
        try:
            resolution = resolve_program(trees, HOST.names, bag)
        except RecursionError:
            bag.add(Notice("E220", Span(trees[-1].name, 1, 1, 1, 1), {"limit": MAX_DEPTH}))
            return Resolution(HOST.names)
        # Any later entry may name a variable of this one.
        resolution.file_variables.clear()
        return resolution

    def _adopt(
        self, trees: list[ast.FileTree], resolution: Resolution, before: int, bag: DiagnosticBag
    ) -> None:
        """Translate the files from number `before` on and make their functions known.

        What earlier entries use keeps its name: strings and places are numbered on.
        """
        analysis = YieldAnalysis(resolution)
        analysis.run()
        self._warn_of_plain(resolution, bag)
        old = self._rt.program
        parts = ProgramParts(resolution, analysis, HOST.placed_names)
        parts.sites, parts.strings, parts.places = old.sites, old.strings, old.places
        parts.has_self = parts.compare_overloaded = True
        codes = [compile_file(parts, trees, n) for n in range(before, len(trees))]
        self._trees = trees
        self._codes += codes  # kept: places are found by the identity of a code object
        self._rt.program = replace(
            old, main=trees[before].name, codes=tuple(codes), global_names=tuple(resolution.globals),
            functions=facts_of(resolution),
        )  # fmt: skip
        scope = self._rt.globals
        for name, value in Helpers(self._rt).table().items():
            if name not in scope or not name.startswith(("g_", "c_", "p_")):
                scope[name] = value
        for code in codes:
            exec(code, scope)  # noqa: S102 - translated and checked by check.check_tree

    def _warn_of_plain(self, resolution: Resolution, bag: DiagnosticBag) -> None:
        """A function that was translated as one that cannot suspend calls one that can now."""
        for info in resolution.functions.values():
            if not info.yields:
                self._plain.add(info.index)
            elif info.index in self._plain:
                bag.add(Notice("W704", info.node.span, {"name": info.name}), "warning")

    # Running.

    def _run(self, main: str) -> tuple[int, Diagnostic | None]:
        """Run a file; how many frames it rendered, and what ended it before its end."""
        rt, frames = self._rt, 0
        rt.cancelled = False
        rt.begin_frame()
        running = rt.globals[main](CALL_LEVELS)  # type: ignore[operator]
        rt.globals["S_"] = iter(())
        try:
            while True:
                event = next(running)
                if event is PAUSE:
                    self._next_slice(running)
                    continue
                frames += 1
                rt.frame += 1
                rt.begin_frame()
                if frames >= self._options.frames:
                    running.close()
                    return frames, None
        except StopIteration:
            return frames, None
        except Exception as error:  # the border: every fault of an entry becomes a diagnostic
            return frames, FaultReader(rt).read(error)

    def _next_slice(self, running: object) -> None:
        scope = self._rt.globals
        if next(scope["S_"], PAUSE) is PAUSE:  # type: ignore[call-overload]
            try:
                scope["S_"] = self._rt.next_slice()
            except TrgError as error:  # a limit: let it surface at the loop that is running
                running.throw(error)  # type: ignore[attr-defined]


def _keeps_value(tree: ast.FileTree) -> bool:
    """Whether `_keeping_value` made the tree's last statement."""
    last = tree.statements[-1] if tree.statements else None
    if not isinstance(last, ast.ExprStatement) or not isinstance(last.value, ast.Assign):
        return False
    target = last.value.target
    return isinstance(target, ast.Path) and target.name == LAST_VALUE


def _keeping_value(tree: ast.FileTree) -> ast.FileTree:
    """The tree of an entry whose last statement, if it is an expression, keeps its value."""
    last = tree.statements[-1] if tree.statements else None
    if not isinstance(last, ast.ExprStatement) or isinstance(last.value, ast.Assign | ast.Step):
        return tree
    value = last.value
    target = ast.Path(value.span, LAST_VALUE)
    kept = ast.ExprStatement(last.span, ast.Assign(value.span, "=", target, value, value.depth + 1))
    return replace(tree, statements=(*tree.statements[:-1], cast(ast.Statement, kept)))


def is_complete(text: str) -> tuple[bool, str]:
    """Whether an entry is whole, and the entry: a `;` that only its end lacks is added.

    A text is not whole while a bracket or comment is open or the parser wants more at its end.
    """
    bag = DiagnosticBag()
    tokens = scan_source(SourceFile.from_text("", text), bag)
    if any(d.code == "E106" for d in bag.items):
        return False, text
    if bag.error_count:
        return True, text
    depth = sum((t.text in ("(", "{", "[")) - (t.text in (")", "}", "]")) for t in tokens if t.kind == "op")
    if depth > 0:
        return False, text
    end = (tokens[-2].span.end_line, tokens[-2].span.end_col) if len(tokens) > 1 else (1, 1)
    at_end = [d for d in _errors(text) if (d.span.line, d.span.col) >= end]
    if any(d.fix is None for d in at_end):  # the one fix of the parser is the missing `;`
        return False, text
    for tried in (text + ";", text + "\n;") if at_end else ():
        if not _errors(tried):
            return True, tried
    return True, text


def _errors(text: str) -> list[Diagnostic]:
    bag = DiagnosticBag()
    parse_source(SourceFile.from_text("", text), bag)
    return [d for d in bag.items if d.severity == "error"]

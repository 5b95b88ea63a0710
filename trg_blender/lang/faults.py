"""From a Python exception in translated code to a diagnostic with TRG's place, words and calls."""

from __future__ import annotations

import re
from types import FunctionType, TracebackType

from .bind import HOST, wrong_count
from .diagnostics import Diagnostic, Notice, build_diagnostic, closest, is_certain
from .limits import MAX_CALL_DEPTH
from .runtime import Runtime, Site
from .source import Span
from .values import FIELD, Obj, TrgError, Undef, incomputable, type_name

# Python words the errors of plain floats and functions itself; these are its wordings since 3.11.
_UNSUPPORTED = re.compile(r"unsupported operand type\(s\) for (\S+): '(\w+)' and '(\w+)'")
_UNORDERED = re.compile(r"'(\S+)' not supported between instances of '(\w+)' and '(\w+)'")
_UNARY = re.compile(r"bad operand type for unary (\S): '(\w+)'")
_NOT_CALLABLE = re.compile(r"'(\w+)' object is not callable")
_NO_ATTRIBUTE = re.compile(r"'(\w+)' object (?:has no attribute|attribute) 'T_([^']*)'")
_MISSING = re.compile(r"f_(\d+)\(\) missing \d+ required positional arguments?: '([^']+)'")
_NO_ELEMENTS = re.compile(r"'(\w+)' object (?:is not subscriptable|does not support item assignment)")
_TUPLE_INDEX = "tuple indices must be"
_TOO_MANY = re.compile(r"f_(\d+)\(\) takes .* but (\d+) (?:was|were) given")
_WRONG_COUNT = re.compile(r"T_(\S+)\(\) (?:missing (\d+) required|takes .* but (\d+) (?:was|were) given)")
_KINDS = {
    "float": "num",
    "function": "function",
    "method": "function",
    "HostFunction": "function",
    "generator": "generator",
    "Obj": "object",
    "Undef": "undef",
}


def _kind(python_name: str) -> str:
    return _KINDS.get(python_name, python_name.lower().removesuffix("value"))


def _article(word: str) -> str:
    return "an" if word[0] in "aeiou" else "a"


class FaultReader:
    """Explains exceptions of one run."""

    def __init__(self, rt: Runtime) -> None:
        self.rt = rt

    def read(self, error: BaseException) -> Diagnostic:
        """The diagnostic of an exception that left the translated code."""
        places = self._places(error.__traceback__)
        site = places[-1][1] if places else Site(self.rt.program.start)
        told = self._too_deep(error, places) or self._explain(error, site)
        span = site.span
        if told.operand is not None and told.operand < len(site.operands):
            span = site.operands[told.operand]
        related: tuple[tuple[Span, str], ...] = ()
        if told.argument is not None and told.argument + 1 < len(site.operands):
            related = ((site.operands[told.argument + 1], "argument_here"),)
        if told.code == "E900":
            told.hint = "repeat"
            told.values["command"] = f"trg run {self.rt.program.main}"
        notice = Notice(told.code, span, told.values, told.hint, None, related)
        made = build_diagnostic(notice, "error", self.rt.options.language)
        return Diagnostic(
            made.code, made.severity, made.message, made.span, made.hint, made.related,
            self._stack(places), self._renaming(told, span),
        )  # fmt: skip

    def _renaming(self, told: TrgError, span: Span) -> tuple[Span, str] | None:
        """The fix that puts the name that was meant at the end of `span`, if the text there is the other."""
        source = self.rt.program.sources.get(span.file)
        if told.renamed is None or source is None:
            return None
        written, meant = told.renamed
        first = span.end_col - len(written)
        if first < 1 or source.lines[span.end_line - 1][first - 1 : span.end_col - 1] != written:
            return None
        return Span(span.file, span.end_line, first, span.end_line, span.end_col), meant

    def _places(self, trace: TracebackType | None) -> list[tuple[str, Site]]:
        """(function, place) of every frame of translated code, outermost first."""
        found = []
        while trace is not None:
            frame = trace.tb_frame
            if frame.f_globals is self.rt.globals:
                code = frame.f_code
                found.append((code.co_name, self.rt.site_at(code, trace.tb_lasti)))
            trace = trace.tb_next
        return found

    def _stack(self, places: list[tuple[str, Site]]) -> tuple[tuple[str, Span], ...]:
        calls = [
            (self.rt.program.function_name(name), places[n][1].span)
            for n, (name, _) in enumerate(places[1:])
            if name.startswith("f_")
        ]
        return tuple(reversed(calls))

    def _too_deep(self, error: BaseException, places: list[tuple[str, Site]]) -> TrgError | None:
        """The only subscript in translated functions that can fail is the one that counts calls."""
        trace = error.__traceback__
        if not isinstance(error, IndexError) or trace is None or not places:
            return None
        while trace.tb_next is not None:
            trace = trace.tb_next
        name = places[-1][0]
        if trace.tb_frame.f_globals is not self.rt.globals or not name.startswith("f_"):
            return None
        name = self.rt.program.function_name(name)
        return TrgError("E607", "fixed_limit", name=name, limit=MAX_CALL_DEPTH)

    def _explain(self, error: BaseException, site: Site) -> TrgError:
        """What to say of an exception. `++` is translated to a subtraction: it is named as written."""
        told = self._read(error, site)
        if told.code == "E410" and site.op in ("++", "--"):
            return TrgError("E413", op=site.op, kind=told.values["left"])
        return told

    def _read(self, error: BaseException, site: Site) -> TrgError:
        if isinstance(error, TrgError):
            return error
        if isinstance(error, ZeroDivisionError):
            return TrgError("E401")
        if isinstance(error, RecursionError):
            return TrgError("E607", "fixed_limit", name="function", limit=MAX_CALL_DEPTH)
        if isinstance(error, MemoryError):
            return TrgError("E611")
        if isinstance(error, AttributeError):
            return self._field_error(error, site)
        if isinstance(error, TypeError):
            return self._type_error(str(error), site)
        return TrgError("E900", kind=type(error).__name__)

    def _field_error(self, error: AttributeError, site: Site) -> TrgError:
        name = error.name
        if name is None or not name.startswith(FIELD) or error.obj is None:
            return self._unset_field(str(error), site)
        if site.op == ".=" and not isinstance(error.obj, Obj | FunctionType):
            return self._unset_field(str(error), site)
        return field_error(error.obj, name.removeprefix(FIELD), site)

    @staticmethod
    def _unset_field(text: str, site: Site) -> TrgError:
        """Setting a field that cannot be: Python names neither the object nor the field apart."""
        match = _NO_ATTRIBUTE.search(text)
        if match is None:
            return TrgError("E900", kind="AttributeError")
        kind, name = _kind(match[1]), match[2]
        if kind == "undef":
            return TrgError("E422", name=_name_of(site))
        if kind in ("num", "str"):
            return TrgError("E420", article=_article(kind), kind=kind, name=name)
        return TrgError("E424", kind=kind, name=name)

    def _type_error(self, text: str, site: Site) -> TrgError:
        if match := _UNSUPPORTED.search(text):
            op = match[1].removesuffix("=") or match[1]
            return incomputable(op, _kind(match[2]), _kind(match[3]))
        if match := _UNORDERED.search(text):
            left, right = _kind(match[2]), _kind(match[3])
            if "generator" in (left, right):
                return TrgError("E415")
            return TrgError("E412", op=match[1], left=left, right=right)
        if match := _UNARY.search(text):
            return TrgError("E413", op=match[1], kind=_kind(match[2]))
        if match := _NOT_CALLABLE.search(text):
            return self._not_callable(_kind(match[1]), site)
        if match := _NO_ELEMENTS.search(text):
            kind = _kind(match[1])
            return TrgError("E415") if kind == "generator" else TrgError("E440", kind=kind)
        if text.startswith(_TUPLE_INDEX):
            return TrgError("E440", kind="vec3")
        if match := _WRONG_COUNT.match(text):
            return _wrong_count_of_builtin(match[1], match[2], match[3])
        if match := _MISSING.search(text):
            info = self.rt.program.functions[int(match[1])]
            return TrgError("E432", name=info.name, parameter=match[2].removeprefix("l_"))
        if match := _TOO_MANY.search(text):
            info = self.rt.program.functions[int(match[1])]
            return TrgError("E433", name=info.name, wanted=info.wanted, given=int(match[2]) - 1)
        return TrgError("E900", kind="TypeError")

    @staticmethod
    def _not_callable(kind: str, site: Site) -> TrgError:
        if kind == "undef":
            return TrgError("E431", name=_name_of(site))
        return TrgError("E430", article=_article(kind), kind=kind)


def _name_of(site: Site) -> str:
    return site.names[0] if site.names and site.names[0] else "it"


def _wrong_count_of_builtin(name: str, missing: str | None, given: str | None) -> TrgError:
    """A built-in without defaults got too few or too many arguments; methods have two hidden ones."""
    row = HOST.row(name)
    if row is None:
        return TrgError("E900", kind="TypeError")
    if missing is not None:
        return wrong_count(row, len(row.parameters) - int(missing))
    return wrong_count(row, int(given or 0) - (0 if row.owner is None else 2))


def field_error(holder: object, name: str, site: Site) -> TrgError:
    """The error of reading a field that a value does not have."""
    kind = type_name(holder)
    if type(holder) is Undef:
        return TrgError("E422", name=_name_of(site))
    if kind in ("num", "str"):
        return TrgError("E420", article=_article(kind), kind=kind, name=name)
    candidates = _field_names(holder, kind)
    guess = closest(name, candidates)
    if guess is None:
        return TrgError("E421", kind=kind, name=name)
    told = TrgError("E421", "did_you_mean_field", kind=kind, name=name, guess=guess)
    if is_certain(name, guess, candidates) and not guess.startswith("operator"):
        told.renamed = (name, guess)
    return told


def _field_names(holder: object, kind: str) -> list[str]:
    if isinstance(holder, Obj | FunctionType):
        return [key.removeprefix(FIELD) for key in holder.__dict__ if key.startswith(FIELD)]
    if kind == "vec3":
        return ["x", "y", "z"]
    return HOST.method_names(kind)

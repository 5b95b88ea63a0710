"""Values that a host gives to exported parameters: checks, and reading them from texts."""

from __future__ import annotations

from .diagnostics import Diagnostic, Notice, build_diagnostic, closest
from .exports import Export, ParameterValue, shown_value
from .limits import HostOptions
from .program import Program

_FLAGS = {"1": 1.0, "true": 1.0, "on": 1.0, "0": 0.0, "false": 0.0, "off": 0.0}


class ParameterError(Exception):
    """A value cannot be given to a parameter; `diagnostic` says which and why."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(diagnostic.message + (f"; {diagnostic.hint}" if diagnostic.hint else ""))
        self.diagnostic = diagnostic


def wrong_parameters(program: Program, options: HostOptions) -> tuple[Diagnostic, ...]:
    """What is wrong with `options.parameters`: names that are not exported, values that do not fit."""
    found = []
    for name, value in options.parameters.items():
        export = program.exports.get(name)
        if export is None:
            found.append(_unknown(program, name, options.language))
        elif export.fit(value) is None:
            found.append(_misfit(export, value, options.language))
    return tuple(found)


def parse_parameter(program: Program, text: str, language: str = "en") -> tuple[str, ParameterValue]:
    """The name and value of `name=value`.

    Numbers are written as in a program, flags 1 or 0, vectors and colours as three numbers with
    commas between, strings without quotes. Raises ParameterError; ValueError without a `=`.
    """
    name, separator, written = text.partition("=")
    name, written = name.strip(), written.strip()
    if not separator or not name:
        raise ValueError(f"{text!r} is not NAME=VALUE")
    export = program.exports.get(name)
    if export is None:
        raise ParameterError(_unknown(program, name, language))
    read = _read(export, written)
    value = export.fit(read)
    if value is None:
        raise ParameterError(_misfit(export, written if read is None else read, language))
    return name, value


def _read(export: Export, written: str) -> object:
    if export.type == "str":
        return written
    if export.type == "flag":
        return _FLAGS.get(written.lower())
    try:
        numbers = tuple(float(part) for part in written.split(","))
    except ValueError:
        return None
    return numbers[0] if export.type == "num" and len(numbers) == 1 else numbers


def _unknown(program: Program, name: str, language: str) -> Diagnostic:
    guess = closest(name, program.exports)
    hint = ("did_you_mean", {"name": guess}) if guess is not None else (None, None)
    notice = Notice("E520", program.start, {"name": name[:60]}, *hint)
    return build_diagnostic(notice, "error", language)


def _misfit(export: Export, value: object, language: str) -> Diagnostic:
    values = {"name": export.name, "wanted": export.wanted, "value": shown_value(value)}
    return build_diagnostic(Notice("E521", export.span, values), "error", language)

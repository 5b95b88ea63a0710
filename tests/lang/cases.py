"""Runs the language cases: `python -m tests.lang.cases [NAME or GROUP ...]`.

Prints one line a failure and at the end `N passed, N failed`; the exit status is 1 when one failed.
"""

from __future__ import annotations

import platform
import sys
import tempfile
from pathlib import Path

from trg_blender.lang import (
    Diagnostic,
    DiskFiles,
    FrameEvent,
    HostOptions,
    Limits,
    NoFiles,
    ProgramError,
    SceneDescription,
    Session,
    compile_source,
)
from trg_blender.lang.parameters import ParameterError, parse_parameter

from .case_file import MAIN, Case, CaseError, Finding, all_names, read_case

MAX_FRAMES = 12


class _Run:
    """One run of a case, in `folder` when it has files."""

    def __init__(self, case: Case, folder: Path | None) -> None:
        self.output: list[str] = []
        self.diagnostics: list[Diagnostic] = []
        self.frames = 0
        self.scene: SceneDescription | None = None
        self.exports: object = None
        resolver = NoFiles() if folder is None else DiskFiles(folder)
        try:
            program = compile_source(case.main, MAIN, resolver)
        except ProgramError as error:
            self.diagnostics = list(error.diagnostics)
            return
        self.exports = program.exports
        try:
            given = dict(parse_parameter(program, text) for text in case.parameters)
        except ParameterError as error:
            self.diagnostics = [error.diagnostic]
            return
        session = Session(program, _options(case, given))
        while self.frames < MAX_FRAMES and isinstance(event := session.next_frame(), FrameEvent):
            self.frames += 1
            self.scene = event.scene
        self.output = session.output
        self.diagnostics = [*program.diagnostics, *session.diagnostics]


def _options(case: Case, given: dict[str, object]) -> HostOptions:
    limits = Limits(**case.limits)  # type: ignore[arg-type]
    return HostOptions(limits=limits, parameters=given, **case.options)  # type: ignore[arg-type]


def failure_of(name: str) -> str:
    """What is wrong with a case, in one line; an empty text when it passes."""
    try:
        case = read_case(name)
    except (CaseError, ValueError, KeyError) as error:
        return f"not understood: {error}"
    extra = case.raw_files or case.links or len(case.files) > 1
    if not extra:
        return _compare(case, _Run(case, None))
    with tempfile.TemporaryDirectory() as root:
        project = Path(root, "project")
        project.mkdir()
        _write_files(case, project)
        return _compare(case, _Run(case, project))


def _write_files(case: Case, project: Path) -> None:
    texts = {name: text.encode() for name, text in case.files.items()}
    for name, content in {**texts, **case.raw_files}.items():
        path = project / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    for name, target in case.links.items():
        (project / name).symlink_to(target)


def _compare(case: Case, run: _Run) -> str:
    """The first difference between what a case expects and what came."""
    found = sorted((_place(d), d.code) for d in run.diagnostics)
    wanted = sorted(((f.file, f.line, f.col), f.code) for f in case.findings)
    if found != wanted:
        return f"diagnostics {_shown(run.diagnostics)}, expected {wanted}"
    for finding in case.findings:
        if not any(_says(d, finding) for d in run.diagnostics):
            return f"{finding.code} does not say {finding.words!r}: {_shown(run.diagnostics)}"
    if not _same_output(case.output, run.output):
        return f"output {run.output[:20]}, expected {case.output[:20]}"
    if case.frames is not None and run.frames != case.frames:
        return f"{run.frames} frames, expected {case.frames}"
    calls = sorted((name, str(span)) for d in run.diagnostics for name, span in d.stack)
    if case.calls and calls != sorted(case.calls):
        return f"calls {calls}, expected {case.calls}"
    return _compare_values(case, run)


def _same_output(expected: list[str], output: list[str]) -> bool:
    """Whether the lines agree; a last line `...` stands for any that follow."""
    wanted, found = "\n".join(expected), "\n".join(output)
    return wanted == found or (wanted.endswith("\n...") and found.startswith(wanted[:-3]))


def _place(d: Diagnostic) -> tuple[str, int, int]:
    return d.span.file, d.span.line, d.span.col


def _says(d: Diagnostic, finding: Finding) -> bool:
    here = (_place(d), d.code) == ((finding.file, finding.line, finding.col), finding.code)
    return here and finding.words in f"{d.message} = {d.hint}"


def _shown(diagnostics: list[Diagnostic]) -> list[str]:
    return [f"{d.code} {d.span} {d.message} = {d.hint}" for d in diagnostics]


def _compare_values(case: Case, run: _Run) -> str:
    for path, expected in case.values:
        first, *parts = path.split(".")
        value: object = run.exports if first == "exports" else getattr(run.scene, first, None)
        for part in parts:
            value = _part(value, part)
        if not _close(value, expected):
            return f"{path} is {value!r}, expected {expected!r}"
    return ""


def _part(value: object, part: str) -> object:
    """An element, a field, or the `count` of elements."""
    if part == "count":
        return len(value)  # type: ignore[arg-type]
    if isinstance(value, dict):
        return value.get(part)
    return value[int(part)] if part.isdigit() else getattr(value, part, None)  # type: ignore[index]


def _close(value: object, expected: object) -> bool:
    if isinstance(value, tuple) and isinstance(expected, tuple):
        return len(value) == len(expected) and all(map(_close, value, expected))
    if isinstance(value, float) and isinstance(expected, float | int):
        return abs(value - expected) < 1e-9
    return value == expected


def main(arguments: list[str]) -> int:
    """Run the cases whose name begins with one of the arguments, or all."""
    names = [n for n in all_names() if not arguments or n.startswith(tuple(arguments))]
    failed = 0
    for name in names:
        reason = failure_of(name)
        if reason:
            failed += 1
            sys.stdout.write(f"{name}: {reason}\n")
    sys.stdout.write(f"Python {platform.python_version()}\n")
    sys.stdout.write(f"{len(names) - failed} passed, {failed} failed\n")
    return 1 if failed or not names else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""Reading a language case: one program with what is expected of it in its comments.

    print(7 / 2);            //= 3.5              a line of output; more follow on lines of their own,
                                                  and a last `//= ...` stands for any others
    x = raduis;              //! E302@5: words    an error at this line and column, `words` in its text
    y = u + 1;               //? W701@5           a warning or lint; `@3:5` means line 3, column 5
    f();                     //< f@1              the error was called from f here (all calls, if any)
    //& camera.width = 640                        a value of the last frame's SceneDescription, or of
    //& exports.radius.high = 10                  the program's exported parameters

Directives stand on lines of their own: the case as it lies there is the program that runs.

    //@ limit max_steps = 1000       a field of Limits          //@ option fps = 25   of HostOptions
    //@ frames 3                     how many frames it hands over (a run stops after MAX_FRAMES)
    //@ newline crlf                 line ends: lf, crlf or cr  //@ bom               byte order mark
    //@ let LONG = "x{i}" * 65       ${LONG} is that text, i = 1, 2, ... and j = i + 1
    //@ set radius = 4               an exported parameter, as `--set` gives it
    //@ file lib/a.trg               the lines that follow are this file, beside the program's
    //@ files f{i}.trg * 9 = "..."   nine files                 //@ bytes a.trg ff 00   a file of bytes
    //@ link a.trg -> ../b.trg       a symbolic link

Nothing but the standard library is needed, so that a bare Python can run the cases.
"""

from __future__ import annotations

import ast
import json
import re
from dataclasses import dataclass, field
from pathlib import Path

FOLDER = Path(__file__).resolve().parent / "cases"
MAIN = "main.trg"
NEWLINES = {"lf": "\n", "crlf": "\r\n", "cr": "\r"}

_DIRECTIVE = re.compile(r"^//@ (\w+) ?(.*)$")
_LET = re.compile(r'^//@ let (\w+) = (".*")(?: \* (\d+))?$', re.MULTILINE)
_FINDING = re.compile(
    r"//[!?] (?P<code>[EWL]\d{3})@(?:(?P<line>\d+):)?(?P<col>\d+)(?:: (?P<words>.*?))?(?= *//[!?=<] |\s*$)"
)
_CALL = re.compile(r"//< (?P<name>\S+)@(?:(?P<line>\d+):)?(?P<col>\d+)")
_OUTPUT = re.compile(r"//=(?: (.*))?$")
_VALUE = re.compile(r"//& (\S+) = (.*)$")


class CaseError(Exception):
    """The case itself is written wrong."""


@dataclass(frozen=True, order=True)
class Finding:
    """A diagnostic that is expected; `words` stand in its message or hint."""

    file: str
    line: int
    col: int
    code: str
    words: str = ""


@dataclass
class Case:
    """One program and what is expected of it."""

    name: str
    files: dict[str, str] = field(default_factory=dict)
    """Texts by name; the program is `main.trg`."""
    raw_files: dict[str, bytes] = field(default_factory=dict)
    links: dict[str, str] = field(default_factory=dict)
    limits: dict[str, object] = field(default_factory=dict)
    options: dict[str, object] = field(default_factory=dict)
    parameters: list[str] = field(default_factory=list)
    """`name=value`, as `--set` takes them."""
    frames: int | None = None
    output: list[str] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)
    calls: list[tuple[str, str]] = field(default_factory=list)
    """(function, file:line:col), in the order of the text."""
    values: list[tuple[str, object]] = field(default_factory=list)
    """(path, value) in the last frame's scene or the program's exports."""
    newline: str = "\n"
    bom: str = ""

    @property
    def main(self) -> str:
        return self.bom + self.files[MAIN].replace("\n", self.newline)


def all_names() -> list[str]:
    """The names of all cases: `group/fact`."""
    return sorted(p.relative_to(FOLDER).with_suffix("").as_posix() for p in FOLDER.rglob("*.trg"))


def read_case(name: str) -> Case:
    """The case of that name. Raises CaseError when it expects nothing or is not understood."""
    text = (FOLDER / f"{name}.trg").read_text(encoding="utf-8")
    for key, value, times in _LET.findall(text):
        text = text.replace("${" + key + "}", _repeated(json.loads(value), int(times or 1)))
    case = Case(name)
    blocks = re.split(r"^//@ file (\S+)\n", text, flags=re.MULTILINE)
    for file, block in zip([MAIN, *blocks[1::2]], blocks[0::2], strict=True):
        case.files[file] = block
        for number, line in enumerate(block.split("\n"), 1):
            _read_line(case, file, number, line)
    if not (case.output or case.findings or case.values or case.frames is not None):
        raise CaseError(f"{name} expects nothing")
    return case


def _repeated(text: str, times: int) -> str:
    return "".join(_numbered(text, i) for i in range(1, times + 1))


def _numbered(text: str, i: int) -> str:
    return text.replace("{i}", str(i)).replace("{j}", str(i + 1))


def _read_line(case: Case, file: str, number: int, line: str) -> None:
    """Note what one line expects."""
    if match := _DIRECTIVE.match(line):
        _read_directive(case, match[1], match[2])
        return
    for match in _FINDING.finditer(line):
        place = (file, int(match["line"] or number), int(match["col"]))
        case.findings.append(Finding(*place, match["code"], match["words"] or ""))
    for match in _CALL.finditer(line):
        case.calls.append((match["name"], f"{file}:{match['line'] or number}:{match['col']}"))
    if match := _OUTPUT.search(line):
        case.output.append(match[1] or "")
    if match := _VALUE.search(line):
        case.values.append((match[1], ast.literal_eval(match[2])))
    marks = len(re.findall(r"//[!?] [EWL]\d", line))
    if marks != len(_FINDING.findall(line)):
        raise CaseError(f"{case.name}:{number}: a mark is not understood")


def _read_directive(case: Case, word: str, rest: str) -> None:
    key, _, value = (part.strip() for part in rest.partition("="))
    if word == "limit":
        case.limits[key] = json.loads(value)
    elif word == "option":
        case.options[key] = json.loads(value)
    elif word == "set":
        case.parameters.append(f"{key}={value}")
    elif word == "frames":
        case.frames = int(rest)
    elif word == "newline":
        case.newline = NEWLINES[rest]
    elif word == "bom":
        case.bom = "\ufeff"
    elif word == "files":
        pattern, _, times = key.partition(" * ")
        text = json.loads(value) if value else ""
        for i in range(1, int(times) + 1):
            case.files[_numbered(pattern, i)] = _numbered(text, i)
    elif word == "bytes":
        name, _, digits = rest.partition(" ")
        case.raw_files[name] = bytes.fromhex(digits)
    elif word == "link":
        name, _, target = rest.partition(" -> ")
        case.links[name] = target
    elif word != "let":
        raise CaseError(f"{case.name}: unknown directive '{word}'")

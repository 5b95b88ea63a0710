"""The language cases, one test each, and their bond with docs/language.md and the message table."""

from __future__ import annotations

import re
from types import ModuleType

import pytest

from trg_blender.lang import Limits, cursor, limits, parse, scan
from trg_blender.lang.messages import MESSAGES

from .case_file import all_names, read_case
from .cases import failure_of
from .conformance import FOLDER, ROOT

SPECIFICATION = ROOT / "docs" / "language.md"
_ID = re.compile(r"\[([a-z]+/[a-z0-9_]+)\]")

WITHOUT_CASE = {
    "E609": "the host cancels from outside: tests/lang/test_session.py",
    "E611": "needs a computer without memory",
    "W704": "belongs to programs entered line by line: trg repl",
    "E900": "stands for a fault of ours that is not known yet",
}
"""Codes that no program brings up by itself, with the reason."""


@pytest.mark.parametrize("name", all_names())
def test_case(name: str) -> None:
    assert failure_of(name) == ""


def test_there_are_enough_cases() -> None:
    assert len(all_names()) >= 350


def test_the_specification_names_every_case_and_no_other() -> None:
    named = set(_ID.findall(SPECIFICATION.read_text(encoding="utf-8")))
    assert named == set(all_names())


def test_every_code_has_a_case_or_a_reason() -> None:
    shown = {finding.code for name in all_names() for finding in read_case(name).findings}
    assert set(MESSAGES) - shown == set(WITHOUT_CASE)


def test_the_specification_lists_the_keywords() -> None:
    text = SPECIFICATION.read_text(encoding="utf-8")
    listed = [set(line.split()) for line in text.splitlines() if line.startswith("    if else ")]
    assert listed == [set(scan.KEYWORDS)]


def test_the_specification_gives_the_limits() -> None:
    rows = [line for line in SPECIFICATION.read_text(encoding="utf-8").splitlines() if line.startswith("| ")]
    given = {int(n.replace(" ", "")) for row in rows for n in re.findall(r"\d[\d ]*", row.split("|")[2])}
    ours = Limits()
    fixed = [value for room in (cursor, limits, parse, scan) for value in _limits_of(room)]
    hosts = [ours.max_steps, ours.max_seconds, ours.max_string, ours.max_blocks, ours.max_shapes]
    output = [ours.output_lines_frame, ours.output_lines, ours.output_columns, ours.max_elements]
    megabytes = [ours.max_text_bytes // 2**20, ours.max_bytes // 2**20]
    assert {*fixed, *hosts, *output, *megabytes} - given == set()


def _limits_of(room: ModuleType) -> list[int]:
    return [value for name, value in vars(room).items() if name.startswith("MAX_")]


def test_cases_are_not_those_of_the_shared_data() -> None:
    if not FOLDER.is_dir():
        pytest.skip("the shared conformance programs are not here")
    theirs = {_bare(path.read_bytes().decode("utf-8")) for path in FOLDER.rglob("*.trg")}
    same = [name for name in all_names() if _bare(read_case(name).main) in theirs]
    assert same == []


def _bare(text: str) -> str:
    """A program without comments and spaces."""
    return re.sub(r"\s+", "", re.sub(r"//[^\n]*", "", text))

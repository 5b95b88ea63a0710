"""The generated reference: whole, in step with the tables, and committed as it is generated."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path

import pytest

from trg_blender.cli import main
from trg_blender.lang import HOST
from trg_blender.lang.messages import MESSAGES
from trg_blender.lang.parse_expr import PRECEDENCE
from trg_blender.lang.reference import head_lines, reference_html, reference_markdown
from trg_blender.lang.resolve import TYPE_NAMES
from trg_blender.lang.scan import KEYWORDS
from trg_blender.lang.words import KEYWORD_DOCS, OPERATOR_DOCS, TYPE_DOCS

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def markdown() -> str:
    return reference_markdown()


def test_the_committed_reference_is_the_generated_one(markdown: str):
    committed = (ROOT / "docs/reference.md").read_text(encoding="utf-8")
    assert committed == markdown, "run: trg doc --out docs"


def test_every_keyword_operator_and_type_is_documented():
    assert set(KEYWORD_DOCS) == KEYWORDS
    assert set(OPERATOR_DOCS) == set(PRECEDENCE)
    assert set(TYPE_NAMES) <= set(TYPE_DOCS)


def test_every_built_in_method_and_code_stands_in_it(markdown: str):
    rows = [*HOST.functions.values(), *HOST.methods.values()]
    assert [r.name for r in rows if f"`{r.shown}(" not in markdown] == []
    assert [c for c in HOST.constants if f"`{c} = " not in markdown] == []
    assert [code for code in MESSAGES if f"| `{code}` |" not in markdown] == []


def test_every_library_file_stands_in_it_with_its_head(markdown: str):
    for path in (ROOT / "stl").rglob("*.trg"):
        assert f"### {path.relative_to(ROOT).as_posix()}\n" in markdown
        first = next(line for line in head_lines(path) if line)
        assert first in markdown, path


def test_every_link_of_the_contents_has_its_heading(markdown: str):
    links = re.findall(r"^- \[.*\]\(#(.*)\)$", markdown, re.MULTILINE)
    headings = re.findall(r"^## (.*)$", markdown, re.MULTILINE)
    assert links == [re.sub(r"[^\w\- ]", "", h.lower()).replace(" ", "-") for h in headings]
    assert len(links) > 8


def test_every_table_row_has_as_many_cells_as_its_header(markdown: str):
    for table in re.findall(r"(?:^\|.*\|\n)+", markdown, re.MULTILINE):
        counts = {len(re.findall(r"(?<!\\)\|", row)) for row in table.splitlines()}
        assert len(counts) == 1, table[:200]


class _Balance(HTMLParser):
    """Collects headings and sees whether every element is closed in order."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.headings: list[str] = []

    def handle_starttag(self, tag, attrs):
        if tag != "meta":
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and re.fullmatch(r"h\d", self.open[-1]):
            self.headings.append(data)


def test_the_page_is_well_formed_and_has_the_same_headings(markdown: str):
    page = _Balance()
    page.feed(reference_html())
    page.close()
    assert page.open == []
    without_code = re.sub(r"```.*?```", "", markdown, flags=re.DOTALL)
    assert page.headings == re.findall(r"^#+ (.*)$", without_code, re.MULTILINE)


def test_the_command_writes_markdown_or_a_page(tmp_path: Path, capsys, markdown: str):
    assert main(["doc"]) == 0
    assert capsys.readouterr().out == markdown
    assert main(["doc", "--html", "--out", str(tmp_path / "new")]) == 0
    assert (tmp_path / "new/reference.html").read_text(encoding="utf-8").startswith("<!doctype html>")
    assert main(["doc", "--out", str(tmp_path)]) == 0
    assert (tmp_path / "reference.md").read_text(encoding="utf-8") == markdown


def test_the_two_forms_exclude_each_other():
    assert main(["doc", "--html", "--markdown"]) == 2

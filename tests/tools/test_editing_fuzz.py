"""What an editor asks about half-written programs is answered, whatever stands there."""

from __future__ import annotations

from pathlib import Path
from random import Random

from hypothesis import given, settings
from hypothesis import strategies as st

from trg_blender.lang import DiskFiles
from trg_blender.lang.analysis import analyse_source
from trg_blender.lang.completion import complete
from trg_blender.lang.hover import define, describe
from trg_blender.lang.interactive import is_complete

ROOT = Path(__file__).resolve().parents[2]
TEXTS = [path.read_text(encoding="utf-8") for path in sorted((ROOT / "examples").glob("*.trg"))[:6]]
INSERTED = (
    ".",
    "::",
    "#",
    "~",
    "(",
    ")",
    "{",
    "}",
    "[",
    '"',
    "/*",
    "//",
    ";",
    "шар",
    "🎈",
    "\n",
    "\\",
    "include(",
)


def half_written(seed: int) -> tuple[str, Random]:
    """A part of an example with something taken out or put in."""
    random = Random(seed)
    text = random.choice(TEXTS)
    for _ in range(random.randrange(1, 4)):
        at = random.randrange(len(text) + 1)
        text = text[:at] + random.choice(INSERTED) + text[at + random.choice((0, 0, 1, 30)) :]
    start = random.choice((0, random.randrange(len(text) + 1)))
    return text[start : start + random.randrange(1200)], random


@settings(deadline=None, max_examples=120)
@given(st.integers(0, 2**48))
def test_every_question_about_any_place_is_answered(seed: int):
    text, random = half_written(seed)
    analysis = analyse_source(text, "main.trg", DiskFiles(ROOT / "examples"))
    lines = analysis.sources["main.trg"].lines
    for _ in range(6):
        line = random.randrange(len(lines)) + 1
        col = random.randrange(len(lines[line - 1]) + 1) + 1
        labels = [s.label for s in complete(analysis, line, col)]
        assert len(labels) == len(set(labels))
        described = describe(analysis, line, col)
        assert described is None or described[0]
        found = define(analysis, line, col)
        assert found is None or found.file in analysis.sources
    assert all(d.code != "E900" for d in analysis.diagnostics)
    is_complete(text)

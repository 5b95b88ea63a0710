"""The gallery shows every example, with pictures that exist and are small."""

from __future__ import annotations

import re
import struct

from .library import EXAMPLES, ROOT

DOCS = ROOT / "docs"
TEXT = (DOCS / "examples.md").read_text(encoding="utf-8")
SHOWN = re.findall(r"!\[[^\]]+\]\(([^)]+)\)", TEXT)


def test_every_example_has_a_sentence():
    assert sorted(set(re.findall(r"\(\.\./examples/(\w+\.trg)\)", TEXT))) == EXAMPLES


def test_the_pictures_are_there_and_few():
    assert all((DOCS / name).is_file() for name in SHOWN)
    assert len(list(DOCS.rglob("*.png"))) <= 15


def test_pictures_are_png_of_at_most_400_kilobytes():
    for name in SHOWN:
        data = (DOCS / name).read_bytes()
        assert data.startswith(b"\x89PNG\r\n\x1a\n") and len(data) <= 400_000
        width, height = struct.unpack(">II", data[16:24])
        assert 600 <= width <= 1100 and 250 <= height <= 700


def test_the_pictures_of_the_readme_are_there():
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    for name in re.findall(r"!\[[^\]]*\]\((docs/[^)]+)\)", readme):
        assert (ROOT / name).is_file()

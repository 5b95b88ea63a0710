"""The tables of the language agree with each other and with the code."""

from __future__ import annotations

import re
import string
from pathlib import Path

import pytest

from trg_blender import lang
from trg_blender.lang import HOST
from trg_blender.lang.library.material_table import METALS, TEAPOTS
from trg_blender.lang.messages import HINTS, MESSAGES

FOLDER = Path(lang.__file__).parent


def _fields(text: str) -> set[str]:
    return {name for _, name, _, _ in string.Formatter().parse(text) if name}


@pytest.mark.parametrize("key", [*MESSAGES, *HINTS])
def test_both_languages_fill_in_the_same_values(key) -> None:
    english, russian = (MESSAGES | HINTS)[key]
    assert _fields(english) - {"article"} == _fields(russian)
    assert english and russian


def test_every_code_in_the_source_has_a_text_and_every_text_a_use() -> None:
    source = "".join(p.read_text(encoding="utf-8") for p in FOLDER.rglob("*.py") if p.name != "messages.py")
    used = set(re.findall(r'"([EWL]\d{3})"', source))
    assert used == set(MESSAGES)


def test_every_builtin_has_a_line_of_documentation() -> None:
    for row in [*HOST.functions.values(), *HOST.methods.values()]:
        assert row.doc.endswith("."), row.name


def test_the_teapot_table_is_complete() -> None:
    assert len(TEAPOTS) == 30
    assert set(METALS) < set(TEAPOTS)
    assert all(f"material::{name}" in HOST.functions for name in TEAPOTS)

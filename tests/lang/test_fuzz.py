"""Mutated programs: whatever the text, the end is a result or a diagnostic, never a Python error.

`tools/fuzz_language.py` runs as many as one likes; here a fixed row of 10 000, in four parts.
"""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
from fuzz_language import Mutator, fault_of  # noqa: E402

PROGRAMS = 2500


@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_mutated_programs_end_in_a_result_or_a_diagnostic(seed) -> None:
    mutator = Mutator(seed)
    for _ in range(PROGRAMS):
        text = mutator.make()
        assert fault_of(text) == "", text

"""The conformance programs of the shared data, one test each."""

from __future__ import annotations

import pytest

from .conformance import entries, failure_of


@pytest.mark.skipif(not entries(), reason="the shared conformance programs are not here")
@pytest.mark.parametrize("entry", entries(), ids=lambda e: e["name"])
def test_conformance(entry: dict) -> None:
    assert failure_of(entry) == ""

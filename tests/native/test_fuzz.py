"""Random calls of the native core: whatever they are, the end is a result within the contract or a refusal.

`tools/fuzz_native.py` makes as many as one likes, `tools/fuzz_native.sh` under sanitizers; here a fixed row.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
from fuzz_native import Fuzzer  # noqa: E402

CALLS = 4000


@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_random_calls_end_in_a_result_or_a_refusal(seed: int) -> None:
    fuzzer = Fuzzer(seed)
    with np.errstate(all="ignore"):
        for number in range(CALLS):
            fault = fuzzer.call()
            assert fault == "", f"call {number} of seed {seed}: {fault}"
    assert fuzzer.done["query"] > 100 and fuzzer.done["build"] > 100 and fuzzer.done["start_render"] > 0

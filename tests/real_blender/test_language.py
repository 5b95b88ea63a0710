"""The language on the Python that the distribution's Blender runs on: newer than that of any bpy wheel."""

from __future__ import annotations

import pytest

from .real_blender_tool import ROOT, RealBlender

LANGUAGE_TESTS = ROOT / "tests" / "lang"


def test_cases_pass(bare_blender: RealBlender) -> None:
    done = bare_blender.command("python3", "-m", "tests.lang.cases")
    assert done.status == 0, done.text
    count = len(list((LANGUAGE_TESTS / "cases").rglob("*.trg")))
    assert done.text.splitlines()[-1] == f"{count} passed, 0 failed"


def test_shared_conformance_programs_pass(bare_blender: RealBlender) -> None:
    if not (ROOT.parent / "shared" / "data" / "conformance").is_dir():
        pytest.skip("the shared conformance programs are not here")
    done = bare_blender.command("python3", "-m", "tests.lang.conformance")
    assert done.status == 0, done.text
    assert done.text.splitlines()[-1] == "116 passed, 0 failed"


def test_blender_runs_the_same_python(bare_blender: RealBlender) -> None:
    """Else the tests above would say nothing of the language inside Blender."""
    ask = "import sys; sys.stdout.write('PYTHON ' + sys.version.split()[0] + chr(10))"
    inside = bare_blender.run("-b", "--factory-startup", "--python-expr", ask)
    beside = bare_blender.command("python3", "-c", ask)
    assert beside.text.strip() in inside.text.splitlines()

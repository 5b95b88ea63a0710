"""A real Blender for the tests: found, given the packed extension, and run in a user directory of its own."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from .real_blender_tool import ROOT, RealBlender, installed_versions


@pytest.fixture(scope="session", params=installed_versions())
def bare_blender(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> RealBlender:
    """A real Blender with an empty user directory."""
    if request.param == "none":
        reason = "no real Blender: run tools/real_blender.sh install"
        pytest.fail(reason) if os.environ.get("CI") == "true" else pytest.skip(reason)
    return RealBlender(request.param, tmp_path_factory.mktemp("user"))


@pytest.fixture(scope="session")
def extension_zip() -> Path:
    """The packed extension of `make extension`."""
    found = sorted((ROOT / "dist").glob("trg-*.zip"), key=lambda path: path.stat().st_mtime)
    if not found:
        pytest.fail("no dist/trg-*.zip: run make extension")
    return found[-1]


@pytest.fixture(scope="session")
def blender(bare_blender: RealBlender, extension_zip: Path) -> Iterator[RealBlender]:
    """A real Blender with the extension installed and enabled, the way a user does it."""
    done = bare_blender.run(
        "--command", "extension", "install-file", "-r", "user_default", "--enable", extension_zip
    )
    assert done.status == 0, done.text
    yield bare_blender


@pytest.fixture(scope="session")
def first_blender(blender: RealBlender) -> RealBlender:
    """The wanted version only: 5.2, whose pixels are compared with the module of the same version."""
    if blender.version != "sid":
        pytest.skip("compared with Blender 5.2 only")
    return blender

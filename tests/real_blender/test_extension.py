"""The extension as Blender's own tools see it."""

from __future__ import annotations

from pathlib import Path

from .real_blender_tool import ROOT, RealBlender


def test_zip_is_valid(bare_blender: RealBlender, extension_zip: Path) -> None:
    done = bare_blender.run("--command", "extension", "validate", extension_zip)
    assert done.status == 0, done.text
    assert "error" not in done.text.lower()


def test_blender_packs_the_staged_sources_itself(bare_blender: RealBlender, tmp_path: Path) -> None:
    done = bare_blender.run(
        "--command",
        "extension",
        "build",
        "--source-dir",
        ROOT / "build" / "extension",
        "--output-dir",
        tmp_path,
    )
    assert done.status == 0, done.text
    assert [path.suffix for path in tmp_path.iterdir()] == [".zip"]


def test_installed_extension_is_listed(blender: RealBlender) -> None:
    done = blender.run("--command", "extension", "list")
    assert done.status == 0, done.text
    assert "trg" in done.text


def test_engine_is_offered(blender: RealBlender) -> None:
    done = blender.run("-b", "-E", "help")
    assert "TRG" in done.text.split()


def test_native_core_comes_from_the_bundled_wheel(blender: RealBlender) -> None:
    done = blender.run(
        "-b",
        "--python-exit-code",
        "9",
        "--python-expr",
        "import trg_native; print('NATIVE', trg_native.__file__)",
    )
    assert done.status == 0, done.text
    assert f"NATIVE {blender.user_directory}" in done.text

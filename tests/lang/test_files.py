"""The fence around a program's files."""

from __future__ import annotations

import pytest

from trg_blender.lang import DiskFiles, FileError
from trg_blender.lang.files import clean_name


@pytest.fixture
def project(tmp_path):
    folder = tmp_path / "project"
    (folder / "Bin" / "models").mkdir(parents=True)
    (folder / "Bin" / "models" / "Cow.g3dm").write_bytes(b"G3DM")
    (folder / "lib").mkdir()
    (folder / "lib" / "a.trg").write_text('include("b.trg");', encoding="utf-8")
    (folder / "lib" / "b.trg").write_text("b = 5;", encoding="utf-8")
    (tmp_path / "secret.trg").write_text("x = 1;", encoding="utf-8")
    return folder


OUTSIDE = [
    "../secret.trg", "..\\secret.trg", "a/../../secret.trg", "/etc/passwd", "\\\\host\\x", "C:\\x.trg",
    "c:x.trg", "http://x/y.trg", "file:x", "~/x.trg", "", ".", "a\0b", "con", "lib/NUL.trg", "x" * 600,
    "lib/a.trg:stream",
]  # fmt: skip


@pytest.mark.parametrize("name", OUTSIDE)
def test_no_name_leads_outside(name, project) -> None:
    with pytest.raises(FileError) as caught:
        DiskFiles(project).resolve_file(name, "main.trg")
    assert caught.value.code == "E510"


def test_a_link_that_leads_outside_is_refused(project) -> None:
    (project / "way.trg").symlink_to(project.parent / "secret.trg")
    (project / "door").symlink_to(project.parent)
    for name in ("way.trg", "door/secret.trg"):
        with pytest.raises(FileError) as caught:
            DiskFiles(project).resolve_include(name, "main.trg")
        assert caught.value.code == "E510"


def test_a_folder_or_device_is_no_file(project) -> None:
    assert DiskFiles(project).resolve_file("lib", "main.trg") is None


def test_backslashes_and_case_are_forgiven(project) -> None:
    found = DiskFiles(project).resolve_file("BIN\\MODELS\\cow.g3dm", "main.trg")
    assert found == project / "Bin" / "models" / "Cow.g3dm"
    assert clean_name("a\\.\\b/c") == ("a", "b", "c")


def test_includes_are_relative_to_the_including_text_first(project, run) -> None:
    outcome = run('include("lib/a.trg"); print(b);', resolver=DiskFiles(project))
    assert outcome.output == ["5"]


def test_a_second_include_does_nothing(project, run) -> None:
    (project / "p.trg").write_text("print(1);", encoding="utf-8")
    assert run('include("p.trg"); include("P.TRG");', resolver=DiskFiles(project)).output == ["1"]


def test_a_file_that_includes_itself_is_an_error_at_the_include(project, run) -> None:
    (project / "x.trg").write_text('include("y.trg");', encoding="utf-8")
    (project / "y.trg").write_text('include("x.trg");', encoding="utf-8")
    (found,) = run('include("x.trg");', resolver=DiskFiles(project)).diagnostics
    assert (found.code, found.span.file, found.span.col) == ("E320", "y.trg", 9)


def test_includes_nest_eight_deep_and_no_deeper(project, run) -> None:
    for n in range(10):
        (project / f"n{n}.trg").write_text(f'include("n{n + 1}.trg");', encoding="utf-8")
    assert run('include("n0.trg");', resolver=DiskFiles(project)).error[0] == "E322"


def test_allowed_folders_are_searched_after_the_project(project, tmp_path) -> None:
    other = tmp_path / "other"
    other.mkdir()
    (other / "t.g24").write_bytes(b"")
    assert DiskFiles(project).resolve_file("t.g24", "main.trg") is None
    assert DiskFiles(project, (other,)).resolve_file("t.g24", "main.trg") == other / "t.g24"


def test_the_library_is_found_from_anywhere_by_the_papers_name(project, run) -> None:
    text = 'include("stl\\\\rt\\\\trg_raytrace.trg"); print(stl::orbit(0, 2, 1));'
    assert run(text, resolver=DiskFiles(project)).output == ["vec3(2, 1, 0)"]
    assert run(text).output == ["vec3(2, 1, 0)"]


def test_a_file_that_is_no_text_is_an_error(project, run) -> None:
    (project / "bad.trg").write_bytes(b"\xff\xfe\x00")
    assert run('include("bad.trg");', resolver=DiskFiles(project)).error == ("E512", "1:9")

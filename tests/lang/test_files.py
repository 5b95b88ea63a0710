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


# Every fence, and somebody who tries to cross it.

CROSSINGS = {
    "absolute": "/etc/hostname",
    "absolute, doubled": "//etc/hostname",
    "parent": "../secret.trg",
    "parent, deep": "lib/../../secret.trg",
    "parent, backslash": "..\\secret.trg",
    "parent, mixed": "lib\\..//..\\secret.trg",
    "parent, of the library": "stl/../../secret.trg",
    "drive": "C:\\Windows\\win.ini",
    "drive, relative": "c:secret.trg",
    "UNC": "\\\\server\\share\\x.trg",
    "UNC, slashes": "//server/share/x.trg",
    "device path": "\\\\.\\PhysicalDrive0",
    "verbatim path": "\\\\?\\C:\\x.trg",
    "URL": "https://example.org/x.trg",
    "URL, file": "file:///etc/hostname",
    "URL, upper case": "FILE:/etc/hostname",
    "home": "~/x.trg",
    "home of another": "~root/x.trg",
    "null": "lib/a.trg\0.png",
    "line end": "lib/a\n.trg",
    "long": "x" * 5000,
    "many parts": "a/" * 3000 + "x",
    "reserved": "con",
    "reserved, upper case": "CON",
    "reserved, extension": "nul.trg",
    "reserved, deep": "lib/aux.txt/x",
    "reserved, number": "lib/com1",
    "reserved, printer": "LPT9.trg",
    "reserved, space": "con .trg",
    "reserved, trailing dot": "nul.",
    "reserved, console": "CONIN$",
    "reserved, superscript": "com\u00b9",
    "stream": "lib/a.trg:secret",
    "stream, data": "lib/a.trg::$DATA",
    "stream, folder": "lib:$I30:$INDEX_ALLOCATION/a.trg",
    "trailing dot": "lib/a.trg.",
    "trailing space": "lib/a.trg ",
    "parent, trailing space": ".. /secret.trg",
    "parent, three dots": ".../secret.trg",
    "empty": "",
    "dots": "./././",
}


@pytest.mark.parametrize("crossing", CROSSINGS)
def test_a_crossing_is_refused(crossing, project) -> None:
    files = DiskFiles(project, (project / "lib",))
    for look_up in (files.resolve_include, files.resolve_file):
        with pytest.raises(FileError) as caught:
            look_up(CROSSINGS[crossing], "lib/a.trg")
        assert caught.value.code == "E510"


@pytest.mark.parametrize(
    "from_file", ["../../main.trg", "/etc/main.trg", "..\\main.trg", "lib/../../main.trg"]
)
def test_the_name_of_the_text_leads_nowhere(from_file, project) -> None:
    files = DiskFiles(project)
    assert files.resolve_file("secret.trg", from_file) is None
    assert files.resolve_file("hostname", from_file) is None


def test_a_fifo_is_no_file(project) -> None:
    os = pytest.importorskip("os")
    if not hasattr(os, "mkfifo"):
        pytest.skip("this system has no FIFOs")
    os.mkfifo(project / "pipe.trg")
    assert DiskFiles(project).resolve_file("pipe.trg", "main.trg") is None
    with pytest.raises(FileError) as caught:
        DiskFiles(project).resolve_include("pipe.trg", "main.trg")
    assert caught.value.code == "E511"


def test_a_link_to_a_device_is_refused(project) -> None:
    (project / "zero.trg").symlink_to("/dev/zero")
    for look_up in (DiskFiles(project).resolve_include, DiskFiles(project).resolve_file):
        try:
            assert look_up("zero.trg", "main.trg") is None
        except FileError as error:
            assert error.code in ("E510", "E511")


def test_a_link_to_a_folder_outside_is_refused_in_any_case(project) -> None:
    (project / "Door").symlink_to(project.parent)
    for name in ("Door/secret.trg", "door/SECRET.trg", "DOOR\\secret.trg"):
        with pytest.raises(FileError) as caught:
            DiskFiles(project).resolve_file(name, "main.trg")
        assert caught.value.code == "E510"


def test_a_link_in_a_circle_is_no_file(project) -> None:
    (project / "round.trg").symlink_to(project / "round.trg")
    try:
        assert DiskFiles(project).resolve_file("round.trg", "main.trg") is None
    except FileError as error:
        assert error.code == "E510"


def test_a_huge_text_is_refused_by_its_size(project) -> None:
    with open(project / "huge.trg", "wb") as huge:
        huge.truncate(40 * 1024**3)  # a hole: it takes no room on the disk
    with pytest.raises(FileError) as caught:
        DiskFiles(project).resolve_include("huge.trg", "main.trg")
    assert caught.value.code == "E512"


def test_a_text_that_is_not_utf8_is_refused(project) -> None:
    (project / "binary.trg").write_bytes(b"\xff\xfe\x00x")
    with pytest.raises(FileError) as caught:
        DiskFiles(project).resolve_include("binary.trg", "main.trg")
    assert caught.value.code == "E512"

# ruff: noqa: E501 (programs on one line)
"""Every limit: its own error, which names the limit's value and where it is raised."""

from __future__ import annotations

import pytest

from trg_blender.lang import Limits, SourceFile
from trg_blender.lang.limits import (
    MAX_CALL_DEPTH,
    MAX_INCLUDE_DEPTH,
    MAX_INCLUDES,
    MAX_OPERATOR_DEPTH,
    MAX_SOURCE,
    change_limits,
)

RAISED = {
    "max_steps": ("E601", 5000, "5000", "for (;;) ;"),
    "max_seconds": ("E602", 0.05, "0.05", "for (;;) ;"),
    "max_bytes": (
        "E604", 5 * 1048576, "5",
        "h = 0; while (1) { o = object(); " + "".join(f"o.f{i} = 1;" for i in range(300)) + "o.n = h; h = o; }",
    ),
    "max_string": ("E605", 100, "100", 's = "ab"; for (;;) s = s + s;'),
    "max_text_bytes": (
        "E606", 2 * 1048576, "2",
        'h = 0; s = "ab"; for (i = 0; i < 12; i++) s = s + s; for (;;) { o = object(); o.s = s + i; o.n = h;'
        " h = o; i++; }",
    ),
    "max_shapes": ("E610", 77, "77", "for (;;) sphere(vec3(0), 1);"),
    "max_elements": ("E612", 88, "88", "l = []; for (;;) l.append(1);"),
    "max_blocks": ("E613", 50_000, "50000", "h = 0; while (1) { o = object(); o.n = h; h = o; }"),
}  # fmt: skip


@pytest.mark.parametrize("name", RAISED)
def test_a_limit_that_the_user_may_raise_says_so(name, run) -> None:
    code, value, shown, text = RAISED[name]
    found = run(text, limits=Limits(**{name: value})).diagnostics[-1]
    assert found.code == code
    assert shown in found.message
    assert f"--limit {name}=" in found.hint


@pytest.mark.parametrize(
    ("text", "code", "limit"),
    [
        ("f = function() { #f(); }; f();", "E607", MAX_CALL_DEPTH),
        ("a = object(); a.operator+ = function(x, y) { return x + y; }; a + 1;", "E608", MAX_OPERATOR_DEPTH),
        (";" * (MAX_SOURCE + 1), "E109", MAX_SOURCE),
    ],
)
def test_a_fixed_limit_says_so(text, code, limit, run) -> None:
    (found,) = run(text).diagnostics
    assert found.code == code
    assert str(limit) in found.message
    assert found.hint == "this limit is fixed"


def test_exactly_as_many_nested_calls_as_the_limit_allows(run) -> None:
    text = "f = function(n) { if (n < 2) return 1; return 1 + #f(n - 1); }; print(f(%d));"
    assert run(text % MAX_CALL_DEPTH).output == [str(MAX_CALL_DEPTH)]
    assert run(text % (MAX_CALL_DEPTH + 1)).error[0] == "E607"


class _Files:
    """A resolver whose files include the next: `a1`, `a2`, ... or all from one."""

    def __init__(self, texts: dict[str, str]) -> None:
        self.texts = texts

    def resolve_include(self, name: str, from_file: str) -> SourceFile:
        return SourceFile.from_text(name, self.texts[name])

    def resolve_file(self, name: str, from_file: str) -> None:
        return None


def test_includes_are_limited_in_depth_and_number(run) -> None:
    deep = {f"a{n}": f'include("a{n + 1}");' for n in range(20)}
    found = run('include("a0");', resolver=_Files(deep)).diagnostics[0]
    assert (found.code, str(MAX_INCLUDE_DEPTH) in found.message) == ("E322", True)
    many = {f"a{n}": "" for n in range(60)}
    found = run("".join(f'include("a{n}");' for n in range(60)), resolver=_Files(many)).diagnostics[0]
    assert (found.code, str(MAX_INCLUDES) in found.message) == ("E321", True)


def test_the_source_size_counts_includes(run) -> None:
    files = _Files({"a": ";" * (MAX_SOURCE // 2), "b": ";" * (MAX_SOURCE // 2)})
    assert run('include("a");', resolver=files).error is None
    assert run('include("a"); include("b");', resolver=files).error[0] == "E109"


def test_output_is_cut_by_frame_and_by_run(run) -> None:
    limits = Limits(output_lines_frame=5, output_lines=12, output_columns=10)
    text = (
        'S = scene(); for (k = 0; k < 9; k++) { for (i = 0; i < 9; i++) print("0123456789ab"); S.Render(); }'
    )
    output = run(text, limits=limits).output
    assert output[:6] == ["0123456789 ..."] * 5 + ["output cut"]
    assert len(output) <= 13 and output[-1] == "output cut"


def test_settings_change_limits() -> None:
    limits = change_limits(Limits(), ["max_steps=7", "max_seconds=0.5"])
    assert (limits.max_steps, limits.max_seconds) == (7, 0.5)
    for wrong in ("max_steps", "max_steps=", "steps=3", "max_steps=a", "max_steps=0", "max_seconds=nan"):
        with pytest.raises(ValueError, match="limit|number"):
            change_limits(Limits(), [wrong])

"""All errors of a file at once: what does not hang on the faulty statements is said too."""

from __future__ import annotations

import pytest

from trg_blender.lang import ProgramError, compile_source


def errors_of(text: str) -> list[tuple[str, str]]:
    with pytest.raises(ProgramError) as caught:
        compile_source(text, "main.trg")
    return [
        (d.code, f"{d.span.line}:{d.span.col}") for d in caught.value.diagnostics if d.severity == "error"
    ]


def test_errors_of_scanning_parsing_and_names_come_together_in_order():
    found = errors_of('a = "\\q";\nb = ;\nc = sphare(1);\nd = function() { return a; };')
    assert found == [("E105", "1:6"), ("E205", "2:5"), ("E302", "3:5"), ("E301", "4:25")]


@pytest.mark.parametrize(
    "text",
    [
        "a = ;\nb = a;",
        "f = function() { x = 1 +; return x; };",
        "my::x = (;\nb = my :: x;",
        "a.b = ;\nc = a;",
        "f = function(q) { return q + ; };\nf(1);",
        "i++ +;\ni = i;",
    ],
)
def test_a_name_that_a_faulty_statement_may_define_is_not_reported(text: str):
    assert [code for code, _ in errors_of(text)] == ["E205"]


def test_a_missing_file_may_define_every_name():
    assert errors_of('include("none.trg");\na = unknown;') == [("E511", "1:9")]


def test_at_most_twenty_errors():
    assert len(errors_of("a = ;\n" * 15 + "b = missing;\n" * 15)) == 20


def test_names_compare_after_normalisation():
    assert errors_of("й = ;\nb = й;") == [("E205", "1:5")]

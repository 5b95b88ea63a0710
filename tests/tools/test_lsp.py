"""The language server, driven over its pipes as an editor drives it."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from .lsp_client import ROOT, LspClient

pytest.importorskip("pygls", reason="pygls (the extra `lsp`) is not installed")

URI = "file:///nowhere/scene.trg"
PROGRAM = """\
Scene = scene();
// Puts a ball at a place.
Ball = function(place ~ "vec3", size = 1)
{
    body = sphere(place, size, material::gold());
    return #Scene.Add(body);
};
шар = "🎈🎈"; ball = Ball(vec3(0));
ball.note = "x";
"""


@pytest.fixture(scope="module")
def client() -> Iterator[LspClient]:
    client = LspClient()
    yield client
    assert client.close() == 0


def place_of(text: str, mark: str) -> tuple[int, int]:
    """Line and UTF-16 column just behind the first `mark`, from 0."""
    before = text[: text.index(mark) + len(mark)]
    return before.count("\n"), utf16(before.rpartition("\n")[2])


def utf16(text: str) -> int:
    return len(text.encode("utf-16-le")) // 2


def labels(client: LspClient, text: str, mark: str) -> dict[str, dict]:
    client.open(URI, text)
    found = client.at("completion", URI, *place_of(text, mark))
    return {item["label"]: item for item in found["items"]}


def hovered(client: LspClient, text: str, mark: str) -> str:
    client.open(URI, text)
    found = client.at("hover", URI, *place_of(text, mark))
    return "" if found is None else found["contents"]["value"]


def test_the_server_says_what_it_can(client: LspClient):
    able = client.capabilities
    for name in ("completion", "hover", "definition", "documentFormatting", "codeAction"):
        assert able[f"{name}Provider"], name
    assert able["positionEncoding"] == "utf-16"


def test_a_right_program_has_no_diagnostics(client: LspClient):
    assert client.open(URI, PROGRAM) == []


def test_diagnostics_come_when_a_document_is_opened(client: LspClient):
    (found,) = client.open(URI, "a = shpere(1);")
    assert found["code"] == "E302"
    assert found["severity"] == 1
    assert found["source"] == "trg"
    assert found["range"] == {"start": {"line": 0, "character": 4}, "end": {"line": 0, "character": 10}}


def test_columns_are_utf16_behind_cyrillic_and_emoji(client: LspClient):
    text = 'шар = "🎈🎈"; б = нет_такого;'
    (found,) = client.open(URI, text)
    start = utf16(text[: text.index("нет_такого")])
    assert start == 18
    assert found["range"]["start"]["character"] == start
    assert found["range"]["end"]["character"] == start + len("нет_такого")


def test_a_client_that_counts_characters_gets_characters():
    client = LspClient(offered=("utf-32",))
    (found,) = client.open(URI, 's = "🎈🎈"; b = none_such;')
    assert found["range"]["start"]["character"] == 14
    assert client.close() == 0


def test_diagnostics_follow_a_change_after_a_pause_and_only_the_last_counts(client: LspClient):
    client.open(URI, PROGRAM)
    last = client.change(URI, "a = ;", "a = 1 +", "b = none_such;")
    assert [d["code"] for d in client.diagnostics(URI)] == ["E302"]
    client.ask("textDocument/formatting", formatting())
    published = [m for m in client.notifications if m["method"] == "textDocument/publishDiagnostics"]
    assert published == []
    assert last == 4


def formatting() -> dict:
    return {"textDocument": {"uri": URI}, "options": {"tabSize": 4, "insertSpaces": True}}


def test_lints_are_informations_and_related_places_come_along(client: LspClient):
    found = client.open(URI, "r = 1;\nif (r = 2) r;\nf = function() { return r; };")
    assert [(d["code"], d["severity"]) for d in found] == [("L801", 3), ("E301", 1)]
    (related,) = found[1]["relatedInformation"]
    assert related["location"]["uri"] == URI
    assert related["location"]["range"]["start"] == {"line": 0, "character": 0}


def test_all_errors_come_at_once(client: LspClient):
    found = client.open(URI, "a = ;\nb = none_such;\nc = 1")
    assert [d["code"] for d in found] == ["E205", "E302", "E201"]


def test_completion_of_built_ins_variables_and_keywords(client: LspClient):
    found = labels(client, PROGRAM, "шар = ")
    assert found["sphere"]["detail"].startswith("sphere(centre: vec3")
    assert found["sphere"]["documentation"]
    assert {"Scene", "Ball", "шар", "while", "material", "vec3"} <= set(found)
    assert "body" not in found


def test_completion_in_a_function_offers_its_variables_and_not_the_globals(client: LspClient):
    found = labels(client, PROGRAM, "body = ")
    assert {"place", "size", "body", "sphere"} <= set(found)
    assert not {"Scene", "Ball", "шар"} & set(found)


def test_completion_after_a_hash_offers_the_globals(client: LspClient):
    found = labels(client, PROGRAM, "return #")
    assert {"Scene", "Ball", "шар"} <= set(found)
    assert "place" not in found


def test_completion_after_two_colons_offers_the_space(client: LspClient):
    found = labels(client, PROGRAM, "material::")
    assert {"gold", "glass"} <= set(found)
    assert "sphere" not in found
    own = labels(client, "my::size = 1;\na = my::;", "a = my::")
    assert list(own) == ["size"]


def test_completion_after_a_dot_offers_the_methods_of_the_type(client: LspClient):
    found = labels(client, "Scene = scene();\nScene.\n", "Scene.")
    assert {"Add", "Render", "CamSet"} <= set(found)
    assert "SetTexture" not in found
    in_function = labels(client, PROGRAM, "#Scene.")
    assert "Add" in in_function


def test_completion_after_a_call_and_of_vectors_and_fields(client: LspClient):
    assert "SetTexture" in labels(client, "material::gold().;", "gold().")
    assert set(labels(client, "v = vec3(1);\nv.;", "v.")) == {"x", "y", "z"}
    assert "note" in labels(client, "o = object();\no.note = 1;\no.;", ";\no.")


def test_completion_keeps_quiet_in_strings_comments_and_numbers(client: LspClient):
    assert labels(client, 'a = "sph";', '"sph') == {}
    assert labels(client, "// sph\na = 1;", "// sph") == {}
    assert labels(client, "/* sph */ a = 1;", "/* sph") == {}
    assert labels(client, "a = 12;", "12") == {}


def test_hover_shows_signature_and_documentation(client: LspClient):
    text = hovered(client, PROGRAM, "sphe")
    assert "sphere(centre: vec3" in text
    assert "-> shape" in text
    assert "Scene.Add(" in hovered(client, PROGRAM, "#Scene.Ad")


def test_hover_on_names_of_the_program(client: LspClient):
    shown = hovered(client, PROGRAM, "ball = Bal")
    assert 'Ball(place ~ "vec3", size = ...)' in shown
    assert "Puts a ball at a place." in shown
    assert "place: vec3" in hovered(client, PROGRAM, "sphere(pla")
    exported = '/* How big. */\nexport size = 3 ~ "num" ~ range(0, 10);\na = size;'
    assert "size: num" in hovered(client, exported, "a = siz")
    assert "How big." in hovered(client, exported, "a = siz")
    assert "repeats" in hovered(client, "while (1) { break; }", "whi")
    assert hovered(client, "a = 1 + 2;", "1 +") == ""


def test_hover_range_is_utf16(client: LspClient):
    text = 's = "🎈"; t = sphere(vec3(0), 1);'
    client.open(URI, text)
    found = client.at("hover", URI, 0, utf16(text[: text.index("sphere") + 2]))
    assert found["range"]["start"]["character"] == utf16(text[: text.index("sphere")])


@pytest.mark.parametrize(
    ("mark", "line", "character"),
    [("ball = Bal", 2, 0), ("sphere(plac", 2, 16), ("#Scene", 0, 0), ("Add(bod", 4, 4), ("ball.note", 8, 0)],
)
def test_definition(client: LspClient, mark: str, line: int, character: int):
    client.open(URI, PROGRAM)
    found = client.at("definition", URI, *place_of(PROGRAM, mark))
    assert found["uri"] == URI
    assert found["range"]["start"] == {"line": line, "character": character}


def test_definition_of_an_include_and_of_what_it_defines(client: LspClient, tmp_path: Path):
    (tmp_path / "part.trg").write_text("// first\nsize = 2;\n", encoding="utf-8")
    main = tmp_path / "main.trg"
    text = 'include("part.trg");\na = size;\n'
    main.write_text(text, encoding="utf-8")
    uri, part = main.as_uri(), (tmp_path / "part.trg").as_uri()
    assert client.open(uri, text) == []
    found = client.at("definition", uri, *place_of(text, "part"))
    assert (found["uri"], found["range"]["start"]["line"]) == (part, 0)
    found = client.at("definition", uri, *place_of(text, "siz"))
    assert (found["uri"], found["range"]["start"]["line"]) == (part, 1)


def test_definition_of_a_built_in_is_nowhere(client: LspClient):
    client.open(URI, PROGRAM)
    assert client.at("definition", URI, *place_of(PROGRAM, "sphe")) is None


def test_formatting_replaces_the_whole_text(client: LspClient):
    client.open(URI, 'a=1;\nшар="🎈";')
    (edit,) = client.ask("textDocument/formatting", formatting())
    assert edit["newText"] == 'a = 1;\nшар = "🎈";\n'
    assert edit["range"]["start"] == {"line": 0, "character": 0}
    assert edit["range"]["end"]["line"] == 2


def test_formatting_leaves_right_and_faulty_texts_alone(client: LspClient):
    for text in ("a = 1;\n", "a = ;"):
        client.open(URI, text)
        assert client.ask("textDocument/formatting", formatting()) == []


def test_a_certain_fix_is_a_code_action(client: LspClient):
    text = 'шар = "🎈"; b = "\\M";'
    (found,) = client.open(URI, text)
    params = {
        "textDocument": {"uri": URI},
        "range": found["range"],
        "context": {"diagnostics": [found]},
    }
    (action,) = client.ask("textDocument/codeAction", params)
    (edit,) = action["edit"]["changes"][URI]
    start, end = (edit["range"][side]["character"] for side in ("start", "end"))
    units = text.encode("utf-16-le")
    fixed = units[: 2 * start] + edit["newText"].encode("utf-16-le") + units[2 * end :]
    assert fixed.decode("utf-16-le") == 'шар = "🎈"; b = "\\\\M";'
    assert action["kind"] == "quickfix"


def test_closing_a_document_takes_its_diagnostics_away(client: LspClient):
    client.open(URI, "a = ;")
    client.tell("textDocument/didClose", {"textDocument": {"uri": URI}})
    assert client.diagnostics(URI) == []


def test_messages_in_russian():
    client = LspClient("--lang", "ru")
    (found,) = client.open(URI, "a = ;")
    assert "выражение" in found["message"]
    assert client.close() == 0


def test_without_pygls_the_command_says_what_is_missing():
    block = (
        "import sys; sys.modules['pygls'] = None; from trg_blender.cli import main; sys.exit(main(['lsp']))"
    )
    done = subprocess.run(
        [sys.executable, "-c", block], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 4
    assert "pip install" in done.stderr
    assert "Traceback" not in done.stderr

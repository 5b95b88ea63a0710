"""Mutated programs: whatever the text, the end is a result or a diagnostic, never a Python error."""

from __future__ import annotations

import random
import re

import pytest

from trg_blender.lang import (
    HOST,
    FrameEvent,
    HostOptions,
    Limits,
    ProgramError,
    Session,
    compile_source,
)  # fmt: skip

SEEDS = [
    'Scene = scene(); t = texture("a.g24", 2); m = material::gold(); m.SetTexture(t, 1);'
    "for (i = 0; i < 3; i++) { Scene.Add(sphere(vec3(i, 0, 0), 1, m)); if (i % 2) continue;"
    " Scene.Render(); }",
    "f = function(a = 1 ~ \"num\", b) { switch (a) { case 1: return b + 1; default: break; } return -b; };"
    " print(f(1, 2), f(2, vec3(1)), typeof(f));",
    "a = object(); a.n = 1; a.operator+ = function(x, y) { return x.n + y; }; a.get = function(self, k)"
    " { return self.n * k; }; print(a + 1, a.get(2), a == a, !a); a.n++; a.n += 2; x = (a.n = 3) + i++;",
    "n = 0; f = function(k) { #n += k; while (k > 0) { k--; if (k == 2) break; } return #n; };"
    ' s = "a" + f(3) + 0.5; if (s < "b" && n != 2 || !n) print(s, mth::sin(n)); else print(len(s));',
]  # fmt: skip
WORDS = re.compile(r'\w+|"[^"\n]*"|\s+|.')
KEYWORDS = set("if else while for switch case default break continue return function operator".split())
PROGRAMS = 2500


def _kind(word: str) -> str:
    if word[0].isdigit():
        return "number"
    if word[0].isalpha():
        return "keyword" if word in KEYWORDS else "name"
    return "operator" if word in "+-*/%<>" else word


def _mutate(rng: random.Random, pool: list[str]) -> str:
    words = WORDS.findall(rng.choice(SEEDS))
    gentle = rng.random() < 0.75
    for _ in range(rng.randint(1, 4)):
        at = rng.randrange(len(words))
        if gentle:
            alike = [w for w in pool if _kind(w) == _kind(words[at])]
            words[at] = rng.choice(alike or [words[at]])
        elif rng.random() < 0.4:
            del words[at]
        else:
            words.insert(at, rng.choice(pool))
    return "".join(words)


@pytest.mark.parametrize("seed", [1, 2])
def test_mutated_programs_end_in_a_result_or_a_diagnostic(seed) -> None:
    rng = random.Random(seed)
    pool = [word for text in SEEDS for word in WORDS.findall(text)]
    pool += [*HOST.functions, *HOST.constants, *(name for _, name in HOST.methods), "__class__", "1e308"]
    options = HostOptions(limits=Limits(max_steps=2000))
    ran = 0
    for _ in range(PROGRAMS):
        text = _mutate(rng, pool)
        try:
            session = Session(compile_source(text, "m.trg"), options)
        except ProgramError as error:
            assert error.diagnostics, text
            continue
        frames = 0
        while frames < 3 and isinstance(session.next_frame(), FrameEvent):
            frames += 1
        ran += 1
        assert all(d.code != "E900" for d in session.diagnostics), text
    assert ran > PROGRAMS // 10

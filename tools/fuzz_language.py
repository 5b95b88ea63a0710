"""Runs mutated programs and reports every one that ends in an internal error.

    python tools/fuzz_language.py [COUNT] [SEED]

Mutations exchange, delete, double and insert words of little programs that use all of the language, of
the project's conformance programs, and of the names of all built-ins. Each mutant is compiled and run
for up to three frames with a small budget: it must end in a result or in a diagnostic. Ends with
status 1 on a finding, after printing the text that repeats it.
"""

from __future__ import annotations

import argparse
import random
import re
import sys
import time
import traceback
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
from trg_blender import lang  # noqa: E402

WORDS = re.compile(r'\w+|"[^"\n]*"|\s+|.')
KEYWORDS = set("if else while for in switch case default break continue return function operator".split())
SEEDS = (
    'Scene = scene(); t = texture("a.g24", 2); m = material::gold(); m.SetTexture(t, 1);'
    "for (i = 0; i < 3; i++) { Scene.Add(sphere(vec3(i, 0, 0), 1, m)); if (i % 2) continue;"
    " Scene.Render(); }",
    "f = function(a = 1 ~ \"num\", b) { switch (a) { case 1: return b + 1; default: break; } return -b; };"
    " print(f(1, 2), f(2, vec3(1)), typeof(f));",
    "a = object(); a.n = 1; a.operator+ = function(x, y) { return x.n + y; }; a.get = function(self, k)"
    " { return self.n * k; }; print(a + 1, a.get(2), a == a, !a); a.n++; a.n += 2; x = (a.n = 3) + i++;",
    "n = 0; f = function(k) { #n += k; while (k > 0) { k--; if (k == 2) break; } return #n; };"
    ' s = "a" + f(3) + 0.5; if (s < "b" && n != 2 || !n) print(s, mth::sin(n)); else print(len(s));',
    "l = [1, 2, [3]]; l.append(4); l[0] = l[1]++; for (x in l) { print(x); if (x == 2) continue; l.pop(); }"
    " print(len(l), l[0] + l[len(l) - 1], copy(l));",
    "g = function(s) { s.Render(); for (x in [1, 2]) { s.Render(); } return x; }; S = scene(); h = g; h(S);"
    " p = S; p.Render(); b.operator== = function(x, y) { return 1; }; print(b == S, b != 1);",
)  # fmt: skip


def kind_of(word: str) -> str:
    """Words of one kind may stand for each other in a gentle mutation."""
    if word[0].isdigit():
        return "number"
    if word[0].isalpha():
        return "keyword" if word in KEYWORDS else "name"
    return "operator" if word in "+-*/%<>" else word


class Mutator:
    """Makes programs out of others; the same seed makes the same row."""

    def __init__(self, seed: int, more: tuple[str, ...] = ()) -> None:
        self.rng = random.Random(seed)
        self.programs = [WORDS.findall(text) for text in (*SEEDS, *more)]
        host = lang.HOST
        self.pool = [word for words in self.programs for word in words]
        self.pool += [*host.functions, *host.constants, *(name for _, name in host.methods)]
        self.pool += ["__class__", "1e308", "0", '""', "self", "#", "[", "]"]
        self.alike: dict[str, list[str]] = {}
        for word in self.pool:
            self.alike.setdefault(kind_of(word), []).append(word)

    def make(self) -> str:
        """The next mutant."""
        rng = self.rng
        words = list(rng.choice(self.programs))
        gentle = rng.random() < 0.75
        for _ in range(rng.randint(1, 4)):
            at = rng.randrange(len(words))
            if gentle:
                words[at] = rng.choice(self.alike.get(kind_of(words[at]), [words[at]]))
            elif rng.random() < 0.4 and len(words) > 1:
                del words[at]
            elif rng.random() < 0.3:
                end = at + rng.randint(1, 12)
                words[at:at] = words[at:end]
            else:
                words.insert(at, rng.choice(self.pool))
        return "".join(words)


def fault_of(text: str) -> str:
    """What went wrong inside TRG with this program; empty when nothing did."""
    options = lang.HostOptions(limits=lang.Limits(max_steps=2000))
    try:
        session = lang.Session(lang.compile_source(text, "m.trg"), options)
        for _ in range(3):
            if not isinstance(session.next_frame(), lang.FrameEvent):
                break
    except lang.ProgramError as error:
        return "" if error.diagnostics else "an error without a diagnostic"
    except Exception:  # noqa: BLE001 - whatever gets out is the finding
        return traceback.format_exc()
    internal = [d for d in session.diagnostics if d.code == "E900"]
    return f"{internal[0].span}: {internal[0].message}" if internal else ""


def conformance_texts() -> tuple[str, ...]:
    """The project's own conformance programs, short ones, as further seeds."""
    texts = [p.read_text(encoding="utf-8") for p in sorted((ROOT / "tests/lang/cases").rglob("*.trg"))]
    return tuple(text for text in texts if 0 < len(text) < 2000)


def main() -> int:
    """Status 0 when every mutant ended as it should."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("count", nargs="?", type=int, default=200_000)
    parser.add_argument("seed", nargs="?", type=int, default=1)
    arguments = parser.parse_args()
    mutator, start, found = Mutator(arguments.seed, conformance_texts()), time.monotonic(), 0
    for _ in range(arguments.count):
        text = mutator.make()
        fault = fault_of(text)
        if fault:
            found += 1
            print(f"--- {fault}\n{text}")
    seconds = time.monotonic() - start
    print(f"{arguments.count} programs, seed {arguments.seed}: {found} internal errors, {seconds:.0f} s")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

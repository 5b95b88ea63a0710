"""CPU seconds of TRG beside POV-Ray, OpenSCAD, Lua and CPython on five little programs.

    python benchmarks/language.py [--rounds 5] [--json FILE]

Every program runs in a process of its own, peers and TRG taking turns within a round, so that a machine
that slows down slows all. Reported are CPU seconds (user and system): the median over the rounds, the
lowest and the highest. TRG and CPython tell their own, from the start of compiling and of running; of
the others it is the process's less that of the same tool on an empty program. TRG runs with its budget
on; Lua 5.4 with a count hook every 1 000 instructions, which is how a host bounds it; CPython runs the
program at module level, as a script does. Peers that are not installed are named as absent (Debian
packages povray, openscad, lua5.4); a peer that cannot express a program has no figure.

Programs: `loop` 10^7 turns of a nested loop of two statements; `fib` recursive fib(27); `objects` a linked
list of 10^5 objects with two fields; `append` 30 000 appends to a string; `list` the same to a
list (POV-Ray: an array of known length); `shapes` 10^5 spheres made and
added to the scene (TRG alone has a scene; its figure is without Render()).
"""

from __future__ import annotations

import argparse
import json
import platform
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

TRG = {
    "empty": "",
    "loop": "s = 0; for (i = 0; i < 10000; i++) { for (j = 0; j < 1000; j++) { s = s + j; } }",
    "fib": "fib = function(n) { if (n < 2) return n; return #fib(n - 1) + #fib(n - 2); }; fib(27);",
    "objects": "h = 0; for (i = 0; i < 100000; i++) { o = object(); o.n = h; o.v = i; h = o; }",
    "append": 's = ""; for (i = 0; i < 30000; i++) s = s + "x";',
    "list": "l = []; for (i = 0; i < 30000; i++) l.append(i);",
    "shapes": "S = scene(); m = material::gold();"
    "for (i = 0; i < 100000; i++) S.Add(sphere(vec3(i, 0, 0), 1, m));",
}
PYTHON = {
    "empty": "",
    "loop": "s = 0.0\ni = 0.0\nwhile i < 10000:\n    j = 0.0\n    while j < 1000:\n"
    "        s = s + j\n        j += 1\n    i += 1\n",
    "fib": "def fib(n):\n    if n < 2:\n        return n\n    return fib(n - 1) + fib(n - 2)\nfib(27.0)\n",
    "objects": "class O:\n    pass\nh = 0\ni = 0.0\nwhile i < 100000:\n    o = O()\n    o.n = h\n"
    "    o.v = i\n    h = o\n    i += 1\n",
    "append": "s = ''\ni = 0.0\nwhile i < 30000:\n    s = s + 'x'\n    i += 1\n",
    "list": "l = []\ni = 0.0\nwhile i < 30000:\n    l.append(i)\n    i += 1\n",
}
_HOOK = "debug.sethook(function() end, '', 1000)\n"
LUA = {
    "empty": _HOOK,
    "loop": _HOOK + "s = 0.0; i = 0.0; while i < 10000 do j = 0.0; while j < 1000 do "
    "s = s + j; j = j + 1 end; i = i + 1 end",
    "fib": _HOOK + "function fib(n) if n < 2 then return n end return fib(n - 1) + fib(n - 2) end fib(27.0)",
    "objects": _HOOK + "h = 0; i = 0.0; while i < 100000 do o = {}; o.n = h; o.v = i; h = o; i = i + 1 end",
    "append": _HOOK + "s = ''; i = 0.0; while i < 30000 do s = s .. 'x'; i = i + 1 end",
    "list": _HOOK + "l = {}; i = 0.0; while i < 30000 do l[#l + 1] = i; i = i + 1 end",
}
_SCENE = "sphere { 0, 1 }\n"
POVRAY = {
    "empty": _SCENE,
    "loop": "#declare s = 0; #declare i = 0; #while (i < 10000) #declare j = 0; #while (j < 1000) "
    "#declare s = s + j; #declare j = j + 1; #end #declare i = i + 1; #end\n" + _SCENE,
    "fib": "#macro fib(n) #if (n < 2) #local r = n; #else #local r = fib(n - 1) + fib(n - 2); #end r #end\n"
    "#declare x0 = fib(27);\n" + _SCENE,
    "list": "#declare l = array[30000]; #declare i = 0; #while (i < 30000) #declare l[i] = i; "
    "#declare i = i + 1; #end\n" + _SCENE,
    "append": '#declare s = ""; #declare i = 0; #while (i < 30000) #declare s = concat(s, "x"); '
    "#declare i = i + 1; #end\n" + _SCENE,
}
OPENSCAD = {
    "empty": "cube(1);",
    "loop": "function inner(j, s) = j < 1000 ? inner(j + 1, s + j) : s;\n"
    "function outer(i, s) = i < 10000 ? outer(i + 1, inner(0, s)) : s;\necho(outer(0, 0));\ncube(1);",
    "fib": "function fib(n) = n < 2 ? n : fib(n - 1) + fib(n - 2);\necho(fib(27));\ncube(1);",
    "append": 'function more(i, s) = i < 30000 ? more(i + 1, str(s, "x")) : s;\n'
    'echo(len(more(0, "")));\ncube(1);',
}
_RUN_TRG = """
import sys, time
sys.path.insert(0, sys.argv[1])
from trg_blender.lang import Session, compile_source
start = time.process_time()
end = Session(compile_source(open(sys.argv[2]).read(), "main.trg")).next_frame()
assert end.error is None, end.error
print(time.process_time() - start)
"""
_RUN_PYTHON = """
import sys, time
code = compile(open(sys.argv[1]).read(), "main.py", "exec")
scope = {"__name__": "__main__"}
start = time.process_time()
exec(code, scope)
print(time.process_time() - start)
"""


@dataclass(frozen=True, slots=True)
class Peer:
    """A tool and its programs. `command` gets the path of the program's file behind it."""

    name: str
    command: tuple[str, ...]
    programs: dict[str, str]
    suffix: str
    reports: bool = False
    """It prints the CPU seconds of the program itself: the start of its process is not counted."""


@dataclass(frozen=True, slots=True)
class Timing:
    """CPU seconds of one tool on one program."""

    program: str
    peer: str
    median_s: float
    lowest_s: float
    highest_s: float


def find_peers(folder: Path) -> tuple[list[Peer], list[str]]:
    """The tools of this machine, and the names of those that are absent."""
    runner = folder / "run_trg.py"
    runner.write_text(_RUN_TRG, encoding="utf-8")
    python = folder / "run_python.py"
    python.write_text(_RUN_PYTHON, encoding="utf-8")
    version = platform.python_version()
    peers = [
        Peer(f"TRG ({version})", (sys.executable, str(runner), str(ROOT)), TRG, ".trg", True),
        Peer(f"CPython {version}", (sys.executable, str(python)), PYTHON, ".py", True),
    ]
    absent = []
    for tool, arguments, programs, suffix in (
        ("lua5.4", (), LUA, ".lua"),
        ("povray", ("+W1", "+H1", "-D", "-F", "+WT1"), POVRAY, ".pov"),
        ("openscad", ("-o", str(folder / "out.csg")), OPENSCAD, ".scad"),
    ):
        if shutil.which(tool) is None:
            absent.append(tool)
        else:
            peers.append(Peer(tool, (tool, *arguments), programs, suffix))
    return peers, absent


def cpu_seconds(peer: Peer, program: str, folder: Path) -> float:
    """CPU seconds of one process; RuntimeError when the tool refuses the program."""
    path = folder / (program + peer.suffix)
    path.write_text(peer.programs[program], encoding="utf-8")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([*peer.command, str(path)], capture_output=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        message = done.stderr.decode("utf-8", "replace")[-400:]
        raise RuntimeError(f"{peer.name} failed on {program}: {message}")
    if peer.reports:
        return float(done.stdout)
    return (after.ru_utime - before.ru_utime) + (after.ru_stime - before.ru_stime)


def measure(peers: list[Peer], rounds: int, folder: Path) -> list[Timing]:
    """Times every program of every peer, round by round."""
    times: dict[tuple[str, str], list[float]] = {}
    for round_index in range(rounds):
        order = peers if round_index % 2 == 0 else list(reversed(peers))
        for program in TRG:
            for peer in order:
                if program in peer.programs:
                    seconds = cpu_seconds(peer, program, folder)
                    times.setdefault((program, peer.name), []).append(seconds)
    timings = []
    for (program, name), found in times.items():
        if program != "empty":
            base = statistics.median(times["empty", name])
            values = [max(0.0, seconds - base) for seconds in found]
            timings.append(Timing(program, name, statistics.median(values), min(values), max(values)))
    return timings


def show(timings: list[Timing]) -> None:
    """A line for each program and tool, with the ratio to TRG."""
    own = {t.program: t.median_s for t in timings if t.peer.startswith("TRG")}
    print(f"{'program':<10}{'tool':<18}{'median s':>10}{'lowest':>9}{'highest':>9}{'x TRG':>8}")
    for t in sorted(timings, key=lambda t: (list(own).index(t.program), t.median_s)):
        ratio = t.median_s / own[t.program] if own[t.program] else float("nan")
        print(
            f"{t.program:<10}{t.peer:<18}{t.median_s:>10.3f}{t.lowest_s:>9.3f}{t.highest_s:>9.3f}{ratio:>8.1f}"
        )


def main() -> int:
    """Measures, prints the table, and writes JSON when asked."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        peers, absent = find_peers(folder)
        timings = measure(peers, arguments.rounds, folder)
    show(timings)
    for tool in absent:
        print(f"absent: {tool}")
    if arguments.json:
        arguments.json.write_text(json.dumps([asdict(t) for t in timings], indent=1), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())

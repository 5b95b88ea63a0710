"""`trg repl`: reads statements, runs each at once, and shows the values of expressions."""

from __future__ import annotations

import argparse
import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType

from .. import __version__
from ..lang import DiskFiles, HostOptions, Limits, render_diagnostic
from ..lang.interactive import LAST_VALUE, Interactive, Outcome, is_complete
from .language import add_language, chosen_language
from .run import DONE, WRONG, positive

PROMPT, CONTINUED = "trg> ", "...> "
HELP = f"""\
Statements run at once; variables stay. An expression shows its value, which is {LAST_VALUE} then.
An entry goes on over lines while a bracket is open; an empty line ends it.
:help    this text
:names   the variables so far
:quit    the end (or Ctrl-D); Ctrl-C stops what is running
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add `repl` to the command line."""
    parser = subparsers.add_parser(
        "repl", help="TRG line by line", description="Runs what is typed at once, without tracing."
    )
    parser.add_argument(
        "--frames", type=positive, default=1, metavar="N", help="frames of an entry before it is stopped (1)"
    )
    parser.add_argument(
        "--max-steps", type=positive, default=Limits().max_steps, metavar="N",
        help="steps allowed for one entry (%(default)s)",
    )  # fmt: skip
    add_language(parser)


def run(args: argparse.Namespace) -> int:
    """Reads to the end of the input. Exit code 1 when that was no terminal and an entry failed."""
    language = chosen_language(args.lang)
    options = HostOptions(limits=Limits(max_steps=args.max_steps), frames=args.frames, language=language)
    session = Interactive(DiskFiles(Path.cwd()), options)
    typed = sys.stdin.isatty()
    if typed:
        sys.stdout.write(f"TRG {__version__}. :help says more, :quit ends.\n")
    failed = False
    with _history(typed), _cancelled_by_interrupt(session):
        for entry in _entries(typed):
            if entry.startswith(":"):
                if not _command(entry, session):
                    break
                continue
            outcome = session.enter(entry)
            _show(outcome, session)
            failed = failed or outcome.failed
    return WRONG if failed and not typed else DONE


def _entries(typed: bool) -> Iterator[str]:
    """The entries of the input, each whole; what is not whole at its end or an empty line as it is."""
    lines: list[str] = []
    while True:
        line = _read_line(CONTINUED if lines else PROMPT, typed)
        if line is None:
            break
        if not lines and (not line.strip() or line.startswith(":")):
            if line.strip():
                yield line.strip()
            continue
        lines.append(line)
        whole, entry = is_complete("\n".join(lines))
        if whole or not line.strip():
            yield entry
            lines = []
    if lines:
        yield "\n".join(lines)


def _read_line(prompt: str, typed: bool) -> str | None:
    """The next line without its end; None at the end of the input."""
    if not typed:
        line = sys.stdin.readline()
        return line.rstrip("\r\n") if line else None
    try:
        return input(prompt)
    except EOFError:
        sys.stdout.write("\n")
        return None
    except KeyboardInterrupt:
        sys.stdout.write("\n")
        return ""


def _command(entry: str, session: Interactive) -> bool:
    """Obey a line that begins with a colon; whether to go on."""
    match entry.split()[0]:
        case ":quit" | ":q" | ":exit":
            return False
        case ":help":
            sys.stdout.write(HELP)
        case ":names":
            sys.stdout.write(" ".join(session.global_names) + "\n")
        case unknown:
            sys.stdout.write(f"there is no {unknown}; :help lists what there is\n")
    return True


def _show(outcome: Outcome, session: Interactive) -> None:
    sys.stdout.writelines(line + "\n" for line in outcome.output)
    if outcome.value is not None:
        sys.stdout.write(outcome.value + "\n")
    sys.stdout.flush()
    shown = [render_diagnostic(d, session.sources) + "\n" for d in outcome.diagnostics]
    sys.stderr.writelines(shown)
    sys.stderr.flush()


@contextmanager
def _cancelled_by_interrupt(session: Interactive) -> Iterator[None]:
    """While the program runs, Ctrl-C ends the entry and not the session; at the prompt it ends the line."""

    def interrupted(_number: int, frame: FrameType | None) -> None:
        while frame is not None:
            if frame.f_code is Interactive.enter.__code__:
                session.cancel()
                return
            frame = frame.f_back
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGINT, interrupted)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


@contextmanager
def _history(typed: bool) -> Iterator[None]:
    """Line editing with the history of earlier sessions, where Python has readline."""
    try:
        import readline
    except ImportError:
        typed = False
    if not typed:
        yield
        return
    file = Path(os.environ.get("TRG_HISTORY", Path.home() / ".trg_history"))
    try:
        readline.read_history_file(file)
    except OSError:
        readline.clear_history()
    try:
        yield
    finally:
        readline.set_history_length(1000)
        try:
            readline.write_history_file(file)
        except OSError as error:
            sys.stderr.write(f"trg: the history is not kept: {error}\n")

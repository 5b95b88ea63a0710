"""Includes run one way, and what kernels are made of knows no containers, exceptions or doubles."""

from __future__ import annotations

import re

import pytest

from .tree import ROOT, native_files, read, report, without_comments

KERNEL_ROOMS = ("native/shade/", "native/kernel/")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')
FORBIDDEN_IN_KERNELS = {
    r"\bdouble\b": "double",
    r"\bstd::(vector|string|string_view|map|set|unordered_\w+|deque|list|optional|variant|function|"
    r"unique_ptr|shared_ptr|mutex|thread)\b": "a container or owner of std::",
    r"\b(throw|try|catch)\b": "an exception",
    r"\b(new|delete|malloc|free)\b\s*[\w(\[]": "an allocation",
}


def ladder() -> list[str]:
    """Rooms of native/ from the lowest up, as docs/architecture.md orders them."""
    (written,) = re.findall(r"`(base <- [\w <-]+)`", read("docs/architecture.md"))
    return written.split(" <- ")


def room_of(name: str) -> str:
    """`native/geom/ray.h` -> geom; empty for a file of native/ itself and for tests."""
    parts = name.split("/")
    return parts[1] if len(parts) > 2 else ""


def kernel_headers() -> list[str]:
    return [name for name in native_files(".h") if name.startswith(KERNEL_ROOMS)]


def test_the_architecture_orders_the_rooms():
    assert ladder() == ["base", "geom", "accel", "shade", "kernel", "scene", "cpu", "py"]


def test_every_native_source_lies_in_a_room():
    known = {*ladder(), "tests", "bench"}
    violations = [name for name in native_files() if room_of(name) not in known]
    assert not violations, report(violations)


def test_no_native_room_includes_one_above_it():
    order = {room: height for height, room in enumerate(ladder())}
    violations = []
    for name in native_files():
        height = order.get(room_of(name))
        for number, line in enumerate(read(name).splitlines(), 1):
            found = INCLUDE.match(line)
            if height is None or found is None:
                continue
            above = order.get(found[1].split("/")[0])
            if above is None or above > height:
                violations.append(f"{name}:{number}: includes {found[1]}")
    assert not violations, report(violations)


def test_every_header_is_included_once():
    violations = [name for name in native_files(".h") if "#pragma once" not in read(name)]
    # A header that is compiled anew for each instruction set says so in its first line instead.
    violations = [name for name in violations if "included once per" not in read(name).split("\n", 1)[0]]
    assert not violations, report(violations)


def test_kernel_headers_know_no_containers_exceptions_allocations_or_doubles():
    violations = []
    for name in kernel_headers():
        for number, line in enumerate(without_comments(read(name)).splitlines(), 1):
            violations += [
                f"{name}:{number}: {what}"
                for pattern, what in FORBIDDEN_IN_KERNELS.items()
                if re.search(pattern, line)
            ]
    assert not violations, report(violations)


def test_every_function_of_a_kernel_header_keeps_its_own_copy():
    lizard = pytest.importorskip("lizard", reason="lizard (requirements/lint.txt) lists the functions")
    violations = []
    for name in kernel_headers():
        lines = read(name).splitlines()
        for function in lizard.analyze_file(str(ROOT / name)).function_list:
            head = " ".join(lines[max(0, function.start_line - 2) : function.start_line])
            if not re.search(r"\bTRG_([A-Z]+_)?FN\b", head) and "= default" not in head:
                violations.append(f"{name}:{function.start_line}: {function.name} is not TRG_FN")
    assert not violations, report(violations)

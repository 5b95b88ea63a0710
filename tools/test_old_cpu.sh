#!/bin/sh
# Runs ray queries and a small render on processors that this machine only pretends to be: one without
# AVX (the baseline set) and one with AVX2 but no AVX-512. An illegal instruction ends the run.
# Usage: tools/test_old_cpu.sh PYTHON   (trg_native and numpy importable)
# Needs qemu-x86_64 (Debian: qemu-user); QEMU may name it. Subnormal numbers are kept everywhere: the
# native core never sets FTZ or DAZ, and the last check would see it.
set -eu
[ $# -eq 1 ] || { echo "usage: $0 PYTHON" >&2; exit 2; }
root=$(cd "$(dirname "$0")/.." && pwd)
qemu=${QEMU:-qemu-x86_64}
command -v "$qemu" >/dev/null || { echo "$0: $qemu is not here" >&2; exit 3; }
python=$("$1" -c "import os, sys; print(os.path.realpath(sys.executable))")
paths=$("$1" -c "import sys; print(':'.join(p for p in sys.path if p))")
for case in Nehalem:baseline Haswell:avx2; do
    PYTHONPATH="$root:$paths" "$qemu" -cpu "${case%%:*}" "$python" -m tests.native.old_cpu "${case##*:}"
done

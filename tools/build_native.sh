#!/bin/sh
# Builds the native core incrementally and puts it into the given Python environments.
# Usage: tools/build_native.sh PYTHON...
# The first PYTHON gives the headers (3.11 or newer); the one binary is copied next to the packages
# of every PYTHON. BUILD_DIR, CMAKE_ARGS and JOBS may be set.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=${BUILD_DIR:-$root/build/native}
[ $# -ge 1 ] || { echo "usage: $0 PYTHON..." >&2; exit 2; }
cmake -S "$root/native" -B "$build" -G Ninja -DPython_EXECUTABLE="$1" ${CMAKE_ARGS:-} >/dev/null
cmake --build "$build" --parallel "${JOBS:-2}"
for python in "$@"; do
    site=$("$python" -c "import sysconfig; print(sysconfig.get_path('platlib'))")
    # Renaming keeps a process that has the old file mapped alive.
    cp "$build/trg_native.abi3.so" "$site/.trg_native.new"
    mv "$site/.trg_native.new" "$site/trg_native.abi3.so"
done

#!/bin/sh
# Runs tools/fuzz_native.py on sanitized builds of the native core: addresses and undefined behaviour on one
# thread, then races with three threads on the same scenes. A sanitizer's report ends the run.
# Usage: tools/fuzz_native.sh PYTHON [CALLS] [SEED]   (numpy importable; gcc, CMake and ninja on PATH)
# The builds go to build/address and build/thread.
set -eu
[ $# -ge 1 ] || { echo "usage: $0 PYTHON [CALLS] [SEED]" >&2; exit 2; }
root=$(cd "$(dirname "$0")/.." && pwd)
python=$1
calls=${2:-1000000}
seed=${3:-1}

build() {
    cmake -S "$root/native" -B "$root/build/$1" -G Ninja -DTRG_SANITIZE="$1" -DPython_EXECUTABLE="$python" >/dev/null
    cmake --build "$root/build/$1" --parallel 2
}

# Python itself is not sanitized: the runtime comes first by LD_PRELOAD, and what Python keeps is no leak.
# Nothing is suppressed: the preloaded runtime sees the mutex of Python's global lock, so a race reported in
# Py_INCREF is a reference counted without that lock.
fuzz() {
    env PYTHONPATH="$root:$root/build/$1" PYTHONMALLOC=malloc OPENBLAS_NUM_THREADS=1 \
        LD_PRELOAD="$(gcc -print-file-name="lib$2.so") $(gcc -print-file-name=libstdc++.so)" \
        ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 UBSAN_OPTIONS=print_stacktrace=1 \
        TSAN_OPTIONS=halt_on_error=1:exitcode=66 \
        "$python" "$root/tools/fuzz_native.py" "$3" "$seed" --threads "$4"
}

build address
fuzz address asan "$calls" 1
build thread
fuzz thread tsan "$((calls / 10))" 3

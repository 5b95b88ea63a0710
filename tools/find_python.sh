#!/usr/bin/env bash
# Prints the path of a working Python of a version: tools/find_python.sh 3.13
# Looks on PATH, in pyenv's and in uv's versions; with TRG_FETCH_PYTHON=1 uv may also download it.
# Exit 1, with nothing printed, when there is none. A shim that does not run does not count.
set -u
version=${1:?usage: find_python.sh VERSION}

works() {
    [ -n "$1" ] && "$1" -c "
import sys, venv, ensurepip
sys.exit('%d.%d' % sys.version_info[:2] != '$version')" >/dev/null 2>&1
}

accept() {
    works "$1" || return 1
    "$1" -c 'import sys; print(sys.executable)'
    exit 0
}

find_uv() {
    command -v uv && return
    [ "${TRG_FETCH_PYTHON:-0}" = 1 ] || return 1
    local home="${TRG_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/trg}/uv"
    [ -x "$home/bin/uv" ] || { python3 -m venv "$home" && "$home/bin/pip" install -q uv; } >&2 || return 1
    echo "$home/bin/uv"
}

for name in "python$version" python3 python; do
    path=$(command -v "$name") && accept "$path"
done
for path in "${PYENV_ROOT:-$HOME/.pyenv}/versions/$version"*/bin/python; do
    accept "$path"
done
if uv=$(find_uv); then
    accept "$("$uv" python find "$version" 2>/dev/null)"
    if [ "${TRG_FETCH_PYTHON:-0}" = 1 ]; then
        "$uv" python install "$version" >&2 && accept "$("$uv" python find "$version" 2>/dev/null)"
    fi
fi
exit 1

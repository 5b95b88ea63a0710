#!/usr/bin/env bash
# Runs one step of the set-up: tools/step.sh "what is done" COMMAND...
# Prints the step and its time; its output goes to build/log/ and is shown only when it fails.
set -u
label=$1
shift
mkdir -p build/log
log=build/log/$(echo "$label" | tr -cs 'A-Za-z0-9.' '-' | sed 's/-$//').log
start=$(date +%s.%N)
"$@" >"$log" 2>&1 </dev/null
status=$?
seconds=$(awk -v a="$start" -v b="$(date +%s.%N)" 'BEGIN { printf "%.1f", b - a }')
if [ "$status" != 0 ]; then
    tail -n 40 "$log" >&2
    printf '%s: failed (exit %s) after %s s; whole log: %s\n' "$label" "$status" "$seconds" "$log" >&2
    exit "$status"
fi
printf '%-50s %8s s\n' "$label" "$seconds"

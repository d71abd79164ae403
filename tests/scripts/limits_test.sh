#!/usr/bin/env bash
# What a run will need is known before it begins: memory, numbers beyond all sense, and what is left of a failed run.
# Usage: SOURCE BINARY
set -uo pipefail
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$2/limits_test
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
failures=0
fail() { echo "FAILED: $1"; failures=$((failures + 1)); }

# expect CODE WORDS ARGUMENTS
expect() {
  local code=$1 words=$2
  shift 2
  "$pelage" "$@" >log 2>&1 </dev/null
  local was=$?
  [ $was = "$code" ] || { fail "$*: exit code $was instead of $code"; tail -1 log; }
  [ -z "$words" ] || grep -q -- "$words" log || { fail "$*: no \"$words\" in the message"; tail -1 log; }
}

# --- memory ---------------------------------------------------------------------------------------------------------
small=(grow 'builtin:sphere?n=642' --size .1 -q)
fine=(grow 'builtin:sphere?n=642' -q -o coat.ply)
expect 4 'needs about .* of memory, but it may take 300 MB in all; a pattern .* times as wide' "${fine[@]}" --size .005 --max-memory 300MB
expect 4 'needs about .* of memory, but it may take 1.5 GB in all' "${fine[@]}" --size .003 --method loop --max-memory 1.5GB
expect 4 'needs about .* of memory' "${fine[@]}" --size 1e-9
expect 4 'a coat of .* triangles needs about .* of memory' "${small[@]}" -o coat.ply --detail 6 --max-memory 400MB
expect 0 '' "${small[@]}" -o coat.ply --max-memory 1GB
expect 2 'max-memory' "${small[@]}" -o coat.ply --max-memory 12
expect 2 'max-memory' "${small[@]}" -o coat.ply --max-memory much
[ "$(ls -A | grep -vx 'log\|coat.ply' | tr -d '\n')" = "" ] || fail "refused runs left files: $(ls -A)"

# Whatever a shell allows: done, or exit code 4 with a figure. Less than 60 MB does not load the program's libraries.
for kilobytes in 100000 130000 160000 200000 240000 280000 320000 400000 500000 640000 800000 1000000; do
  (ulimit -v $kilobytes && exec "$pelage" grow 'builtin:sphere?n=642' --size .008 -q -o limited.glb --picture limited.png) >log 2>&1
  was=$?
  [ $was = 0 ] && continue
  [ $was = 4 ] || { fail "ulimit -v $kilobytes: exit code $was"; tail -1 log; }
  grep -q '[0-9] [kMG]B' log || { fail "ulimit -v $kilobytes: no figure"; tail -1 log; }
done

# The forecast against what the system counted.
foreseen() {
  python3 - "$pelage" "$@" <<'PY' || fail "the forecast of $*"
import json, os, resource, subprocess, sys
run = subprocess.run([sys.argv[1], "grow", *sys.argv[2:], "--json", "-q", "--steps", "2", "-o", "foreseen.ply"],
                     stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True)
seen = json.loads(run.stdout)
used = 1024 * resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss - 30e6  # the program itself
nodes = seen["estimated_nodes"] / seen["control_vertices"]
bytes = seen["estimated_bytes"] / used
print(f"{' '.join(sys.argv[2:])}: nodes {nodes:.2f}, bytes {bytes:.2f} of the true ones")
sys.exit(0 if 0.85 < nodes < 1.2 and 0.5 < bytes < 1.8 else 1)
PY
}
foreseen builtin:animal --size .02 --keep-shape
foreseen builtin:animal --size .03 --model gray-scott --keep-shape
foreseen builtin:animal --size .025 --method loop --stepper sbdf2 --keep-shape
foreseen builtin:animal --size .02 --method linear --keep-shape
foreseen 'builtin:tile?n=600x600' --size .02
foreseen 'builtin:sphere?n=642' --method cells --cells 100000 --size .02 --keep-shape
foreseen 'builtin:box?n=60x60x60' --size .2

# --- numbers beyond all sense ---------------------------------------------------------------------------------------
expect 2 'far longer than all of the growth' "${small[@]}" -o no.ply --step 1e300
expect 2 'million million steps' "${small[@]}" -o no.ply --step 1e-300
expect 2 'million million steps' "${small[@]}" -o no.ply --until 1e300
expect 2 'at most 1' grow 'builtin:sphere?n=642' -q -o no.ply --size 1e300

# --- the last good state --------------------------------------------------------------------------------------------
blown=("${small[@]}" --stepper explicit --step 14)
expect 4 'halve the step.*; the state before is kept: --resume blown.ply.checkpoint --until' "${blown[@]}" -o blown.ply
[ -e blown.ply ] && fail "a failed run left an output"
again=$(sed -n 's/.*is kept: \(.*\) shows it/\1/p' log)
# shellcheck disable=SC2086  # two options
expect 0 '' "${blown[@]}" $again -o state.ply
[ -e state.ply ] || fail "the last good state is not shown"

[ $failures = 0 ] && echo "limits: all right"
exit $((failures > 0))

#!/usr/bin/env bash
# pelage unwrap as people use it: the file's own faces come back with texture coordinates, and what is refused.
# Usage: SOURCE BINARY
set -uo pipefail
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$2/unwrap_test
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
failures=0
fail() { echo "FAILED: $1"; failures=$((failures + 1)); }

# refused CODE WORDS ARGUMENTS: with that exit code and these words in the message, and without a file.
refused() {
  local code=$1 words=$2
  shift 2
  "$pelage" "$@" -o refused.obj >log 2>&1 </dev/null
  local was=$?
  [ $was = "$code" ] || fail "pelage $*: exit code $was instead of $code"
  grep -q -- "$words" log || { fail "pelage $*: no \"$words\" in the message"; tail -1 log; }
  [ ! -e refused.obj ] || fail "pelage $*: refused.obj was written"
}

# A house of quads and triangles, with a group, in an order of its own.
cat >house.obj <<'OBJ'
v 0 0 0
v 2 0 0
v 2 0 3
v 0 0 3
v 0 2 0
v 2 2 0
v 2 2 3
v 0 2 3
v 1 3 0
v 1 3 3
f 1 2 3 4
g walls
f 2 1 5 9 6
f 4 3 7 10 8
f 3 2 6 7
f 1 4 8 5
g roof
f 6 9 10 7
f 9 5 8 10
OBJ
"$pelage" unwrap house.obj -o uv.obj,uv.glb,uv.ply,uv.vtp --picture charts.png --json >json 2>log || fail "the house"
for file in uv.obj uv.glb uv.ply uv.vtp charts.png; do [ -s $file ] || fail "no $file"; done
python3 - <<'PY' || fail "the house does not come back with its faces"
import json
def faces(path):
    return [[c.split("/")[0] for c in l.split()[1:]] for l in open(path) if l.startswith("f ")]
def points(path):
    return [list(map(float, l.split()[1:4])) for l in open(path) if l.startswith("v ")]
assert faces("house.obj") == faces("uv.obj") and points("house.obj") == points("uv.obj")
assert all(l.count("/") >= 1 for l in open("uv.obj") if l.startswith("f "))
assert [l for l in open("uv.obj") if l.startswith("g ")] == ["g walls\n", "g roof\n"]
d = json.load(open("json"))
assert d["charts"] >= 1 and abs(d["stretch"] - 1) < 1e-3 and d["efficiency"] > 0.4, d
PY

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n' >pages.obj
"$pelage" unwrap pages.obj -o pages_uv.obj >log 2>&1 || fail "three pages at one spine"
grep -q 'charts take the polygons as they are' log || fail "three pages at one spine are not noted"

refused 3 'no-such.obj' unwrap no-such.obj
refused 2 'the output house.obj is an input' unwrap house.obj -o house.obj
refused 2 'not a whole number from 16' unwrap house.obj --resolution 3
refused 2 'not a number of at least 0' unwrap house.obj --margin -1
refused 2 'do not fit the atlas' unwrap house.obj --resolution 64 --margin 60
refused 2 'charts.jpg' unwrap house.obj --picture charts.jpg
refused 3 'rows of nodes' unwrap builtin:tile?n=32
: >empty.obj
refused 3 'empty.obj' unwrap empty.obj

"$pelage" unwrap 'builtin:animal?n=200000' -o late.obj >log 2>&1 &
pid=$!
sleep 1
kill -INT $pid
wait $pid
[ $? = 130 ] || fail "interrupted: exit code $?"
[ ! -e late.obj ] || fail "interrupted: late.obj was written"

[ $failures -eq 0 ] || { echo "$failures failures"; exit 1; }

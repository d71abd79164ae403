#!/usr/bin/env bash
# Cells and clouds of points as people give them, and what is refused before any work.
# Usage: SOURCE BINARY
set -uo pipefail
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$2/cells_test
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
failures=0
fail() { echo "FAILED: $1"; failures=$((failures + 1)); }

# makes FILES ARGUMENTS: it does, and all of these files have something in them.
makes() {
  local files=$1
  shift
  "$pelage" "$@" >log 2>&1 </dev/null || { fail "pelage $*"; tail -2 log; return; }
  local file
  for file in $files; do
    [ -s "$file" ] || fail "pelage $*: no $file"
  done
}
# refused CODE WORDS ARGUMENTS: with that exit code, these words in the message, and no growth.
refused() {
  local code=$1 words=$2
  shift 2
  "$pelage" "$@" >log 2>&1 </dev/null
  local was=$?
  [ $was = "$code" ] || fail "pelage $*: exit code $was instead of $code"
  grep -q -- "$words" log || { fail "pelage $*: no \"$words\" in the message"; tail -1 log; }
  ! grep -q '^growth' log || fail "pelage $*: refused after the growth"
}

makes 'cells.ply cells.png' cells builtin:animal -n 400 -o cells.ply --picture cells.png --picture-size 64
makes coat.glb grow 'builtin:sphere?n=642' --cells 800 --size 0.2 --steps 5 -o coat.glb
makes kept.obj grow 'builtin:cube?n=600' --method turk-cells --size 0.2 --steps 5 --keep-shape -o kept.obj
makes rosettes.ply grow 'builtin:sphere?n=642' --recipe leopard --method cells --size 0.2 --steps 5 -o rosettes.ply
makes sphere.obj fair 'builtin:sphere?n=2562' --steps 0 -o sphere.obj
points() { grep '^v ' sphere.obj | head -"$1"; }
cloud() {
  printf 'ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\nend_header\n' "$1"
  points "$1" | cut -d ' ' -f 2-4
}
cloud 2562 >scan.ply
points 2562 >lost.obj
makes 'cloud.ply cloud.png' grow scan.ply --size 0.2 --steps 5 -o cloud.ply --picture cloud.png --picture-size 64
makes again.ply grow cloud.ply --size 0.2 --steps 5 --keep-shape -o again.ply
cat >fins.obj <<'END'
v 0 0 0
v 0 1 0
v 1 0 0
v 1 1 0
v 0 0 1
v 0 1 1
v -1 0 -1
v -1 1 -1
f 1 3 4 2
f 1 5 6 2
f 1 7 8 2
f 2 8 7 1
END
refused 3 'edge' grow fins.obj --size 0.2 -o a.ply
makes fins.ply grow fins.obj --method cells --size 0.2 --steps 5 -o fins.ply
makes kept-fins.obj grow fins.obj --method cells --size 0.2 --steps 5 --keep-shape -o kept-fins.obj
makes fins.png cells fins.obj -n 500 --picture fins.png --picture-size 64
makes points.ply cells cloud.ply -n 300 -o points.ply
[ "$(grep -ac 'element face 0' cloud.ply)" = 1 ] || fail "the cloud came back with faces"

refused 2 'take .ply' grow scan.ply -o coat.glb
refused 3 'no faces' check scan.ply
refused 3 'no faces' fair scan.ply -o fair.ply
refused 2 'take "cells"' grow scan.ply --method loop -o a.ply
refused 2 'has no cells' grow 'builtin:sphere?n=642' --method loop --cells 500 -o a.ply
refused 2 'stay where they are' grow 'builtin:sphere?n=642' --method cells --fair -o a.ply
refused 2 'for polygons and clouds' cells 'builtin:tile?n=32' -o a.ply
refused 2 'is for other shapes' grow 'builtin:tile?n=32' --method cells -o a.png
cloud 20 >few.ply
refused 3 'no faces' grow few.ply -o a.ply
refused 3 'read from PLY' grow lost.obj -o a.ply

[ $failures = 0 ] && echo "cells: all as it should be"
exit $((failures > 0))

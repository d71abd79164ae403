#!/usr/bin/env bash
# pelage grow --frames as people use it: the last frame is the coat, later runs go on, and what is refused.
# Usage: SOURCE BINARY
set -uo pipefail
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$2/frames_test
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
failures=0
fail() { echo "FAILED: $1"; failures=$((failures + 1)); }
coat() { "$pelage" grow builtin:sphere?n=162 --size 0.2 --picture-size 64 -q --no-record "$@"; }

# refused WORDS ARGUMENTS: exit code 2, these words, and no file.
refused() {
  local words=$1
  shift
  mkdir -p refused
  (cd refused && coat "$@" >../log 2>&1 </dev/null)
  local was=$?
  [ $was = 2 ] || fail "grow $*: exit code $was instead of 2"
  grep -q -- "$words" log || { fail "grow $*: no \"$words\" in the message"; tail -1 log; }
  rmdir refused || fail "grow $*: something was written"
}

coat -o end.vtp --picture end.png || fail "an ordinary run"
coat -o walk.vtp,walk.glb --picture walk.png --frames 5 || fail "a sequence"
[ "$(ls walk.*.png | wc -l)" = 5 ] || fail "not five pictures: $(ls)"
cmp -s walk.0005.png end.png || fail "the last frame is not the picture of the coat"
cmp -s walk.0005.vtp end.vtp || fail "the last frame is not the coat"
cmp -s walk.0001.png walk.0005.png && fail "the first frame shows what the last one does"
[ "$(grep -c '<DataSet' walk.pvd)" = 5 ] || fail "not five times in the index"
grep -q 'file="walk.0003.vtp"' walk.pvd || fail "the index does not name the third frame"
grep -qa '"name":"growth"' walk.glb || fail "no animation in the GLB"

mkdir again
(cd again && coat --picture walk.png --frames 5 --from-frame 4) || fail "going on"
[ "$(echo again/*)" = "again/walk.0004.png again/walk.0005.png" ] || fail "going on wrote $(echo again/*)"
for k in 4 5; do cmp -s "again/walk.000$k.png" "walk.000$k.png" || fail "frame $k differs when the sequence goes on"; done

refused 'gives no `period`' --frames 4 --loop --picture x.png
refused 'leave --bake' --frames 4 --keep-shape -o x.vtp
refused 'say of how many --frames' --picture x.mp4
refused 'made as a whole' --frames 4 --from-frame 2 -o x.glb
if (PATH=/nonexistent && coat --frames 4 --picture x.mp4) 2>log; then fail "a video without ffmpeg"; fi
grep -q 'needs the program ffmpeg' log || { fail "no word of ffmpeg"; cat log; }

echo "$failures failures"
[ "$failures" -eq 0 ]

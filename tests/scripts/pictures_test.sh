#!/usr/bin/env bash
# Where pictures are taken from, in every command that draws; and that what a coat is like is seen. Usage: SOURCE BINARY
set -uo pipefail
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$2/pictures_test
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
failures=0
fail() { echo "FAILED: $1"; failures=$((failures + 1)); }

draws() {
  "$pelage" "$@" >log 2>&1 </dev/null || { fail "pelage $*"; tail -2 log; }
}
# same A B, differ A B: pictures.
same() { cmp -s "$1" "$2" || fail "$1 and $2 differ"; }
differ() { [ -s "$1" ] && [ -s "$2" ] && ! cmp -s "$1" "$2" || fail "$1 and $2 are the same"; }
refused() {
  local words=$1
  shift
  "$pelage" "$@" >log 2>&1 </dev/null && fail "pelage $*: not refused"
  grep -q -- "$words" log || { fail "pelage $*: no \"$words\" in the message"; tail -1 log; }
}

small=(--picture-size 64)
ball=(grow 'builtin:animal?n=800' --model turing --size 0.2 --steps 5 --detail 0 "${small[@]}")
draws "${ball[@]}" --picture plain.png
draws "${ball[@]}" --picture quarter.png --view three-quarter
draws "${ball[@]}" --picture side.png --view side
draws "${ball[@]}" --picture turned.png --azimuth 180 --elevation 8  # the cub looks to +x
draws "${ball[@]}" --picture higher.png --view side --elevation 50
draws "${ball[@]}" --picture z.png --view front --up z
draws "${ball[@]}" --picture bright.png --exposure 1
draws "${ball[@]}" --picture paper.png --background '#203040'
same plain.png quarter.png
same side.png turned.png
for other in side higher z bright paper; do differ plain.png "$other.png"; done
differ side.png higher.png

field=(field 'builtin:animal?n=800' "${small[@]}")
cells=(cells builtin:animal -n 200 "${small[@]}")
draws "${field[@]}" --picture field.png
draws "${field[@]}" --picture field-top.png --view top
draws "${cells[@]}" --picture cells.png
draws "${cells[@]}" --picture cells-top.png --view top
differ field.png field-top.png
differ cells.png cells-top.png
draws gallery -o usual turing --shape 'builtin:sphere?n=162' --size 0.5 "${small[@]}"
draws gallery -o above turing --shape 'builtin:sphere?n=162' --size 0.5 "${small[@]}" --view top
differ usual/turing-sphere.png above/turing-sphere.png
refused 'unknown view "above"' "${ball[@]}" --picture a.png --view above
refused 'did you mean "y"\|unknown axis "x"' "${ball[@]}" --picture a.png --up x
refused 'elevation must lie between' "${ball[@]}" --picture a.png --elevation 90
refused '--background' "${ball[@]}" --picture a.png --background grey

for material in roughness=0.2 metalness=1 opacity=0.5 emission=1 transmission=1 'height=0.1*b'; do
  draws "${ball[@]}" --picture material.png --material "$material"
  differ plain.png material.png
done
draws "${ball[@]}" --material 'height=0.1*b' -o flat.ply --picture flat.png
draws "${ball[@]}" --material 'height=0.1*b' --displace -o raised.ply --picture raised.png
differ flat.png raised.png
grep -qa material_height flat.ply || fail "flat.ply has no heights"
! grep -qa material_height raised.ply || fail "raised.ply has heights twice"
refused 'needs a height' "${ball[@]}" --displace -o a.ply
refused 'stay where they are' grow 'builtin:tile?n=16' --model turing --size 8px --material height=b --displace -o a.ply

[ $failures -eq 0 ] && echo "all right"
exit $((failures > 0))

#!/usr/bin/env bash
# Commands on grids as people give them: every kind of grid into every kind of file, and what is refused, before any work.
# Usage: SOURCE BINARY
set -uo pipefail
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$2/grid_commands_test
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
failures=0
fail() { echo "FAILED: $1"; failures=$((failures + 1)); }

# grows ARGUMENTS: it does, and every file that is named has something in it.
grows() {
  "$pelage" "$@" >log 2>&1 </dev/null || { fail "pelage $*"; tail -2 log; return; }
  local file
  for file in $(tr ' ,' '\n\n' <<<"$*" | grep -E '^[a-z0-9]+\.(png|exr|vti|vts|glb|ply)$'); do
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

grows grow 'builtin:tile?n=48' --recipe weave --size 12px --steps 5 -o t.png,t.exr,t.vti,t.glb --picture p.png --preview 3x3
grows grow t.png --model turing --size 9px --steps 5 --param-map 's=0.05+0.02*attribute(color)' -o image.vti
grows grow t.vti --model turing --size 9px --steps 5 -o again.vti
grows grow 'builtin:sheet?n=40x30' --model turing --size 9px --steps 5 --method masks -o masks.png
grows grow 'builtin:line?n=60' --model turing --unit 1px --steps 20 --plot line.png --picture strip.png
grows grow 'builtin:box?n=16' --model turing --size 8px --steps 20 -o block.vti,spots.ply --picture planes.png
grows grid horseshoe --nodes 41x13 -o shoe.vts --picture lines.png
grows grow shoe.vts --model turing --size 0.08 --steps 5 -o coat.vts,coat.ply
grows grow builtin:cube-sphere --recipe leopard --size 0.1 --steps 5 -o sphere.glb --picture sphere.png --picture-size 64
grows grow 'builtin:tile?n=64' --model witkin-kass-stripes --size 12px --stepper binary -o bits.png

refused 2 'unknown built-in shape "tiles"' grow builtin:tiles -o a.png
refused 2 'did you mean "vase"' grow builtin:vsae -o a.glb
refused 2 '3 nodes along a periodic axis' grow 'builtin:tile?n=2' -o a.png
refused 2 'too much memory' grow 'builtin:tile?n=99999' -o a.png
refused 2 'are files of grids' grow 'builtin:sphere?n=642' -o a.png
refused 2 'px are cells of a grid' grow 'builtin:sphere?n=642' --size 9px -o a.glb
refused 2 'is for surfaces' grow 'builtin:tile?n=48' --method loop -o a.png
refused 2 'is for even grids' grow 'builtin:sphere?n=642' --stepper etd -o a.glb
refused 2 'diffusion that is the same everywhere' grow 'builtin:tile?n=48' --recipe zebra --stepper gaussian -o a.png
refused 2 'these nodes stay where they are' grow 'builtin:tile?n=48' --fair -o a.png
refused 2 'coloured at its own nodes' grow 'builtin:tile?n=48' --detail 2 -o a.png
refused 2 'a line does in the course of time' grow 'builtin:tile?n=48' --plot a.png
refused 2 'a grid for the shape' grow 'builtin:sphere?n=642' --preview 3x3 --picture a.png

patch() { printf '[[patch]]\nname = "%s"\nnodes = [5, %s]\n[patch.formula]\nx = "%s"\ny = "v"\nz = "0"\n' "$1" "$2" "$3"; }
{ patch a 5 u; patch b 7 1+u; } >patches.toml
refused 3 'a.east and b.west run along each other but do not match: 5 and 7' grow patches.toml -o a.glb
{ patch a 5 u; patch b 5 'log(u - 2)'; } >patches.toml
refused 2 'patches.toml:.*not finite at u' grow patches.toml -o a.glb
printf 'outline = { points = [[0, 0], [1, 1], [1, 0], [0, 1]] }\n' >region.toml
refused 2 'region.toml:' grow region.toml -o a.vts
[ $failures = 0 ] && echo "all right" || exit 1

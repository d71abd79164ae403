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
  "$pelage" "$@" --no-record >log 2>&1 </dev/null || { fail "pelage $*"; tail -2 log; return; }
  local file
  for file in $(tr ' ,' '\n\n' <<<"$*" | grep -E '^[a-z0-9]+\.(png|exr|vti|vts|vtu|raw|glb|ply|stl)$'); do
    [ -s "$file" ] || fail "pelage $*: no $file"
  done
}
# closed FILE: the surface has no border.
closed() { "$pelage" check "$1" | grep -q 'the shape is closed' || fail "$1 is not closed"; }
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
grows grow 'builtin:tile?n=40x32' --model turing --size 9px --steps 20 --height-map relief.png
# A PNG of 40 x 32 pixels of 16-bit grey.
[ "$(od -An -tx1 -j16 -N10 relief.png | tr -d ' \n')" = 00000028000000201000 ] || fail "relief.png is no grey of 16 bits"
grows grow 'builtin:tile?n=40x32' --model turing --size 9px --steps 20 --height-map high.png --material 'height=0.1*b'
grep -q 'high.png .*black is [0-9.]* and white' log || fail "nothing is said of what black and white are in high.png"
cmp -s relief.png high.png || fail "a height that is the shown species makes another relief"
grows grow 'builtin:tile?n=40x32' --model turing --size 9px --steps 20 --height-map slope.png --material 'height=0.1*x'
! cmp -s relief.png slope.png || fail "the relief is not the height that was asked for"
grows grow t.png --model turing --size 9px --steps 5 --param-map 's=0.05+0.02*attribute(color)' -o image.vti
grows grow t.vti --model turing --size 9px --steps 5 -o again.vti
grows grow 'builtin:sheet?n=40x30' --model turing --size 9px --steps 5 --method masks -o masks.png
grows grow 'builtin:line?n=60' --model turing --unit 1px --steps 20 --plot line.png --picture strip.png
grows grow 'builtin:box?n=16' --model turing --size 8px --steps 20 -o block.vti,texels.raw,skin.ply --picture block.png
grows grow 'builtin:box?n=16' --model turing --size 8px --steps 20 --cut 'x>0.4 and y>0.5' --cut 'z=0.8' -o carved.ply
closed carved.ply
grows grow block.vti --model turing --size 8px --steps 20 --isosurface b --cut 'y>0.8' -o solid.stl
closed solid.stl
# The surface that is filled comes back as it was, in the colours of the volume.
grows grow 'builtin:sphere?n=642' --solid --model turing --size 0.3 --steps 5 --keep-shape -o kept.ply,volume.vtu
"$pelage" check kept.ply | grep -q 'edges  *1920$' || fail "--solid --keep-shape keeps no shape"
grows grow 'builtin:sphere?n=642' --solid --model turing --size 0.3 --steps 5 --cut 'x>0 and y>0' -o quarter.stl
closed quarter.stl
grows grid horseshoe --nodes 41x13 -o shoe.vts --picture lines.png
grows grow shoe.vts --model turing --size 0.08 --steps 5 -o coat.vts,coat.ply
grows grow builtin:cube-sphere --recipe leopard --size 0.1 --steps 5 -o sphere.glb --picture sphere.png --picture-size 64
grows grow 'builtin:tile?n=64' --model witkin-kass-stripes --size 12px --stepper binary -o bits.png
# On a coarser grid first, which makes another coat of the same kind; a checkpoint of it goes on without.
grows grow 'builtin:tile?n=64' --model schnakenberg --size 16px -o plain.png
grows grow 'builtin:tile?n=64' --model schnakenberg --size 16px --nested --steps 5 --checkpoint state -o begun.png
grows grow 'builtin:tile?n=64' --model schnakenberg --size 16px --nested --resume state -o resumed.png
grows grow 'builtin:tile?n=64' --model schnakenberg --size 16px --nested -o nested.png
! cmp -s resumed.png plain.png || fail "a nested run that is resumed begins anew"
! cmp -s plain.png nested.png || fail "--nested changes nothing"
grows grow 'builtin:tile?n=64' --model schnakenberg --size 8px --nested --steps 5 -o coarse.png
grep -q 'nested changes nothing' log || fail "nothing is said where no coarser grid resolves the pattern"
refused 2 'no grid' grow 'builtin:sphere?n=642' --model schnakenberg --nested -o a.glb
# Values at a side, without naming a stepper.
printf '[stage]\nmodel = "turing"\nsize = "9px"\n[stage.boundary]\nxmin = { a = { value = "4 + y" } }\n' > values.toml
grows grow 'builtin:sheet?n=40x30' --recipe values.toml --steps 5 -o values.png
# A unit that is given counts for grids, too: 0.001 in the file, as VTK writes it.
grows grow t.vti --model turing --size 9mm --input-unit mm --steps 5 -o unit.vti
grep -q 'metres_per_unit.*>CAAAAAAAAAD8qfHSTWJQPw==<' unit.vti || fail "--input-unit mm of a grid"
grows gallery turing --shape 'builtin:tile?n=32' --shape builtin:moebius --size 12px --picture-size 64 -o gallery -q
# Patches with images: the mesh names what is beside it, and the vertices have no colours that would darken these.
grows grow builtin:vase --recipe leopard --size 0.2 --steps 5 --bake 256 -o v.glb,v.obj,v.png --patch-images patches
for file in v.mtl v-color.png patches/*.png; do [ -s "$file" ] || fail "--bake: no $file"; done
grep -q '^mtllib v.mtl' v.obj && grep -q '^usemtl coat' v.obj && grep -q '^map_Kd v-color.png' v.mtl || fail "v.obj and its image"
! grep -qE '^v( [^ ]+){4}' v.obj || fail "v.obj has colours at its vertices"
grep -qa 'baseColorTexture' v.glb || fail "v.glb has no texture"

refused 2 'unknown built-in shape "tiles"' grow builtin:tiles -o a.png
refused 2 'did you mean "vase"' grow builtin:vsae -o a.glb
refused 2 '3 nodes along a periodic axis' grow 'builtin:tile?n=2' -o a.png
refused 2 'too much memory' grow 'builtin:tile?n=99999' -o a.png
refused 2 'are files of grids' grow 'builtin:sphere?n=642' -o a.png
refused 2 'px are cells of a grid' grow 'builtin:sphere?n=642' --size 9px -o a.glb
refused 2 'is for surfaces' grow 'builtin:tile?n=48' --method loop -o a.png
refused 2 'is for even grids' grow 'builtin:sphere?n=642' --stepper gaussian -o a.glb
refused 2 'diffusion that is the same everywhere' grow 'builtin:tile?n=48' --recipe zebra --stepper gaussian -o a.png
refused 2 'these nodes stay where they are' grow 'builtin:tile?n=48' --fair -o a.png
refused 2 'coloured at its own nodes' grow 'builtin:tile?n=48' --detail 2 -o a.png
refused 2 'show other surfaces than that of the shape' grow builtin:sphere --solid --keep-shape --cut 'x>0' --size 0.3 -o a.glb
refused 2 'a line does in the course of time' grow 'builtin:tile?n=48' --plot a.png
refused 2 'a block has no height' grow 'builtin:box?n=8' --model turing --size 4px --height-map a.png
refused 2 'for sheets of grids' grow 'builtin:sphere?n=642' --height-map a.png
refused 2 'leave --flat and --detail out' grow 'builtin:sphere?n=642' --bake 256 --flat -o a.glb
refused 2 'shows an image on a mesh' grow builtin:vase --bake 256 -o a.ply
refused 2 'at most 16384' grow builtin:vase --bake 100000 -o a.glb
refused 2 '16' grow builtin:vase --bake 3 -o a.glb
refused 5 'missing' grow builtin:vase --maps missing/a
refused 2 'of a grid write a .png' grow 'builtin:tile?n=48' --bake 256 -o a.glb
refused 2 'no room for a texel' grow builtin:vase --bake 32 -o a.glb
refused 2 'a grid for the shape' grow 'builtin:sphere?n=642' --preview 3x3 --picture a.png

refused 2 'expected what is cut away' grow 'builtin:box?n=12' --cut x -o a.glb
refused 2 'leaves nothing' grow 'builtin:box?n=12' --model turing --cut 'x>-1' -o a.glb
refused 2 'the inside of volumes' grow 'builtin:sphere?n=642' --cut 'x>0' -o a.glb
refused 2 'unknown species "q"' grow 'builtin:box?n=12' --model turing --isosurface q -o a.glb
refused 2 'at the nodes of this shape .vti, .vts, .raw' grow 'builtin:box?n=12' --model turing -o a.png

patch() { printf '[[patch]]\nname = "%s"\nnodes = [5, %s]\n[patch.formula]\nx = "%s"\ny = "v"\nz = "0"\n' "$1" "$2" "$3"; }
{ patch a 5 u; patch b 7 1+u; } >patches.toml
refused 3 'a.east and b.west run along each other but do not match: 5 and 7' grow patches.toml -o a.glb
{ patch a 5 u; patch b 5 'log(u - 2)'; } >patches.toml
refused 2 'patches.toml:.*not finite at u' grow patches.toml -o a.glb
printf 'outline = { points = [[0, 0], [1, 1], [1, 0], [0, 1]] }\n' >region.toml
refused 2 'region.toml:' grow region.toml -o a.vts
[ $failures = 0 ] && echo "all right" || exit 1

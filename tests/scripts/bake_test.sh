#!/usr/bin/env bash
# pelage grow --bake and --maps, from files with uv to files with images. Usage: SOURCE BINARY
set -uo pipefail
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$2/bake_test
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

# A sheet of 12 x 12 squares with the materials left and right, whose uv fills the image: u from $1 to $1 + $2.
sheet() {
  awk -v begin="$1" -v width="$2" 'BEGIN {
    n = 12
    for (j = 0; j <= n; ++j)
      for (i = 0; i <= n; ++i) {
        print "v", i / n, j / n, 0.05 * sin(6 * i / n)
        print "vt", begin + width * i / n, 0.05 + 0.9 * j / n
      }
    for (i = 0; i < n; ++i) {
      print "usemtl", i < n / 2 ? "left" : "right"
      for (j = 0; j < n; ++j) {
        a = j * (n + 1) + i + 1
        print "f", a "/" a, a + 1 "/" a + 1, a + n + 2 "/" a + n + 2, a + n + 1 "/" a + n + 1
      }
    }
  }'
}
bakes() { "$pelage" grow "$@" --no-record --model turing --size 0.15 --quality draft --steps 30 >out 2>err || { cat err; fail "$*"; }; }
refused() {
  local code=$1 text=$2
  shift 2
  "$pelage" grow "$@" >out 2>err
  [ $? -eq "$code" ] || fail "no exit code $code of: $*"
  grep -qF -- "$text" err || { cat err; fail "no \"$text\" of: $*"; }
}
# Width and height of a PNG, its bits and its kind of colours.
kind() { od -An -tx1 -j16 -N10 "$1" | tr -d ' \n'; }

sheet 0.05 0.9 >sheet.obj
bakes sheet.obj --bake 64 -o a.glb,a.obj --maps m --material 'height=0.1*b' --material 'roughness=0.3' --material 'opacity=0.5'
# The file's own squares, points and materials, with images.
[ "$(grep -c '^f' a.obj)" = 144 ] && [ "$(grep '^f' a.obj | awk '{ print NF }' | sort -u)" = 5 ] || fail "a.obj has other faces"
[ "$(grep '^v ' a.obj | awk '{ print $1, $2, $3 }' | sort)" = "$(grep '^v ' sheet.obj | awk '{ print $1, $2, $3 }' | sort)" ] ||
  fail "a.obj has other points"
for material in left right; do
  grep -q "^usemtl $material" a.obj && grep -q "^newmtl $material" a.mtl || fail "a.obj and a.mtl: no $material"
done
for map in color normal roughness opacity; do
  [ -s m-$map.png ] && cmp -s a-$map.png m-$map.png || fail "a-$map.png and m-$map.png"
  grep -q " a-$map.png" a.mtl || fail "a.mtl does not name a-$map.png"
done
[ "$(kind m-color.png)" = 00000040000000400802 ] || fail "m-color.png"
[ "$(kind m-roughness.png)" = 00000040000000400800 ] || fail "m-roughness.png"
[ "$(kind m-height.png)" = 00000040000000401000 ] || fail "m-height.png"
[ -s m-height.exr ] || fail "no m-height.exr"
for word in baseColorTexture normalTexture TANGENT metallicRoughnessTexture BLEND '"left"' '"right"'; do
  grep -qa "$word" a.glb || fail "a.glb has no $word"
done
! grep -qa COLOR_0 a.glb || fail "a.glb has colours at its vertices"
! grep -q 'of the uv' err || fail "warnings for a good uv: $(cat err)"
grep -q 'with --bake 64 a wave of the pattern has 11.7 texels or fewer on 5 % of the surface; --bake 128 would give 23.5' err ||
  fail "no word of too few texels: $(cat err)"

# The same bits on one thread; images alone, of the usual size.
bakes sheet.obj --bake 64 --maps one --threads 1 --material 'height=0.1*b' --material 'roughness=0.3' --material 'opacity=0.5'
for map in color normal height; do cmp -s one-$map.png m-$map.png || fail "one thread: $map"; done
bakes sheet.obj --maps usual
[ "$(kind usual-color.png)" = 00000800000008000802 ] || fail "usual-color.png"
[ ! -e usual-normal.png ] || fail "a normal map without a height"

# Light beyond white, glass, and the levels of the colours.
bakes sheet.obj --bake 64 -o g.glb,g.obj --maps g --mips --ramp mono --material 'emission=6*b' --material 'transmission=b' --material 'thickness=2*b'
for word in KHR_materials_emissive_strength transmissionTexture thicknessTexture emissiveTexture; do
  grep -qa "$word" g.glb || fail "g.glb has no $word"
done
grep -q 'g-emission.png.*white is ' out && grep -q 'g-thickness.png.*white is ' out || fail "scales: $(cat out)"
[ "$(grep '^Ke' g.mtl | head -1)" != 'Ke 1 1 1' ] || fail "g.mtl: Ke"
[ "$(od -An -tx1 -N12 g-color.ktx2 | tr -d ' \n')" = ab4b5458203230bb0d0a1a0a ] || fail "g-color.ktx2 is no KTX2"
[ "$(od -An -td4 -j12 -N32 g-color.ktx2 | xargs)" = '43 1 64 64 0 0 1 7' ] || fail "g-color.ktx2: levels"
[ "$(wc -c <g-color.ktx2)" -ge $((4 * 5461)) ] || fail "g-color.ktx2 is too short"

# Tiles, and what lies across their border.
{ sheet 0.05 0.9; sheet 1.05 0.9 | awk '/^v / { $2 += 2 } /^f/ { for (i = 2; i <= 5; ++i) { split($i, a, "/"); $i = a[1] + 169 "/" a[1] + 169 } } { print }'; } >tiles.obj
bakes tiles.obj --bake 32 -o t.glb,t.obj --maps t
for file in t-color.1001.png t-color.1002.png t-height.1002.exr; do [ -s $file ] || fail "tiles: no $file"; done
grep -q '^usemtl coat.1002' t.obj && grep -q '^map_Kd t-color.1002.png' t.mtl || fail "t.obj and its tiles"
sheet 0.5 0.9 >across.obj
bakes across.obj --bake 32 -o c.glb
grep -q 'triangles of the uv, the first one of face 72, lie across the border' err || fail "across: $(cat err)"
sheet 0.95 -0.9 >mirrored.obj
bakes mirrored.obj --bake 32 -o d.glb
grep -q '288 triangles of the uv, the first one of face 0, are mirrored' err || fail "mirrored: $(cat err)"
{ sheet 0.05 0.9; sheet 0.05 0.9 | awk '/^v / { $2 += 2 } /^f/ { for (i = 2; i <= 5; ++i) { split($i, a, "/"); $i = a[1] + 169 "/" a[1] + 169 } } { print }'; } >twice.obj
bakes twice.obj --bake 64 -o e.glb
grep -q '288 triangles of the uv, the first one of face 144, lie over others, which alone' err || fail "twice: $(cat err)"

# A mesh without uv gets the atlas of pelage unwrap, whole faces and all.
grep -v '^vt' sheet.obj | sed 's/\/[0-9]*//g' >bare.obj
bakes bare.obj --bake 256 -o b.glb,b.obj --maps b
grep -q 'the shape has no uv: it gets an atlas of 1 chart, as pelage unwrap makes it' err || fail "no atlas: $(cat err)"
"$pelage" unwrap bare.obj -o unwrapped.obj --resolution 256 --margin 1 -q || fail "unwrap bare.obj"
[ "$(grep '^vt' b.obj)" = "$(grep '^vt' unwrapped.obj)" ] || fail "b.obj has another atlas than that of pelage unwrap"
[ "$(grep -c '^f' b.obj)" = 144 ] && grep -qa TEXCOORD_0 b.glb || fail "b.obj and b.glb"
rm bare.obj

# Onto another mesh of the same shape, with uv or without: its own faces, and a normal map without any height.
sheet 0.05 0.9 | awk '/^v / { $4 *= 0.9 } { print }' >low.obj
grep -v '^vt' sheet.obj | sed 's/\/[0-9]*//g' >high.obj
bakes high.obj --bake 64 --onto low.obj -o l.glb,l.obj --maps l
[ "$(grep '^v ' l.obj | awk '{ print $1, $2, $3 }' | sort)" = "$(grep '^v ' low.obj | awk '{ print $1, $2, $3 }' | sort)" ] ||
  fail "l.obj has other points than low.obj"
[ -s l-normal.png ] && grep -qa normalTexture l.glb && grep -q ' l-normal.png' l.mtl || fail "--onto: no normal map"
! grep -q 'lie farther' err || fail "low.obj lies near: $(cat err)"
grep -v '^vt' low.obj | sed 's/\/[0-9]*//g' >lower.obj
bakes high.obj --bake 256 --onto lower.obj -o l.glb
grep -q 'it gets an atlas of 1 chart' err || fail "--onto without uv: $(cat err)"
awk '/^v / && $2 == 1 { $4 += 0.2 } { print }' low.obj >far.obj
bakes high.obj --bake 64 --onto far.obj -o l.glb
grep -q '24 triangles of --onto, the first one of face 132, lie farther than' err || fail "far: $(cat err)"
awk '/^v / { $2 *= 1000; $3 *= 1000; $4 *= 1000 } { print }' low.obj >units.obj
rm l.glb l.obj l.mtl

# Nothing is grown, and nothing is left, where it cannot be written.
before=$(ls)
refused 2 'shows an image on a mesh' sheet.obj --bake 64 -o x.ply
refused 2 'GB of memory; at most 16384' sheet.obj --bake 100000 -o x.glb
refused 2 '16' sheet.obj --bake 0 -o x.glb
refused 2 '16' sheet.obj --bake 3 -o x.glb
refused 2 'leave --flat and --detail out' sheet.obj --bake 64 --flat -o x.glb
refused 2 'how the names of the images begin' sheet.obj --maps ./
refused 5 'missing' sheet.obj --maps missing/x
refused 5 'missing' sheet.obj --bake 64 -o missing/x.glb
refused 5 'sheet.obj' sheet.obj --maps sheet.obj/x
refused 2 'goes with --maps' sheet.obj --bake 64 --mips -o x.glb
refused 2 'give --bake N, or --maps PREFIX, too' high.obj --onto low.obj -o x.glb
refused 2 'expected a mesh' high.obj --bake 64 --onto builtin:tile -o x.glb
refused 2 'and the shape is none' builtin:vase --bake 64 --onto low.obj -o x.glb
refused 2 '--growth moves the coat away' high.obj --growth 0.00001 --bake 64 --onto low.obj -o x.glb
refused 3 'no mesh of the shape that the coat grows on: its diagonal is 999.5 times' high.obj --bake 64 --onto units.obj -o x.glb
refused 3 'missing.obj' high.obj --bake 64 --onto missing.obj -o x.glb
refused 2 'low.obj' high.obj --bake 64 --onto low.obj -o low.obj
# Images beyond memory, before the coat grows. (Sanitizers need more than is left there.)
if (ulimit -v 4000000 && "$pelage" --version >out 2>err); then
  (ulimit -v 4000000 && refused 4 'baking 16384 x 16384 texels needs about 8.2 GB of memory, but the process may have 4.1 GB in all; --bake 8192 needs 2.1 GB' \
    sheet.obj --bake 16384 --maps x --material 'roughness=b' -o x.glb; exit $failures) || failures=$((failures + 1))
fi
refused 2 'for surfaces with uv' builtin:sphere?n=300 --solid --size 0.3 --bake 64 -o x.glb
[ "$(ls)" = "$before" ] || fail "files are left: $(ls)"

[ $failures -eq 0 ] && echo "baking: as it should be"
exit $((failures > 0))

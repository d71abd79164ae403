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
  "$pelage" "$@" --no-record >log 2>&1 </dev/null || { fail "pelage $*"; tail -2 log; }
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

# All around: picture k of n is the one from an angle, whatever n is; and a file holds what another does.
draws "${ball[@]}" --picture two.png --turntable 2
draws "${ball[@]}" --picture four.png --turntable 4
same two.0001.png four.0001.png
same two.0002.png four.0003.png
differ two.0001.png two.0002.png
[ ! -e two.png ] || fail "two.png: a turntable wrote a picture of its own name"
refused 'give --turntable' cells builtin:animal -n 200 --picture a.mp4
refused 'without --frames' "${ball[@]}" --picture a.png --turntable 4 --frames 3
refused 'no other side' grow 'builtin:tile?n=16' --model turing --size 8px --steps 1 --picture a.png --turntable 2
refused '--camera' "${ball[@]}" --picture a.png --camera x.glb --azimuth 3
refused 'Value 5 not in range\|--focal-length' "${ball[@]}" --picture a.png --focal-length 5
draws "${ball[@]}" --picture lens.png --focal-length 24
draws "${ball[@]}" --picture air.png --no-ground
differ plain.png lens.png
differ plain.png air.png
draws "${field[@]}" --picture around.png --turntable 2
[ -s around.0002.png ] || fail "no around.0002.png"

# A camera of a glTF file: its proportions, and the same place whatever axis points up.
cat >camera.gltf <<'END'
{"asset": {"version": "2.0"}, "nodes": [{"camera": 0, "translation": [0, 0.3, 4]}], "cameras": [
 {"type": "perspective", "perspective": {"yfov": 0.5, "aspectRatio": 2, "znear": 0.1}}]}
END
draws "${ball[@]}" --picture camera.png --camera camera.gltf
differ plain.png camera.png
[ "$(od -An -tx1 -j16 -N8 camera.png | tr -d ' \n')" = 0000004000000020 ] || fail "camera.png is not 64 x 32"
echo '{"asset": {"version": "2.0"}, "nodes": [{}]}' >none.gltf
refused 'no perspective camera' "${ball[@]}" --picture a.png --camera none.gltf

# EXR is what PNG shows, in linear light: to within the dither and a rounding.
draws "${ball[@]}" --picture plain.exr
python3 - plain.exr plain.png <<'END' || fail "plain.exr and plain.png differ"
import struct, sys, zlib
exr, png = (open(name, "rb").read() for name in sys.argv[1:])
size = 64
at = exr.index(b"screenWindowWidth\0") + len(b"screenWindowWidth\0float\0") + 8 + 1
planes = {}
for block in range(size // 16):
    start, = struct.unpack_from("<Q", exr, at + 8 * block)
    y0, length = struct.unpack_from("<iI", exr, start)
    data = exr[start + 8:start + 8 + length]
    if length < 16 * size * 12:
        data = bytearray(zlib.decompress(data))
        for i in range(1, len(data)):
            data[i] = (data[i - 1] + data[i] - 128) % 256
        half = (len(data) + 1) // 2
        data = bytes(b for pair in zip(data[:half], data[half:]) for b in pair)
    for row in range(16):
        for k, name in enumerate("BGR"):
            planes[name, y0 + row] = struct.unpack_from(f"<{size}f", data, 4 * size * (3 * row + k))
pixels, chunk = b"", 8
while chunk < len(png):
    length, kind = struct.unpack_from(">I4s", png, chunk)
    if kind == b"IDAT":
        pixels += png[chunk + 8:chunk + 8 + length]
    chunk += 12 + length
rows, before = zlib.decompress(pixels), bytes(3 * size)
assert png[24] == 8 and png[25] == 2
worst = 0
for y in range(size):
    kind, row = rows[y * (3 * size + 1)], bytearray(rows[y * (3 * size + 1) + 1:(y + 1) * (3 * size + 1)])
    for i in range(len(row)):
        a, b, c = (row[i - 3] if i >= 3 else 0), before[i], (before[i - 3] if i >= 3 else 0)
        p = a + b - c
        paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
        row[i] = (row[i] + (0, a, b, (a + b) // 2, paeth)[kind]) % 256
    before = bytes(row)
    for i, byte in enumerate(row):
        x = min(max(planes["RGB"[i % 3], y][i // 3], 0), 1)
        srgb = 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055
        worst = max(worst, abs(255 * srgb - byte))
assert worst < 1.2, worst  # the dither is half a percent, the rounding half a step
assert max(max(row) for row in planes.values()) > 0.3
END

[ $failures -eq 0 ] && echo "all right"
exit $((failures > 0))

#!/usr/bin/env bash
# Coats to be printed as people make them: closed solids in 3MF and STL, their warnings, and what is refused.
# Usage: SOURCE BINARY
set -uo pipefail
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$2/print_test
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
failures=0
fail() { echo "FAILED: $1"; failures=$((failures + 1)); }
quick="--model turing --size 0.2 --quality draft --detail 1"

# refused CODE WORDS ARGUMENTS: with that exit code and these words in the message, and without a file.
refused() {
  local code=$1 words=$2
  shift 2
  "$pelage" grow "$@" -o refused.stl >log 2>&1 </dev/null
  local was=$?
  [ $was = "$code" ] || fail "grow $*: exit code $was instead of $code"
  grep -q -- "$words" log || { fail "grow $*: no \"$words\" in the message"; tail -1 log; }
  [ ! -e refused.stl ] || fail "grow $*: refused.stl was written"
}

# A ball with holes: closed, upright, in millimetres, in the colours of the PLY file.
# shellcheck disable=SC2086
"$pelage" grow 'builtin:sphere?n=642' $quick --perforate "bx^2 > 0.8 or abs(bz) > 0.9" --thicken 0.2u --input-unit mm \
  -o ball.3mf,ball.ply,ball.stl >log 2>&1 </dev/null || { fail "a ball with holes"; cat log; }
grep -q "closed, 1 piece, 3 handles" log || { fail "four holes make three handles"; grep solid log; }
grep -q "goes through itself" log && fail "a ball that goes through itself"
python3 - <<'PY' || fail "ball.3mf"
import collections, re, struct, sys, zipfile
from xml.etree import ElementTree
core = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
material = "{http://schemas.microsoft.com/3dmanufacturing/material/2015/02}"
archive = zipfile.ZipFile("ball.3mf")
assert archive.testzip() is None
assert set(archive.namelist()) == {"[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"}
for name in archive.namelist():
    ElementTree.fromstring(archive.read(name))
model = ElementTree.fromstring(archive.read("3D/3dmodel.model"))
assert model.get("unit") == "millimeter"
points = [tuple(float(v.get(a)) for a in "xyz") for v in model.iter(core + "vertex")]
triangles = [tuple(int(t.get("v%d" % k)) for k in (1, 2, 3)) for t in model.iter(core + "triangle")]
edges = collections.Counter((t[k], t[(k + 1) % 3]) for t in triangles for k in range(3))
assert all(n == 1 and edges[b, a] == 1 for (a, b), n in edges.items()), "every edge twice, in either direction"
volume = sum(a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
             for a, b, c in ([points[v] for v in t] for t in triangles)) / 6
assert 0.8 < volume < 4 / 3 * 3.1416 * (1 - 0.8**3), volume
# Where the object is placed nothing lies below the plate, and what was up (y) is up (z).
m = [float(x) for x in model.find(core + "build").find(core + "item").get("transform").split()]
place = lambda p: [sum(p[i] * m[3 * i + k] for i in range(3)) + m[9 + k] for k in range(3)]
assert min(x for p in points for x in place(p)) > -1e-6
assert all(abs(place(p)[2] - p[1] - m[11]) < 1e-6 for p in points)
colors = [c.get("color") for c in model.iter(material + "color")]
assert len(set(colors)) == len(colors) and all(re.fullmatch("#[0-9A-F]{6}FF", c) for c in colors)
ply = open("ball.ply", "rb").read()
head, body = ply.split(b"end_header\n", 1)
fields = re.findall(rb"property (\w+) (\w+)\n", head.split(b"element face")[0])
size = sum({b"float": 4, b"uchar": 1}[kind] for kind, _ in fields)
offset, at = 0, {}
for kind, name in fields:
    at[name] = offset
    offset += {b"float": 4, b"uchar": 1}[kind]
for t, e in zip(triangles, model.iter(core + "triangle")):
    for k, v in enumerate(t):
        rgb = body[v * size + at[b"red"]:v * size + at[b"red"] + 3]
        assert colors[int(e.get("p%d" % (k + 1)))] == "#%02X%02X%02XFF" % tuple(rgb)
stl = open("ball.stl", "rb").read()
assert struct.unpack("<I", stl[80:84])[0] == len(triangles)
PY
if command -v admesh >log; then
  admesh ball.stl >log
  grep -Eq "Total disconnected facets *: *0 *0" log && grep -Eq "Edges fixed *: *0" log && grep -Eq "Degenerate facets *: *0" log || fail "admesh on ball.stl"
fi

# Parts that hang on nothing go, and walls without room become thinner; both are said.
# shellcheck disable=SC2086
"$pelage" grow 'builtin:sphere?n=642' $quick --perforate "abs(by - 0.5) < 0.1" --thicken 1.5u -o half.stl >log 2>&1 </dev/null || fail "half a ball"
grep -q "1 part between the holes .* hung on nothing" log || { fail "the cap is an island"; cat log; }
grep -q "is thinner at .* vertices of" log || { fail "a wall that is too thick"; cat log; }

# A relief that is higher than its room.
# shellcheck disable=SC2086
"$pelage" grow 'builtin:torus?n=576' $quick --material height=-2.5 --displace -o deep.stl >log 2>&1 </dev/null || fail "a deep relief"
grep -Eq "goes through itself at [0-9]+ pairs of triangles, first near" log || { fail "a tube that is turned inside out"; cat log; }

refused 2 "expected a condition, for example \"b < 0.5\"" builtin:sphere?n=162 $quick --perforate b
refused 2 "c" builtin:sphere?n=162 $quick --perforate "c < 4"
refused 2 "holds nowhere: b lies between" builtin:sphere?n=162 $quick --perforate "b < -1e9"
refused 2 "holds everywhere: b lies between" builtin:sphere?n=162 $quick --perforate "b > -1e9"
refused 2 "is not a length" builtin:sphere?n=162 $quick --thicken thick
refused 2 "diagonals of the shape" builtin:sphere?n=162 $quick --thicken 3
refused 2 "leave --keep-shape out" builtin:sphere?n=162 --thicken 0.1 --keep-shape
refused 2 "turns over into itself" builtin:moebius --thicken 0.1
refused 2 "is for surfaces" builtin:box?n=8x8x8 --thicken 0.1
refused 2 "cut whole surfaces" builtin:sphere?n=162 --method cells --perforate "b < 4"

echo "$failures failures"
[ "$failures" -eq 0 ]

#!/usr/bin/env bash
# grow --lines as files that other programs read: sizes and closed curves in SVG and DXF, elements in OBJ and VTP; and sheets
# with their exit codes. Usage: SOURCE BINARY
set -uo pipefail
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$2/lines_test
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
failures=0
fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# A sphere of radius 1 in centimetres is 20 mm across.
"$pelage" grow "builtin:sphere?n=2562" --size 0.15 --input-unit cm --isoline "b = 4" -o ball.vtp \
  --lines ball.svg,ball.dxf,ball.obj,lines.vtp >log 2>&1 || fail "grow: $(tail -1 log)"
parts=$("$pelage" measure ball.vtp --field b --level 4 --json |
  python3 -c 'import json, sys; m = json.load(sys.stdin); print(m["above"]["parts"] + m["below"]["parts"])')
[ "$(grep -c '^l ' ball.obj)" -eq $((parts - 1)) ] || fail "$(grep -c '^l ' ball.obj) lines around $parts parts of a ball"
grep -q "NumberOfLines=\"$((parts - 1))\"" lines.vtp || fail "lines.vtp has not $((parts - 1)) lines"
python3 - <<'PYTHON' || fail "ball.svg is not what it should be"
import math, re, sys
import xml.etree.ElementTree as ET
svg = ET.parse("ball.svg").getroot()
name = "{http://www.w3.org/2000/svg}"
box = [float(x) for x in svg.get("viewBox").split()]
assert svg.get("width") == f"{box[2]:.7g}mm" and abs(box[2] - 20) < 0.1 and abs(box[3] - 20) < 0.1, svg.attrib
outline, lines = svg.findall(name + "g")
def curves(path):
    for text in path.get("d").split("M")[1:]:
        numbers = [float(x) for x in re.findall(r"[-+.\de]+", text)]
        yield "Z" in text, list(zip(numbers[::2], numbers[1::2]))
ring, = curves(outline.find(name + "path"))
assert ring[0]
for x, y in ring[1]:
    assert abs(math.hypot(x - box[2] / 2, y - box[3] / 2) - 10) < 0.05
region, drawn = lines.findall(name + "path")
assert region.get("fill-rule") == "evenodd" and all(closed for closed, _ in curves(region))
assert any(closed for closed, _ in curves(drawn))
PYTHON
/usr/bin/env python3 - <<'PYTHON' || fail "ball.dxf is not what it should be"
try:
    import ezdxf
    from ezdxf import bbox
except ImportError:
    raise SystemExit(0)
drawing = ezdxf.readfile("ball.dxf")
assert not drawing.audit().errors
ends = bbox.extents(drawing.modelspace().query('*[layer=="outline"]'))
assert abs(ends.extmax[0] - ends.extmin[0] - 20) < 0.05
PYTHON

# What cannot be is said before the growth.
expect_usage() {
  "$pelage" "$@" >log 2>&1
  [ $? -eq 2 ] || fail "$*: no wrong usage: $(tail -1 log)"
}
expect_usage grow "builtin:sphere?n=642" --lines a.png
expect_usage grow "builtin:sphere?n=642" --lines a.svg --isoline "c = 4"
expect_usage grow "builtin:sphere?n=642" --lines a.svg --lines-view upside
expect_usage grow "builtin:sphere?n=642" --isoline "b = 4" -o a.ply
expect_usage grow "builtin:sphere?n=642" --lines a.svg --lines-view uv --steps 2

small=(--shapes "builtin:torus?n=500" --size 0.3 --picture-size 48)
"$pelage" sheet --models turing "${small[@]}" --seeds 1,2 --set s=0.03,0.05 -o sheet.png >log 2>&1 || fail "sheet: $(tail -1 log)"
[ -s sheet.png ] || fail "no sheet.png"
expect_usage sheet --models turing,schnakenberg "${small[@]}" --seeds 1,2 --set s=1,2 -o no.png
expect_usage sheet --models turing "${small[@]}" --set s=none -o no.png
[ -e no.png ] && fail "a sheet that was refused was written"
printf '[[stage]]\nmodel = "turing"\nmask = "attribute(age)"\n' >needs-age.toml
"$pelage" sheet --recipes needs-age.toml --models turing "${small[@]}" -o half.png >log 2>&1
[ $? -eq 4 ] || fail "a tile that failed does not show in the exit code"
grep -q 'needs-age.toml.*failed: ' log || fail "a tile that failed is not named"
[ -s half.png ] || fail "no sheet of what did not fail"
echo "$failures failures"
[ "$failures" -eq 0 ]

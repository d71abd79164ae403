#!/usr/bin/env bash
# The command line as its users meet it: exit codes, messages, files, interruption. Usage: SOURCE BINARY
set -uo pipefail
source=$1
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$2/cli_test
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# expect EXIT_CODE PATTERN ARGUMENTS...: runs pelage; PATTERN (extended) must match its one line on stderr.
expect() {
  local code=$1 pattern=$2
  shift 2
  "$pelage" "$@" >stdout 2>stderr </dev/null
  local got=$?
  [ $got -eq "$code" ] || fail "pelage $*: exit code $got instead of $code: $(cat stderr)"
  grep -vE '^pelage: ([a-z]*ing|warning)' stderr >errors
  [ "$(wc -l <errors)" -eq 1 ] || fail "pelage $*: $(wc -l <errors) lines of errors instead of 1"
  grep -qE "^pelage: error: $pattern" errors || fail "pelage $*: the message \"$(cat errors)\" does not match $pattern"
}

# succeed ARGUMENTS...: runs pelage, which must exit with 0.
succeed() {
  "$pelage" "$@" >stdout 2>stderr </dev/null || fail "pelage $*: exit code $?: $(cat stderr)"
}

is_json() { python3 -m json.tool <"$1" >/dev/null || fail "$1 of the last command is not JSON"; }

# json EXPRESSION: whether the expression about d, the JSON of the last command, holds.
json() { python3 -c "import json,sys; d=json.load(open('stdout')); sys.exit(not ($1))" || fail "JSON: not $1"; }

sphere=builtin:sphere?n=642
quick=(--size 0.3 --steps 3 --detail 0)

# --- help and version ----------------------------------------------------------------------------------
succeed --version
grep -qE '^pelage [0-9]+\.[0-9]+\.[0-9]+$' stdout || fail "--version says $(cat stdout)"
"$pelage" >stdout 2>stderr
[ $? -eq 2 ] && [ ! -s stdout ] && grep -q Usage stderr || fail "no arguments: help on stderr and exit code 2 expected"
succeed --help
for command in grow check models formulas analyse map gallery sheet measure recipes fair field unwrap compare verify; do
  grep -q "^  $command " stdout || fail "--help does not list $command"
done
for command in grow check models formulas analyse map gallery sheet measure recipes fair field unwrap compare verify; do
  succeed $command --help
  cp stdout help
  succeed help $command
  cmp -s stdout help || fail "help $command is not $command --help"
  grep -q "pelage $command" stdout || fail "$command --help has no example"
  [ "$(wc -L <stdout)" -le 100 ] || fail "$command --help is wider than 100 columns"
done

# --- the way up -------------------------------------------------------------------------------------------
cat >tower.ply <<'PLY'
ply
format ascii 1.0
comment Created in Blender version 4.2.0
element vertex 4
property float x
property float y
property float z
element face 4
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
0 0 9
3 0 2 1
3 0 1 3
3 1 2 3
3 2 0 3
PLY
height='d["high"][1] - d["low"][1]'
succeed grow tower.ply "${quick[@]}" --keep-shape -o up.glb
succeed check up.glb --json && json "abs($height - 9) < 1e-6"
grep -qa '"name":"tower"' up.glb || fail "mesh and node are not named after the shape"
succeed grow tower.ply "${quick[@]}" --keep-shape --up y -o down.glb
succeed check down.glb --json && json "abs($height - 1) < 1e-6"
succeed fair tower.ply --steps 0 -o up.glb
succeed check up.glb --json && json "abs($height - 9) < 1e-6"

# --- units ------------------------------------------------------------------------------------------------
# A part of 60 x 40 x 10 of whatever the file counts.
cat >part.obj <<'OBJ'
v 0 0 0
v 60 0 0
v 60 40 0
v 0 40 0
v 0 0 10
v 60 0 10
v 60 40 10
v 0 40 10
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
OBJ
part=(--steps 1 --detail 0)
succeed fair part.obj --steps 0 -q -o part.stl,part.ply,part.off
succeed check part.stl --json && json 'd["metres_per_unit"] == 0.001'
succeed check part.obj --json && json 'd["metres_per_unit"] is None'
succeed grow part.stl --size 4mm "${part[@]}" -o a.ply
grep -q '^noted .*STL says no unit: taken as millimetres' stdout || fail "the unit of STL was not said"
grep -q '^unit  *mm: the shape is 60 x 40 x 10 mm' stdout || fail "the unit that was taken was not said"
grep -q 'wavelength of 4 world units = 4 mm' stdout || fail "4mm on a part in millimetres is not 4"
for other in obj ply off; do
  expect 2 '.*60 units across, 60 m or 60 mm; give --input-unit' grow part.$other --size 4mm "${part[@]}" -o a.ply
  succeed grow part.$other --size 4mm --input-unit mm "${part[@]}" -o a.ply --json
  json 'd["stages"][0]["size"] == 4 and d["shape"]["metres_per_unit"] == 0.001'
done
succeed grow part.stl --size 1ft --input-unit in "${part[@]}" -o a.ply --json
json 'abs(d["stages"][0]["size"] - 12) < 1e-12 and "unit" not in [f["kind"] for f in d["shape"]["findings"]]'
expect 2 '--input-unit: unknown unit "inch"' grow part.stl --input-unit inch "${part[@]}" -o a.ply
expect 2 'size 4 is 4 diagonals .* write 4u for 4 units of the file' grow part.stl --size 4 "${part[@]}" -o a.ply
expect 2 'size 4 is 4 diagonals' gallery --shape part.stl --size 4 -o units turing
expect 2 '.*60 units across' gallery --shape part.obj --size 4mm -o units turing
# glTF counts metres, the other formats keep the numbers of the file.
succeed grow part.stl --size 4mm "${part[@]}" --keep-shape -q -o part.glb,kept.ply
succeed check part.glb --json && json 'abs(d["high"][0] - 0.06) < 1e-8 and d["metres_per_unit"] == 1'
succeed check kept.ply --json && json 'd["high"][0] == 60'
succeed grow part.glb --size 4mm "${part[@]}" -o a.ply --json && json 'abs(d["stages"][0]["size"] - 0.004) < 1e-12'
succeed fair part.obj --steps 0 --input-unit cm -q -o cm.glb
succeed check cm.glb --json && json 'abs(d["high"][0] - 0.6) < 1e-7'
rm a.ply

# --- direction fields -------------------------------------------------------------------------------------
succeed field $sphere -n 1 -o field.vtp,field.ply --picture field.png --picture-size 60 --json
is_json stdout
json 'd["index_sum"] == 2'
[ -s field.png ] && grep -q direction field.vtp || fail "field wrote no picture or no directions"
succeed field $sphere --axis 0,0,1 --across --stroke "1,0,0 0.7,0,0.7" -q
succeed grow field.ply "${quick[@]}" --model turing -o grown.ply
# Creases: of smooth surfaces alone, and between 0 and 180 degrees.
succeed grow builtin:cube?n=500 --crease 40 "${quick[@]}" -o creased.obj
python3 - creased.obj <<'PYTHON' || fail "the corners of a creased cube are round"
import sys
points = [tuple(map(float, line.split()[1:4])) for line in open(sys.argv[1]) if line.startswith("v ")]
most = max(max(map(abs, p)) for p in points)
corners = {tuple(x > 0 for x in p) for p in points if all(abs(abs(x) - most) < 1e-6 for x in p)}
sys.exit(len(corners) != 8)
PYTHON
expect 2 '--crease: creases are those of the smooth surface' grow builtin:cube?n=500 --crease 40 --method linear "${quick[@]}" -o a.ply
expect 2 '--crease: creases are those of the smooth surface' grow builtin:tile?n=32 --crease 40 --steps 3 -o a.png
expect 2 '--crease: creases are told by an angle' grow builtin:cube?n=500 --crease 200 "${quick[@]}" -o a.ply
expect 2 '--axis 1,2: expected X,Y,Z' field $sphere --axis 1,2
expect 2 'give one of --axis' field $sphere --axis 0,0,1 --curvature
expect 2 '--across needs' field $sphere --across
expect 2 'mark at least one vertex at each end' field $sphere --from 3
expect 2 'vertex 700 is marked; the mesh has 642' field $sphere --from 3 --to 700

succeed --help
cp stdout help
succeed help
cmp -s stdout help || fail "help is not --help"

# --- wrong usage: 2 --------------------------------------------------------------------------------------
expect 2 'unknown command "gorw".*did you mean "grow"' gorw cow.obj
expect 2 'unknown option "--sise".*did you mean "--size"' grow $sphere --sise 0.1 -o a.ply
expect 2 'unknown option "--jsno".*did you mean "--json"' check --jsno cow.obj
expect 2 'unknown option "--verson".*did you mean "--version"' --verson
expect 2 '--model needs a value' grow $sphere -o a.ply --model
expect 2 '--steps is given more than once' grow $sphere --steps 1 --steps 2
expect 2 'too many arguments: "b"' check a b
expect 2 'SHAPE is required' check
expect 2 '--steps: "abc" is not a whole number' grow $sphere -o a.ply --steps abc
expect 2 '--steps: "1.5" is not a whole number' grow $sphere -o a.ply --steps 1.5
expect 2 '--step: "0" is not a number greater than 0' grow $sphere -o a.ply --step 0
expect 2 '--compress takes no value' grow $sphere -o a.glb --compress=draco
expect 2 '--until: "nan" is not a number' grow $sphere -o a.ply --until nan
expect 2 '--stationary: "-1" is not' grow $sphere -o a.ply --stationary -1
expect 2 '--threads: "0" is not' grow $sphere -o a.ply --threads 0
expect 2 '--up: unknown axis "q"' grow $sphere -o a.ply --up q
expect 2 "'4x' is not a length" grow $sphere -o a.ply --size 4x
expect 2 "'4x' is not a length" grow $sphere -o a.ply --unit 4x
expect 2 '--size and --unit: give one of them' grow $sphere -o a.ply --size 0.3 --unit 0.1
expect 2 '.*model "schnakenberg" is measured at the values of its file; with d = 5 it is unknown' grow $sphere -o a.ply --model schnakenberg --set d=5
expect 2 '--set s: expected PARAM=VALUE' grow $sphere -o a.ply --set s
expect 2 '--set s=1e: expected PARAM=VALUE' grow $sphere -o a.ply --set s=1e
expect 2 'nothing to write' grow $sphere
# Nothing is done before all faults that need no work are found, the missing output last.
expect 2 'unknown model "turin"' grow $sphere --model turin
expect 2 'unknown ramp "leopart"' grow $sphere --ramp leopart
expect 2 'unknown recipe "dem"' grow $sphere --recipe dem
expect 3 'missing.obj: cannot be opened' grow missing.obj
expect 3 'missing.png: cannot be opened' grow $sphere --texture age=missing.png
expect 3 'missing: cannot be opened' grow $sphere --resume missing
expect 2 'unknown built-in shape "anmal"' grow builtin:anmal
expect 2 'unknown command "gorw"' help gorw
# A model or a recipe in the place of a shape, or of each other.
printf 'name = "m"\n[species.u]\ndiffusion = 1\nrate = "1 - u"\n' >m.toml
printf 'name = "r"\n[stage]\nmodel = "turing"\n' >r.toml
expect 2 'm.toml is a model.*--model m.toml' grow m.toml
expect 2 'r.toml is a recipe.*--recipe r.toml' grow r.toml -o a.ply
expect 2 'turing is a model.*--model turing' grow turing -o a.ply
expect 2 'zebra is a recipe.*--recipe zebra' grow zebra -o a.ply
expect 2 'r.toml: this is a recipe, not a model; give it as --recipe' grow $sphere --model r.toml -o a.ply
expect 2 'm.toml: this is a model, not a recipe; give it as --model' grow $sphere --recipe m.toml -o a.ply
expect 2 'r.toml: this is a recipe, not a model' analyse r.toml
expect 3 'm.toml: .*models and recipes are given to grow by --model and --recipe' check m.toml
# Models without a wavelength are sized by their unit.
expect 2 'm.toml.*give the length of its unit instead' grow $sphere --model m.toml -o a.ply
succeed grow $sphere --model m.toml --unit 0.05 --steps 2 --detail 0 -o a.ply
grep -q 'unknown wavelength' stdout || fail "grow claims a wavelength: $(cat stdout)"
succeed analyse m.toml
[ "$(grep -c -- '--unit 0.0' stdout)" -eq 1 ] || fail "analyse does not say how to size m.toml: $(cat stdout)"
# The beginning of a model.
succeed models --new mine
succeed analyse mine.toml
grep -q 'a pattern: waves of a finite length grow' stdout || fail "the skeleton makes no pattern: $(cat stdout)"
succeed analyse mine.toml:stripes
grep -q 'a pattern: waves of a finite length grow' stdout || fail "the skeleton's variant makes no pattern: $(cat stdout)"
succeed grow $sphere --model mine.toml --size 0.3 -o a.ply --json
json 'not d["uniform"] and d["stages"][0]["growth"]["maximum"] > 2'
cp mine.toml before.toml
expect 5 'mine.toml: exists already' models --new mine
cmp -s mine.toml before.toml || fail "models --new touched a file that was there"
expect 2 '"a/b" is not a name for a model' models --new a/b
succeed formulas
grep -q '^  sqrt(a)  *square root' stdout || fail "formulas does not list sqrt: $(cat stdout)"
succeed formulas --json
is_json stdout
expect 2 'no shape to grow on' grow -o a.ply
expect 2 'unknown model "turin".*did you mean "turing"' grow missing.obj -o a.ply --model turin
expect 2 'MODEL is required' analyse
expect 2 'unknown model "turin".*did you mean "turing"' analyse turin
expect 2 'turing.toml.*"q"|.*parameter "q"' analyse turing --set q=1
expect 2 'a.jpg: .*end the name in .png' analyse turing --plot a.jpg
expect 2 'd=1:2: expected PARAM=FROM:TO|--x is required' map schnakenberg --y d=1:2
expect 2 '--x d=5: expected PARAM=FROM:TO' map schnakenberg --x d=5 --y a=0.1:0.2
expect 2 '--x and --y both vary d' map schnakenberg --x d=5:6 --y d=5:6
expect 2 '-n 3: expected COLUMNSxROWS' map schnakenberg --x d=5:6 --y a=0.1:0.2 -n 3
expect 2 '.*no parameter "q"' map schnakenberg --x q=5:6 --y a=0.1:0.2
expect 2 'parameter "d" is -5' map schnakenberg --x d=-5:-6 --y a=0.1:0.2
expect 2 'the squares are .* wavelengths wide; give a side of at most' map schnakenberg --x d=15:16 --y a=0.1:0.2 --side 1e12
expect 2 'a.png: a picture of 30000 x 30000 pixels is too large; at most' grow $sphere --picture a.png --picture-size 30000
expect 2 'a.png: a picture of 48024 x 12630 pixels is too large' grow $sphere --fair --panels a.png --picture-size 12000
expect 2 'a.png: a picture of 30000 x 30000 pixels is too large' field $sphere --picture a.png --picture-size 30000
expect 2 'unknown species "w"' map schnakenberg --x d=5:6 --y a=0.1:0.2 --species w
expect 2 'unknown recipe "dem".*did you mean "demo"' grow --recipe dem -o a.ply
expect 2 'unknown ramp "leopart".*did you mean "leopard"' grow $sphere -o a.ply --ramp leopart
expect 2 '--quality: unknown quality "drafd".*did you mean "draft"' grow $sphere -o a.ply --quality drafd
expect 2 'the stepper "rkc2" cannot grow with the method "loop"' grow $sphere -o a.ply --method loop --stepper rkc2
expect 2 '--method: unknown method "lopo".*did you mean "loop"' grow $sphere -o a.ply --method lopo
expect 2 'unknown stepper "sbdf".*did you mean "sbdf2"' grow $sphere -o a.ply --stepper sbdf
expect 2 'unknown species "c"' grow $sphere -o a.ply --species c
expect 2 'model "turing" has no parameter "unevennes"' grow $sphere -o a.ply --set unevennes=1
expect 2 'parameter "s" is 7' grow $sphere -o a.ply --set s=7
expect 2 'unknown built-in shape "anmal".*did you mean "animal"' check builtin:anmal
expect 2 'a.xyz: cannot write' grow $sphere -o a.ply,a.xyz
expect 2 'a.jpg' grow $sphere --picture a.jpg
printf 'name = "r"\n[stage]\nmodel = "turing"\nsiez = 0.1\n' >wrong.toml
expect 2 'wrong.toml:4.*siez.*did you mean "size"' grow $sphere --recipe wrong.toml -o a.ply
expect 2 'unknown model "turin"' models turin

expect 2 '--ramp needs a value' grow $sphere --ramp -o a.ply
expect 2 '--recipe needs a value' grow --recipe -o a.ply
expect 2 '--steps: "x" is not a number' fair $sphere --steps x -o a.ply
expect 2 'too many arguments: "Da=1".*--set Da=1' analyse turing Da=1
expect 2 'unknown option "-s"; see' analyse turing -s Da=1
expect 2 'unknown command "version"; did you mean "--version"' version
expect 2 'model "turing" has no variant "foo"; it has production, mixed' models turing:foo
expect 2 'unknown model "zebra"; it is a recipe' grow $sphere --model zebra -o a.ply
expect 3 'sphere: did you mean builtin:sphere' grow sphere -o a.ply
expect 3 'cow: a shape needs an extension' check cow
expect 3 '.: is a directory' check .
expect 2 'unknown model "xyz"; there are [^:]*, each with variants' analyse xyz
succeed recipes zebra
grep -q '^name = "zebra"' stdout || fail "recipes zebra does not print it: $(cat stdout)"
cp stdout copy.toml
succeed grow $sphere --recipe copy.toml --steps 1 --size 0.4 --detail 0 -o a.ply
expect 2 'unknown recipe "zebr"' recipes zebr

# --- unusable input: 3 -----------------------------------------------------------------------------------
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n' >nan.off
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n' >index.obj
expect 3 'missing.obj: cannot be opened' check missing.obj
expect 3 'missing.toml: cannot be read' grow $sphere --recipe missing.toml -o a.ply
mkdir -p folder.toml
expect 3 'folder.toml: is a folder' grow $sphere --recipe folder.toml -o a.ply
expect 3 'folder.toml: is a folder' grow $sphere --model folder.toml -o a.ply
expect 3 'nan.off:5' check nan.off
expect 3 'index.obj:4' grow index.obj -o a.ply
expect 3 'nan.off: .*checkpoint' grow $sphere "${quick[@]}" --resume nan.off -o a.ply

# --- unwritable output: 5, before any work ------------------------------------------------------------------
mkdir -p folder.ply folder.png
rm -f a.ply
expect 5 'nowhere/a.ply: the folder nowhere does not exist' grow missing.obj -o nowhere/a.ply
expect 5 'nowhere/a.png: ' grow missing.obj --picture nowhere/a.png
expect 5 'nowhere/a: ' grow missing.obj -o a.ply --checkpoint nowhere/a
expect 5 'nowhere/a.png: ' map turing --x s=0.1:0.2 --y Da=1:2 -o nowhere/a.png
expect 5 'nowhere/a.png: ' analyse turing --plot nowhere/a.png
expect 5 'folder.ply: ' grow missing.obj -o folder.ply
expect 5 'folder.png: ' grow missing.obj --picture folder.png
[ ! -e a.ply ] || fail "an output appeared although nothing was grown"
"$pelage" models >/dev/full 2>stderr
[ $? -eq 5 ] || fail "a full standard output is not reported"

# --- the input is safe ---------------------------------------------------------------------------------------
succeed grow $sphere "${quick[@]}" --keep-shape -o mine.ply
expect 2 'the output .*mine.ply is an input' grow mine.ply -o "$work/mine.ply"
expect 2 'the output mine.ply is an input' fair mine.ply -o mine.ply
expect 2 'the output mine.ply is an input' field mine.ply -o mine.ply

# --- failed computation: 4 -----------------------------------------------------------------------------------
expect 4 "step [0-9]+, time .*[ab] becomes .* at vertex [0-9]+ \\(.*, .*, .*\\); [ab] went negative: give it min = 0 in the model, .*, or halve the step" grow $sphere --size 0.3 --stepper explicit --step 1000 --until 1e9 -o failed.ply
[ ! -e failed.ply ] || fail "a failed run left an output"

# --- JSON ----------------------------------------------------------------------------------------------------
for arguments in "models --json" "models turing --json" "recipes --json" "check $sphere --json"; do
  succeed $arguments
  is_json stdout
done
succeed models --json
json '"turing" in [m["name"] for m in d] and all(m["parameters"] and m["title"] for m in d)'
succeed check $sphere --json
json 'd["vertices"] == 642 and d["genus"] == 0 and d["closed"] and d["valences"]["5"] == 12'
"$pelage" check missing.obj --json >stdout 2>stderr
is_json stdout
json 'd["exit"] == 3 and "missing.obj" in d["error"]'
"$pelage" grow $sphere --sise 1 --json >stdout 2>stderr
json 'd["exit"] == 2'
succeed grow $sphere "${quick[@]}" -o a.ply,a.glb --picture a.png --picture-size 32 --json
is_json stdout
json 'd["stages"][0]["growth"]["steps"] == 3 and d["stages"][0]["growth"]["status"] == "steps_reached"'
json '[f["path"] for f in d["files"]] == ["a.ply", "a.glb", "a.png"] and all(f["bytes"] > 0 for f in d["files"])'

# --- what is said, and where ---------------------------------------------------------------------------------
succeed grow $sphere "${quick[@]}" --model witkin-kass-stripes -o a.ply --quiet  # a pattern from the first step on
[ ! -s stdout ] && [ ! -s stderr ] || fail "--quiet is not quiet"
succeed grow $sphere "${quick[@]}" -o a.ply
grep -q '^wrote *a.ply' stdout && grep -q '^grown *3 steps' stdout || fail "grow does not say what it did"
grep -q $'\r' stderr && fail "a progress bar went into a pipe"
succeed models turing
grep -q 'db/dt = div(Db grad b)' stdout && grep -q unevenness stdout || fail "models turing shows no equations"

# --- linear theory -------------------------------------------------------------------------------------------
succeed analyse schnakenberg --set a=0.1,b=0.9,d=5 --plot growth.png
grep -q 'no pattern: D_v / D_u must be above 8.568, here it is 5' stdout || fail "analyse does not name the threshold: $(cat stdout)"
python3 -c "import struct; d=open('growth.png','rb').read(); assert d[:4] == b'\x89PNG' and struct.unpack('>II', d[16:24]) == (1600, 1000)" ||
  fail "growth.png is not a picture of 1600 x 1000"
succeed analyse gray-scott --set F=0.04,k=0.055 --json
is_json stdout
json 'len(d["steady_states"]) == 3 and d["steady_states"][0]["uniform"] == "stable"'
succeed analyse brusselator --set A=2,B=3,Du=1,Dv=8 --json
json '[abs(t["diffusion"] - 4 / (3 ** .5 - 1) ** 2) < 1e-4 for t in d["thresholds"] if t["grows"] == "above"] == [True] and all(c["holds"] for c in d["conditions"])'
json '0 < d["largest_steps"]["explicit"] < d["largest_steps"]["sbdf2"]'

# --- maps: the regimes are known from theory, whatever the number of threads ------------------------------------
map=(map schnakenberg --set b=0.9 --x d=6:12 --y a=0.1:0.12 -n 2x1 --side 25 --until 120)
succeed "${map[@]}" -o map.png --json
is_json stdout
json '[c["outcome"] for c in d["cells"]] == ["uniform", "pattern"]'
succeed "${map[@]}" -o one.png --threads 1
grep -q '2: 1 with a pattern, 1 uniform, 0 failed' stdout || fail "map says: $(cat stdout)"
succeed map schnakenberg --set b=0.9 --x d=-5:6 --y a=0.1:0.12 -n 2x1 --side 25 --until 1 -o out_of_range.png
grep -q '^failed *d = -5, a = 0.1: .*parameter "d" is -5' stdout || fail "map does not say why a cell failed: $(cat stdout)"
cmp map.png one.png || fail "1 and 2 threads give different maps"

succeed gallery --recipes --shape builtin:sphere?n=100 --picture-size 64 -o coats spots-large --json
json 'd["pictures"] == [{"recipe": "spots-large", "shape": "sphere", "file": "spots-large-sphere.png", "uniform": False, "failure": None}]'
grep -q '<h1>Recipes</h1>' coats/index.html || fail "the page of recipes has no heading"
expect 2 'unknown recipe "cheeta"; did you mean "cheetah"' gallery --recipes -o coats cheeta
expect 2 '--size is for models; recipes have' gallery --recipes --size 0.1 -o coats cheetah
expect 3 'none.obj' gallery --shape none.obj -o coats turing

# --- a gallery: pictures, an index whose links all lead somewhere, failures named -------------------------------
gallery=(gallery --size 0.4 --picture-size 64)
expect 2 '-o|--output is required' gallery turing
expect 2 'unknown model "turin"' gallery -o page turin
expect 2 '--picture-size: "3" is not' gallery -o page --picture-size 3
expect 2 'two pictures would be called turing-sphere.png' gallery --shape builtin:sphere --shape builtin:sphere?n=200 -o page turing
touch no_folder
expect 5 'no_folder' gallery -o no_folder turing
succeed "${gallery[@]}" -o page brusselator schnakenberg --json
is_json stdout
json 'len(d["pictures"]) >= 4 and all(p["failure"] is None for p in d["pictures"])'
python3 - <<'PYTHON' || fail "the gallery's page is not whole"
import html.parser, os, sys
class Page(html.parser.HTMLParser):
    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("src", "href"):
                assert "//" not in value and (value.startswith("#") or os.path.getsize(os.path.join("page", value)) > 0), value
                if tag == "img": pictures.append(value)
pictures = []
Page().feed(open("page/index.html").read())
assert "brusselator-sphere.png" in pictures and "schnakenberg-animal.png" in pictures
PYTHON
printf 'name = "burst"\nwavelength = 5\n[species.u]\ndiffusion = 1\nrate = "u^2"\ninitial = 1\n' >burst.toml
expect 4 '2 of 2 pictures failed, the first: burst.toml on the sphere' "${gallery[@]}" -o broken burst.toml
grep -q 'class="failure"' broken/index.html || fail "the index does not show what failed"

# --- recipes: options override them --------------------------------------------------------------------------
printf 'shape = "%s"\n[stage]\nmodel = "turing"\nsteps = 2\nsize = 0.3\n[stage.parameters]\ns = 0.06\n' $sphere >own.toml
succeed grow --recipe own.toml --set Da=0.15 --steps 1 --detail 0 -o a.ply --json
json 'd["stages"][0]["growth"]["steps"] == 1 and d["stages"][0]["parameters"]["s"] == 0.06 and d["stages"][0]["parameters"]["Da"] == 0.15'
succeed grow --recipe own.toml --set s=0.07,Da=0.16 --size 1.5u --detail 0 -o a.ply --json
json 'd["stages"][0]["growth"]["steps"] == 2 and d["stages"][0]["parameters"]["s"] == 0.07 and d["stages"][0]["parameters"]["Da"] == 0.16 and d["stages"][0]["size"] == 1.5'
succeed grow --recipe own.toml --unit 0.2u --detail 0 -o a.ply --json
json 'd["stages"][0]["length_unit"] == 0.2 and abs(d["stages"][0]["size"] - 0.2 * 2 * 3.141592653589793 * (0.03125 / 0.06) ** 0.5) < 1e-6'
printf '[[stage]]\nname = "large"\nmodel = "turing"\nsize = 0.4\nsteps = 2\n[[stage]]\nmodel = "turing"\nsize = 0.2\nsteps = 3\nmask = "large.b < 4"\n' >two.toml
succeed grow $sphere --recipe two.toml --set large.s=0.06 --set stage2.size=1u --detail 0 -o a.ply --json
json '[s["growth"]["steps"] for s in d["stages"]] == [2, 3] and d["stages"][0]["parameters"]["s"] == 0.06 and d["stages"][1]["size"] == 1'
expect 2 '--unit: the recipe has several stages' grow $sphere --recipe two.toml --unit 0.1 -o a.ply
succeed grow $sphere --recipe two.toml --size 0.6 --detail 0 -o a.ply --json
json 'abs(d["stages"][1]["size_of_diagonal"] - 0.3) < 1e-9'
expect 2 '.*several stages; write STAGE.s=' grow $sphere --recipe two.toml --set s=0.06 -o a.ply
expect 2 '.*unknown stage "larg".*did you mean "large"' grow $sphere --recipe two.toml --set larg.s=0.06 -o a.ply
expect 2 '.*several stages; give either' grow $sphere --recipe two.toml --model turing -o a.ply
succeed grow $sphere "${quick[@]}" --param-map "Da=0.125*(1 + x^2)" --param-map "size=1 + z^2" -o a.ply
expect 2 '.*no vertex attribute "age"' grow $sphere "${quick[@]}" --param-map Da=attribute:age -o a.ply
expect 2 '.*--param-map.*expected PARAM=FORMULA' grow $sphere --param-map Da -o a.ply
expect 2 '.*param-map.*unknown parameter "Dx"' grow $sphere --param-map Dx=1 -o a.ply

# --- images as maps ------------------------------------------------------------------------------------------
python3 - <<'PYTHON'
import os, struct, zlib
def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
os.makedirs("coats", exist_ok=True)
rows = b"".join(b"\0" + bytes([0, 255] if y < 8 else [0, 0]) for y in range(16))  # 2 x 16, grey
with open("coats/age.png", "wb") as f:
    f.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 16, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
with open("square.obj", "w") as f:
    f.write("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0.1 0.1\nvt 0.9 0.1\nvt 0.9 0.9\nvt 0.1 0.9\nf 1/1 2/2 3/3 4/4\n")
PYTHON
textured=(grow square.obj --model turing --size 0.3 --steps 3 --detail 0 -o a.ply)
succeed "${textured[@]}" --texture age=coats/age.png --param-map "size=1 + 2*attribute(age)" --param-map Da=0.1+0.1*attribute\(age_1\)
printf '[[texture]]\nname = "age"\nfile = "age.png"\n[stage]\nmodel = "turing"\nsize = 0.3\nsteps = 3\nsize-map = "1 + attribute(age)"\n' >coats/old.toml
succeed grow square.obj --recipe coats/old.toml -o a.ply
succeed grow square.obj --recipe coats/old.toml --texture age=coats/age.png --texture young=coats/age.png -o a.ply
expect 3 'missing.png: cannot be opened' grow square.obj --recipe coats/old.toml --texture age=missing.png -o a.ply
expect 3 'missing.png: cannot be opened' grow no-shape.obj --texture age=missing.png -o a.ply
expect 3 'square.obj: is no PNG or JPEG image' "${textured[@]}" --texture age=square.obj
expect 2 '--texture age.png: expected NAME=FILE' "${textured[@]}" --texture age.png
expect 2 '--texture: .*the shape has no uv' grow $sphere "${quick[@]}" --texture age=coats/age.png -o a.ply
expect 2 'coats/old.toml:2:.*the shape has no uv' grow $sphere --recipe coats/old.toml -o a.ply
expect 2 '.*no vertex attribute "agee"; did you mean "age"' "${textured[@]}" --texture age=coats/age.png --param-map 'size=1+attribute(agee)'

# --- a vertex with too many edges for Loop -------------------------------------------------------------------
python3 - <<'PYTHON'
import math
n = 300
with open("wheel.off", "w") as f:
    print(f"OFF\n{n + 1} {n} 0\n0 0 0", file=f)
    for i in range(n):
        print(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n), 0, file=f)
    for i in range(n):
        print(3, 0, 1 + i, 1 + (i + 1) % n, file=f)
PYTHON
succeed grow wheel.off --size 2u --steps 1 --detail 0 -o a.ply
grep -q 'pelage: warning: a vertex has 300 edges.*linear' stderr || fail "no warning about the valence"
expect 3 'a vertex has 300 edges' grow wheel.off --size 2u --steps 1 --method loop -o a.ply
succeed gallery --shape wheel.off --size 1u --picture-size 64 -o wheel schnakenberg
grep -q 'pelage: warning: wheel: a vertex has 300 edges.*linear' stderr || fail "gallery does not warn about the valence"

# --- steps beyond what is stable ---------------------------------------------------------------------------------
succeed grow $sphere "${quick[@]}" --stepper paper --step 2 -o a.ply
grep -q 'pelage: warning: the step 2 is beyond 0.714' stderr || fail "no warning about the step"
succeed grow $sphere "${quick[@]}" --stepper paper --step 0.7 -o a.ply
grep -q beyond stderr && fail "a warning about a stable step"
for stage in one two three; do
  printf '[[stage]]\nname = "%s"\nmodel = "turing"\nstepper = "paper"\nstep = 2\nsteps = 1\n' $stage
done >steps.toml
succeed grow $sphere --recipe steps.toml --size 0.4 --detail 0 -o a.ply
[ "$(grep -c 'warning: stage .*: the step 2 is beyond' stderr)" = 3 ] || fail "not every stage warns: $(cat stderr)"

# --- same bits: threads, and a run that was stopped and resumed ------------------------------------------------
grown=(grow builtin:animal?n=1000 --size 0.15 --detail 1)
succeed "${grown[@]}" --steps 100 --threads 1 -o one.ply
succeed "${grown[@]}" --steps 100 --threads 2 -o two.ply
cmp one.ply two.ply || fail "1 and 2 threads give different files"
succeed "${grown[@]}" --steps 40 --checkpoint state -o forty.ply
succeed "${grown[@]}" --steps 100 --resume state -o resumed.ply
cmp one.ply resumed.ply || fail "a resumed run gives a different file"
cmp -s <(grep -av 'comment pelage' one.ply) <(grep -av 'comment pelage' forty.ply) && fail "40 and 100 steps give the same file: the comparison shows nothing"
expect 3 'state: .*another run' grow $sphere "${quick[@]}" --resume state -o a.ply

# --- the artist's mesh comes back ------------------------------------------------------------------------------
python3 - <<'PYTHON'
import math, random
random.seed(1)
n, m = 24, 12  # a bumpy open tube: boundary and irregular coordinates
with open("tube.obj", "w") as f:
    for j in range(m):
        for i in range(n):
            a, r = 2 * math.pi * i / n, 1 + 0.05 * random.random()
            print("v", r * math.cos(a), r * math.sin(a), 0.26 * j, file=f)
    for j in range(m - 1):
        for i in range(n):
            a, b = j * n + i + 1, j * n + (i + 1) % n + 1
            print("f", a, b, b + n, file=f)
            print("f", a, b + n, a + n, file=f)
PYTHON
succeed grow tube.obj --size 0.2 --steps 5 --keep-shape -o tube_out.obj
python3 - <<'PYTHON' || fail "--keep-shape moved vertices"
import sys
def vertices(path):
    return [tuple(map(float, l.split()[1:4])) for l in open(path) if l.startswith("v ")]
before, after = vertices("tube.obj"), vertices("tube_out.obj")
far = max(abs(x - y) for p, q in zip(before, after) for x, y in zip(p, q))
sys.exit(len(after) < len(before) or far > 1e-6)
PYTHON

# --- the form of the file --------------------------------------------------------------------------------------
cat >cube.obj <<'OBJ'
mtllib cube.mtl
o Cube
v 1 1 -1
v 1 -1 -1
v 1 1 1
v 1 -1 1
v -1 1 -1
v -1 -1 -1
v -1 1 1
v -1 -1 1
vt 0.625 0.5
vt 0.375 0.5
vt 0.625 0.75
vt 0.375 0.75
vt 0.875 0.5
vt 0.625 0.25
g lid
usemtl Fur
f 1/1 5/5 7/4 3/3
f 4/4 3/3 7/1 8/2
f 8/2 7/1 5/6 6/4
g rest
usemtl Glass
f 6/1 2/2 4/4 8/5
f 2/2 1/1 3/3 4/4
f 6/3 5/6 1/1 2/2
OBJ
printf 'newmtl Fur\nKd 0.8 0.4 0.1\nnewmtl Glass\nKd 0.1 0.4 0.8\n' >cube.mtl
same_form() {  # ignores what may differ: colours behind v, normals, and the numbers of vt
  diff <(sed -E 's/^(v [^ ]+ [^ ]+ [^ ]+).*/\1/; /^(#|vn|vt|mtllib)/d; s:/[0-9]*(/[0-9]*)?::g' "$1" | sort) \
    <(sed -E 's/^(v [^ ]+ [^ ]+ [^ ]+).*/\1/; /^(#|vn|vt|mtllib)/d; s:/[0-9]*(/[0-9]*)?::g' "$2" | sort) >/dev/null &&
    [ "$(grep -c '^vt ' "$1")" -eq "$(grep -c '^vt ' "$2")" ]
}
succeed grow builtin:sphere?n=642 "${quick[@]}" --keep-shape -o kept.ply
succeed check kept.ply --json && json 'd["vertices"] == 642'
# Without fields: the coat's colour, and what the shape had under its own name, also where a species is called so.
succeed grow $sphere "${quick[@]}" -o with.ply
succeed grow with.ply "${quick[@]}" --no-fields -o without.ply
[ "$(grep -ac '^property float [ab]$' without.ply)" -eq 2 ] || fail "--no-fields lost attributes of the shape"
[ "$(grep -ac 'input_[ab]$' without.ply)" -eq 0 ] || fail "--no-fields renamed what had room"
succeed grow $sphere "${quick[@]}" --no-fields -o bare.obj
grep -q 'cannot hold' stderr && fail "--no-fields: OBJ still warns: $(cat stderr)"

# Directions of a shape: said which, by lines and by JSON; replaced by pelage field with a warning.
succeed field $sphere -o directed.ply
succeed grow directed.ply --model witkin-kass-stripes "${quick[@]}" -o striped.ply
grep -q '^following direction_1, direction_2, direction_3 of the shape' stdout || fail "no word of the directions"
succeed grow directed.ply --model witkin-kass-stripes "${quick[@]}" --json -o striped.ply
json 'd["stages"][0]["follows"].startswith("direction_1")'
succeed field directed.ply --axis 0,0,1 --json -o again.ply
json 'd["warnings"] == ["the new field takes the place of direction_1, direction_2, direction_3 of the shape"]'
[ "$(grep -ac 'direction' again.ply)" -eq 3 ] || fail "pelage field left old directions beside the new ones"
succeed fair directed.ply --attribute DIRECTION_1 --steps 1 -o even.ply

succeed grow cube.obj --size 0.3 --steps 2 --keep-shape -o kept.obj,kept.stl
same_form cube.obj kept.obj || fail "--keep-shape changed the form of the file"
grep -q 'kept.stl: STL cannot hold .*color' stderr || fail "the loss of the coat is not said"
grep -q 'too long to show' stderr || fail "the coarseness of a kept shape is not said"
succeed fair cube.obj --steps 0 -o faired.obj
same_form cube.obj faired.obj || fail "fair changed the form of the file"
expect 2 '--keep-shape splits nothing' grow cube.obj --size 0.3 --keep-shape --detail 2 -o kept.obj

# --- Ctrl-C ------------------------------------------------------------------------------------------------------
mkdir interrupted
long=(grow builtin:animal?n=4000 --size 0.03 --until 1e9 --stationary 0 -o interrupted/a.ply)
# interrupt WORDS ARGUMENTS: sends SIGINT a second after stderr says the words. (Jobs in the background ignore it unless
# told.)
interrupt() {
  python3 - "$1" "$pelage" "${@:2}" <<'PYTHON' >interrupt.log
import signal, subprocess, sys, time
signal.signal(signal.SIGINT, signal.default_int_handler)
run = subprocess.Popen(sys.argv[2:], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
text = ""
while sys.argv[1] not in text:
    line = run.stderr.readline()
    if not line:
        break
    text += line
time.sleep(1)
sent = time.monotonic()
run.send_signal(signal.SIGINT)
text += run.stderr.read()
print(run.wait(), f"{time.monotonic() - sent:.2f} s", text.splitlines()[-1])
PYTHON
  cat interrupt.log
}
interrupt "pelage: growing" "${long[@]}"
grep -q '^130 .*pelage: error: interrupted at [0-9]* steps' interrupt.log || fail "Ctrl-C: $(cat interrupt.log)"
[ -z "$(ls interrupted)" ] || fail "Ctrl-C left files: $(ls interrupted)"
interrupt "pelage: growing" "${long[@]}" --checkpoint interrupted/state
grep -q '^130 .*pelage resume interrupted/state' interrupt.log || fail "Ctrl-C with a checkpoint: $(cat interrupt.log)"
[ "$(ls interrupted)" = state ] || fail "Ctrl-C with a checkpoint left: $(ls interrupted)"

rm interrupted/state
interrupt "pelage: running the cells" map gray-scott --x F=0.01:0.07 --y k=0.045:0.07 --until 1e9 -o interrupted/map.png
grep -q '^130 .*pelage: error: interrupted' interrupt.log || fail "Ctrl-C in map: $(cat interrupt.log)"
interrupt "pelage: making the pictures" gallery turing --size 0.03 -o interrupted/gallery
grep -q '^130 .*pelage: error: interrupted' interrupt.log || fail "Ctrl-C in gallery: $(cat interrupt.log)"
[ -z "$(find interrupted -type f)" ] || fail "Ctrl-C left files: $(find interrupted -type f)"

# What a gallery has made before Ctrl-C is on its page.
printf 'shape = "builtin:sphere?n=162"\n[stage]\nmodel = "turing"\nsteps = 1\nsize = 0.5\n' >brief.toml
printf 'shape = "builtin:sphere?n=162"\n[stage]\nmodel = "turing"\nsize = 0.03\nuntil = 1e9\nstationary = 0\n' >endless.toml
interrupt "pelage: making the pictures" gallery --recipes --shape $sphere --picture-size 64 --threads 1 -o interrupted/page brief.toml endless.toml
grep -q '^130 .*pelage: error: interrupted; .*index.html shows the 1 of 2 pictures' interrupt.log || fail "Ctrl-C in gallery: $(cat interrupt.log)"
grep -q 'brief-sphere.png' interrupted/page/index.html && grep -q 'interrupted before it was made' interrupted/page/index.html ||
  fail "an interrupted gallery has no page of what it made"
rm -r interrupted/page

# --- a surface that moves while the coat grows -----------------------------------------------------------------
moving=(grow $sphere --size 0.5 --steps 4 --every 2 --detail 0)
succeed "${moving[@]}" --fair --panels panels.png --picture-size 64 -o moved.ply --json
json 'd["fairing"]["steps"] <= 2 and [f["path"] for f in d["files"]] == ["moved.ply", "panels.png"]'
python3 -c "import struct; d=open('panels.png','rb').read(); assert struct.unpack('>I', d[16:20]) == (4 * 64 + 3 * 8,)" ||
  fail "panels.png does not hold four pictures"
succeed "${moving[@]}" --fair=paper --growth 1e-4 --motion physical --quiet -o moved.ply
expect 2 'unknown method of fairing "papr"; did you mean "paper"' "${moving[@]}" --fair=papr -o moved.ply
expect 2 'unknown mode of motion "phisical"; did you mean "physical"' "${moving[@]}" --motion phisical -o moved.ply
expect 2 'with a growth of 1 until time 2000 .*10 times; lower one of them' "${moving[@]}" --growth 1 -o moved.ply
expect 2 '--panels shows what --fair does; give it too' "${moving[@]}" --panels panels.png

# --- fair, compare ---------------------------------------------------------------------------------------------
succeed fair builtin:cube?n=600 -o faired.ply,faired.obj --json
is_json stdout
json 'd["method"] == "guided" and d["files"] == ["faired.ply", "faired.obj"]'
succeed fair faired.ply --method paper --steps 1 --quiet -o again.ply
[ ! -s stdout ] || fail "--quiet is not quiet: $(cat stdout)"
succeed grow $sphere "${quick[@]}" --model witkin-kass-stripes -o painted.ply
succeed fair painted.ply --attribute color -o even.ply --json
json 'd["attribute"] == "color" and d["steps"] >= 1 and d["files"] == ["even.ply"]'
succeed fair moved.ply --attribute b --method isotropic --steps 2 --tau 1 -o even.ply
grep -q '^smoothed *2 steps' stdout || fail "fair --attribute does not say what it did"
expect 2 'unknown attribute "colour"; did you mean "color"' fair moved.ply --attribute colour -o even.ply
expect 2 '--attribute excludes --slide|--slide excludes --attribute' fair moved.ply --attribute b --slide -o even.ply
succeed fair builtin:plane?n=400 --method isotropic --steps 1 --slide -q -o slid.ply
succeed compare again.ply faired.ply --json
json 'd["normals"]["flipped"] == 0 and d["distance"] < 0.1'
succeed compare faired.ply builtin:sphere?n=642
grep -q 'not compared' stdout || fail "compare: different triangles are not mentioned: $(cat stdout)"
expect 2 'unknown method "gided"; did you mean "guided"' fair builtin:cube?n=600 --method gided -o x.ply
expect 2 'noise -1 is out of range' fair builtin:cube?n=600 --noise -1 -o x.ply
expect 3 'missing.ply: .*' compare missing.ply faired.ply
expect 5 'nowhere/x.ply: .*' fair builtin:cube?n=600 -o nowhere/x.ply

# --- attributes of the mesh in formulas ------------------------------------------------------------------------
printf '%s\n' 'ply' 'format ascii 1.0' 'element vertex 4' 'property float x' 'property float y' 'property float z' \
  'property float mask' 'element face 4' 'property list uchar int vertex_indices' 'end_header' '0 0 0 0' '1 0 0 1' \
  '0 1 0 0' '0 0 1 1' '3 0 2 1' '3 0 1 3' '3 0 3 2' '3 1 2 3' >painted.ply
sed 's/^rate = "s\*(16 - a\*b)"/rate = "s*(16 - a*b)*(1 + 0.1*attribute(mask))"/' "$source/models/turing.toml" >painted.toml
succeed grow painted.ply --model painted.toml --size 0.5 --steps 2 -o painted.glb
expect 2 'painted.toml:[0-9]*:[0-9]*: the mesh has no vertex attribute "mask"; it has none' \
  grow builtin:cube?n=200 --model painted.toml --size 0.5 --steps 2 -o painted.glb

[ $failures -eq 0 ] && echo "all right"
exit $((failures > 0))

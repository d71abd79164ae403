#!/usr/bin/env bash
# Files say what made them, explain prints it, again repeats it or names what differs, and a hostile file cannot make it
# read or write elsewhere. Usage: SOURCE BINARY
set -uo pipefail
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
here=$(cd "$(dirname "$0")" && pwd)
work=$2/provenance_test
rm -rf "$work" && mkdir -p "$work/home" && cd "$work/home" || exit 1
export TMPDIR=$work/tmp && mkdir "$TMPDIR"
failures=0
fail() { echo "FAILED: $1"; failures=$((failures + 1)); }

# expect CODE WORDS ARGUMENTS
expect() {
  local code=$1 words=$2
  shift 2
  "$pelage" "$@" >../log 2>&1 </dev/null
  local was=$?
  [ $was = "$code" ] || { fail "$*: exit code $was instead of $code"; tail -2 ../log; }
  grep -q -- "$words" ../log || { fail "$*: no \"$words\" in what it says"; tail -2 ../log; }
}

# --- the same account in every format, found by means of its own ------------------------------------------------------
"$pelage" grow 'builtin:sphere?n=162' -q -o shape.ply --size 0.3 --steps 1 --no-record || fail "a shape"
printf '[[stage]]\nname = "spots"\nmodel = "turing"\nsize = 0.3\nsteps = 5\n' >mine.toml
coat=(grow shape.ply --recipe mine.toml --seed 7 --quiet)
"$pelage" "${coat[@]}" -o coat.glb,coat.ply,coat.obj,coat.off,coat.vtp,coat.3mf --picture coat.png --picture-size 64 \
  --lines coat.svg,coat.dxf 2>/dev/null || fail "a coat"
"$pelage" "${coat[@]}" --picture coat.exr --picture-size 32 || fail "a coat as EXR"
"$pelage" "${coat[@]}" -o packed.glb --compress || fail "a packed coat"
python3 "$here/provenance.py" shape.ply mine.toml coat.{glb,ply,obj,off,vtp,3mf,svg,dxf,png,exr} packed.glb ||
  fail "the records"
[ "$(python3 "$here/provenance.py" --without shape.ply)" = none ] || fail "--no-record leaves a record"
for extension in ply obj off vtp 3mf svg dxf png; do
  cmp -s <("$pelage" explain coat.glb) <("$pelage" explain coat.$extension) || fail "$extension says something else than glb"
done
expect 0 'seed  *7' explain coat.png
expect 0 'sha256' explain coat.png
"$pelage" explain coat.glb --text mine.toml | cmp -s - mine.toml || fail "the recipe does not come out as it went in"
expect 0 '"version"' explain coat.ply --json
expect 3 'does not say' explain shape.ply
expect 3 'no room' explain mine.toml
"$pelage" grow builtin:animal?n=500 --recipe leopard --steps 2 -q -o built-in.ply &&
  "$pelage" explain built-in.ply --text leopard | cmp -s - "$1/recipes/leopard.toml" || fail "the text of a built-in recipe"

# --- what does not decide a byte leaves no trace ------------------------------------------------------------------------
"$pelage" "${coat[@]}" -o coat.ply --no-record --force && mv coat.ply bare.ply
mkdir elsewhere && "$pelage" "${coat[@]}" -o elsewhere/other.ply --threads 1 --checkpoint elsewhere/state &&
  "$pelage" "${coat[@]}" -o coat.ply --json >/dev/null && cmp -s coat.ply elsewhere/other.ply || fail "names of outputs matter"
(cd elsewhere && "$pelage" grow "$work/home/shape.ply" --recipe "$work/home/mine.toml" --seed 7 -q -o here.ply) &&
  cmp -s elsewhere/here.ply coat.ply || fail "folders above leave a trace"
python3 "$here/provenance.py" --same-but-for-record coat.ply bare.ply || fail "the record changes the coat"
"$pelage" "${coat[@]}" -o coat.glb,coat.ply,coat.obj,coat.off,coat.vtp,coat.3mf --picture coat.png --picture-size 64 \
  --lines coat.svg,coat.dxf 2>/dev/null || fail "the coat anew"

# --- again -----------------------------------------------------------------------------------------------------------------
for extension in glb svg png exr; do expect 0 '^same' again coat.$extension; done
expect 0 '^same' again packed.glb
expect 0 '^same' again coat.glb -o second.glb
cmp -s coat.glb second.glb || fail "again -o is not the same"
expect 0 '^same' again built-in.ply
(cd elsewhere && "$pelage" again ../coat.ply --inputs .. -q) || fail "again from another folder"
expect 2 'an input itself' again coat.glb -o coat.glb
expect 2 'the same format' again coat.glb -o coat.ply
for command in 'fair shape.ply' 'field shape.ply' 'unwrap shape.ply' 'cells shape.ply -n 60'; do
  "$pelage" $command -o other.ply >/dev/null 2>&1 || fail "$command"
  expect 0 '^same' again other.ply
done
"$pelage" grow 'builtin:tile?n=32' --size 0.3 --steps 5 -o tile.png -q && expect 0 '^same' again tile.png
"$pelage" grid horseshoe --nodes 21x9 -o shoe.vts -q && expect 0 '^same' again shoe.vts

# What differs is named.
python3 "$here/provenance.py" --change coat.ply seed.ply '"--seed=7"' '"--seed=8"'
expect 1 'seed of stage spots was\|seed was 7 and is 8' again seed.ply
expect 1 'the bytes' again seed.ply
python3 "$here/provenance.py" --change coat.ply version.ply '"version":"' '"version":"9.'
expect 0 'the version was 9' again version.ply
expect 0 '^same' again version.ply
printf 'x' | dd of=coat.glb bs=1 seek=$(($(wc -c <coat.glb) - 99)) conv=notrunc status=none
expect 1 'the first other one is number' again coat.glb
cp shape.ply kept.ply
sed -i 's/written by pelage/written by someone/' shape.ply
expect 1 'the input shape.ply is another' again coat.png
mv shape.ply away.ply
expect 3 'is not here' again coat.png
cp kept.ply shape.ply
expect 0 '^same' again coat.png

# --- hostile files: nothing is read or written elsewhere ----------------------------------------------------------------------
touch ../before
# hostile NAME COMMAND [INPUTS]: a file whose record holds these
hostile() { python3 "$here/provenance.py" --forge "$1" "$2" "${3:-[]}"; }
hostile a.ply '["grow", "builtin:sphere?n=162", "--output=../stolen.ply"]'
expect 2 'not as this program writes it' again a.ply
hostile a.ply '["grow", "builtin:sphere?n=162", "--steps=1", "--output=*/../../stolen.ply"]'
expect 2 'not as this program writes it' again a.ply
for option in --checkpoint=stolen --resume=coat.ply --force --no-record --threads=1 --maps=stolen --patch-images=stolen; do
  hostile a.ply '["grow", "builtin:sphere?n=162", "--steps=1", "--output=*.ply", "'$option'"]'
  expect 2 'not as this program writes it' again a.ply
done
hostile a.ply '["models", "--new", "stolen"]'
expect 2 '"models" does not' again a.ply
hostile a.ply '["gallery", "--output=*"]'
expect 2 '"gallery" does not' again a.ply
hostile a.ply '["again", "coat.ply", "--output=*.ply"]'
expect 2 '"again" does not' again a.ply
hostile a.ply '["--help"]'
expect 2 'does not' again a.ply
hostile a.ply '["grow", "--help"]'
expect 2 'not as this program' again a.ply
hostile a.ply '[]'
expect 2 'no command' again a.ply
cp kept.ply ../secret.ply
ln -s ../secret.ply link.ply
for path in ../secret.ply "$work/secret.ply" link.ply; do
  hostile a.ply '["grow", "'"$path"'", "--size=0.3", "--steps=1", "--output=*.ply"]'
  expect 2 'outside the folder' again a.ply
  hostile a.ply '["grow", "builtin:sphere?n=162", "--texture=t='"$path"'", "--steps=1", "--output=*.ply"]'
  expect 2 'outside the folder\|uv' again a.ply
  hostile a.ply '["grow", "builtin:sphere?n=162", "--steps=1", "--output=*.ply"]' '[{"name": "'"$path"'", "bytes": 1, "sha256": ""}]'
  expect 2 'outside the folder' again a.ply
done
printf '[[texture]]\nname = "t"\nfile = "../secret.png"\n[[stage]]\nmodel = "turing"\n' >reaching.toml
cp coat.png ../secret.png
hostile a.ply '["grow", "shape.ply", "--recipe=reaching.toml", "--steps=1", "--output=*.ply"]'
"$pelage" again a.ply >../log 2>&1 && fail "a recipe reads elsewhere"
hostile a.ply '["grow", "../secret.ply", "--size=0.3", "--steps=1", "--output=*.ply"]'
expect 1 'the bytes' again a.ply --allow-outside
python3 "$here/provenance.py" --forge-text a.ply $'\e]0;title\a'
"$pelage" explain a.ply | grep -q $'[\e\a]' && fail "explain prints control characters"
"$pelage" again a.ply 2>&1 | grep -q $'[\e\a]' && fail "again prints control characters"
found=$(find "$work" -newer ../before -name '*stolen*')
[ -z "$found" ] || fail "written elsewhere: $found"
[ -z "$(ls -A "$TMPDIR")" ] || fail "temporary files are left: $(ls -A "$TMPDIR")"

echo "$failures failures"
[ "$failures" -eq 0 ]

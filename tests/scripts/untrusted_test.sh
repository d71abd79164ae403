#!/usr/bin/env bash
# Files from elsewhere: what they name is read from their own folder alone, unless the user says so, and monsters are
# refused with a message. Usage: SOURCE BINARY
set -euo pipefail
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# refused CODE PATTERN ARGUMENT...: ends with that code and one line of error that holds the pattern.
refused() {
  local code=0 expected=$1 pattern=$2
  shift 2
  "$pelage" "$@" >out 2>err </dev/null || code=$?
  [ "$code" = "$expected" ] || { echo "pelage $*: exit code $code, not $expected"; cat err; exit 1; }
  grep -q "^pelage: error: .*$pattern" err || { echo "pelage $*: no \"$pattern\" in"; cat err; exit 1; }
}

# --- paths ---------------------------------------------------------------------------------------------
mkdir -p secret own/deep elsewhere
"$pelage" grow builtin:tile?n=8 --model turing --size 4px --steps 1 -o secret/image.png >/dev/null 2>&1
"$pelage" unwrap builtin:sphere?n=100 -o secret/shape.obj >/dev/null 2>&1
cp secret/image.png own/deep/image.png
ln -s ../secret/image.png own/link.png
cp secret/shape.obj own/shape.obj
growth="--size 0.5 --steps 1 --force -o out.ply"
recipe() {  # FILE: a recipe that reads this image
  printf '[[texture]]\nname = "age"\nfile = "%s"\n[stage]\nmodel = "turing"\nsize-map = "1 + attribute(age)"\n' "$1" \
    >own/recipe.toml
}
outside="outside the folder of this file; copy it there, or give --allow-outside"
# shellcheck disable=SC2086  # the options are separate words
for file in ../secret/image.png "$work/secret/image.png" link.png deep/../../secret/image.png; do
  recipe "$file"
  refused 2 "own/recipe.toml:3:8: .*$outside" grow own/shape.obj --recipe own/recipe.toml $growth
  "$pelage" grow own/shape.obj --recipe own/recipe.toml --allow-outside $growth >/dev/null 2>&1
done
recipe deep/image.png
# shellcheck disable=SC2086
"$pelage" grow own/shape.obj --recipe own/recipe.toml $growth >/dev/null 2>&1
# What stands on the command line is the user's own word.
# shellcheck disable=SC2086
"$pelage" grow own/shape.obj --model turing --texture age=secret/image.png $growth >/dev/null 2>&1

printf 'shape = "../secret/shape.obj"\n[stage]\nmodel = "turing"\n' >own/shape.toml
refused 2 "own/shape.toml:1:9: .*$outside" grow builtin:sphere -o x.ply --recipe own/shape.toml
printf '[stage]\nmodel = "/secret/model.toml:one"\n' >own/model.toml
refused 2 "own/model.toml:2:9: .*$outside" grow builtin:sphere -o x.ply --recipe own/model.toml
printf '[[thing]]\nshape = "../secret/shape.obj"\n' >own/scene.toml
refused 2 "own/scene.toml:2:9: .*$outside" render own/scene.toml -o out.png
printf '[[thing]]\nshape = "shape.obj"\nrecipe = "../x.toml"\n' >own/scene.toml
refused 2 "own/scene.toml:3:10: .*$outside" render own/scene.toml -o out.png
printf 'outline = {svg = {file = "/etc/passwd"}}\n' >own/region.toml
refused 2 "own/region.toml:1:.*$outside" grid own/region.toml -o out.vts
printf '[[patch]]\nfile = "../secret/a.bpt"\n' >own/patches.toml
refused 2 "own/patches.toml:2:8: .*$outside" check own/patches.toml
# Names are looked for beside the text, wherever the program is started.
cp own/shape.obj elsewhere/near.obj
printf 'shape = "near.obj"\n[stage]\nmodel = "turing"\n' >elsewhere/near.toml
# shellcheck disable=SC2086
"$pelage" grow --recipe elsewhere/near.toml $growth >/dev/null 2>&1

printf 'newmtl red\nKd 1 0 0\n' >secret/red.mtl
printf 'mtllib ../secret/red.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >own/painted.obj
"$pelage" check own/painted.obj | grep -q 'outside the folder.*--allow-outside reads it'
"$pelage" check own/painted.obj --allow-outside | grep -q material_color
! "$pelage" check own/painted.obj | grep -q material_color || exit 1
printf '{"asset":{"version":"2.0"},"buffers":[{"uri":"../secret/red.mtl","byteLength":4}],"bufferViews":[{"buffer":0,"byteLength":4}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]}' >own/a.gltf
refused 3 "$outside" check own/a.gltf
refused 3 "promises more values than the file holds" check own/a.gltf --allow-outside

# --- monsters --------------------------------------------------------------------------------------------
times() { local i; for ((i = 0; i < $2; ++i)); do printf "$1" "$i"; done; }
{ times 'a.' 10000; echo 'a = 1'; } >deep.toml
refused 2 "deep.toml:1: .*64 deep" grow builtin:sphere -o x.ply --recipe deep.toml
{ printf 'a = '; times '[' 100000; } >brackets.toml
refused 2 "brackets.toml:1: .*64 deep" grow builtin:sphere -o x.ply --recipe brackets.toml
times 'k%d=1\n' 80000 >keys.toml
refused 2 "keys.toml:20001: .*20000 keys" grow builtin:sphere -o x.ply --recipe keys.toml
times '[[stage]]\nmodel="turing"\n' 9000 >stages.toml
refused 2 "stages.toml:201:1: a recipe has at most 100 stages" grow builtin:sphere -o x.ply --recipe stages.toml
head -c 2000000 /dev/zero | tr '\0' '#' >long.toml
refused 3 "larger than 1 MB" grow builtin:sphere -o x.ply --recipe long.toml
for words in "grow builtin:sphere --recipe deep.toml -o x.ply" "grow deep.toml -o x.ply" "check deep.toml" \
  "models deep.toml" "render deep.toml -o x.png" "grid deep.toml -o x.vts"; do
  # shellcheck disable=SC2086
  refused 2 "deep.toml:1: .*64 deep" $words
done
{ echo 'name = "m"'; times '[species.u%d]\nrate = "-1"\n' 200; } >species.toml
refused 2 "species.toml:1:1: .*200 species; at most 100" models species.toml
{ printf 'outline = {points = ['; times '[%d, 0], ' 20000; echo ']}'; } >outline.toml
refused 2 "outline.toml:1:.*20000 pieces; at most 10000" grid outline.toml -o x.vts
{ printf '[[thing]]\nshape = "builtin:sphere?n=20000"\nplaces = ['; times '{at=[%d,0,0]},' 1000; echo ']'; } >scene.toml
refused 2 "scene.toml:1:1: .*has to stay below 20000000" render scene.toml -o x.png

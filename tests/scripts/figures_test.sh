#!/bin/bash
# The page of the papers' figures: one cheap figure is made, what is wrong is said before any work, docs/figures.md has a row
# for every figure, and docs/gallery.md a picture of every recipe and model: figures_test.sh ROOT BUILD
set -u
root=$(realpath "$1")
pelage=$(realpath "$2")/bin/pelage
mkdir -p "$2/test-files/figures"
cd "$2/test-files/figures" || exit 1
rm -rf ./*
fail() {
  echo "$*" >&2
  exit 1
}

# All commands of all papers are read before the first one runs.
"$pelage" figures -q -o page turk-1 || fail "figure 1 of Turk's paper is not made"
[ -s page/turk-1.png ] || fail "there is no picture"
grep -q '<img src="turk-1.png"' page/index.html || fail "the page does not show it"
grep -q 'pelage grow builtin:line?n=60' page/index.html || fail "the page does not say how it is made"
grep -q 'turk-2' page/index.html && fail "the page shows what was not asked for"
[ -z "$(find . -name '*.pelage-*')" ] || fail "something is left"

"$pelage" again -q page/turk-1.png || fail "the picture cannot be made again by its record"

"$pelage" figures -o other turk-77 2>said && fail "an unknown figure is made"
grep -q 'unknown figure "turk-77"; did you mean "turk-7"' said || fail "$(cat said)"
[ ! -e other ] || fail "a folder was made for nothing"

for id in $("$pelage" figures --json | python3 -c 'import json, sys; print(*(f["figure"] for f in json.load(sys.stdin)["figures"]))'); do
  grep -q "^| \`$id\` |" "$root/docs/figures.md" || fail "docs/figures.md has no row for $id"
done
for list in recipes models; do
  for name in $("$pelage" $list --json | python3 -c 'import json, sys; print(*(entry["name"] for entry in json.load(sys.stdin)))'); do
    picture=gallery/$list/${name//:/-}-animal.png
    grep -q "($picture)<br>\`$name\`" "$root/docs/gallery.md" && [ -s "$root/docs/$picture" ] ||
      fail "docs/gallery.md has no picture of $name: python3 tools/gallery_page.py"
  done
done
exit 0

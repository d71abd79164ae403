#!/usr/bin/env bash
# Every `pelage ...` line of the README does what it says: runs, and writes the files that it names; in few steps and with
# small pictures, which is for time alone. Every line of C++ is one of an example, which the tests compile and run.
# Usage: SOURCE BINARY
set -uo pipefail
source=$1
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$2/readme_test
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
failures=0

# The README's cow, scan and low mesh: any meshes of these names, the cow with some uv.
"$pelage" grow builtin:animal?n=600 --steps 0 --detail 0 -o bare.obj,scan.ply >log 2>&1 || { cat log; exit 1; }
awk '/^v / { print; print "vt", $2 / 4 + 0.5, $3 / 4 + 0.5; next }
     /^vn/ { next }
     /^f / { for (i = 2; i <= NF; ++i) { split($i, a, "/"); $i = a[1] "/" a[1] } }
     { print }' bare.obj >cow.obj
cp bare.obj low.obj

run_line() {
  local -a words quick=()
  read -ra words <<<"$1"
  [[ $1 == 'pelage grow'* ]] && quick+=(--steps 5 --detail 0)
  [[ $1 == *' --picture '* && $1 != 'pelage unwrap'* ]] && quick+=(--picture-size 64)
  "$pelage" "${words[@]:1}" "${quick[@]}" >log 2>&1 </dev/null || { echo "FAILED: $1"; tail -3 log; failures=$((failures + 1)); return; }
  local file
  for file in $(tr ', ' '\n' <<<"$1" | grep -E '^[a-z]+\.(glb|ply|obj|png|html)$'); do
    [ -s "$file" ] || { echo "FAILED: $1: no $file"; failures=$((failures + 1)); }
  done
}

lines=$(sed -n 's/^    \(pelage [^#]*\).*/\1/p' "$source/README.md" | sed 's/ *$//')
[ "$(wc -l <<<"$lines")" -ge 4 ] || { echo "FAILED: the README's examples were not found"; exit 1; }
while read -r line; do
  case "$line" in
    'pelage verify' | 'pelage gallery'* | 'pelage map'*) ;;  # minutes; tests of their own
    *.mp4*) if type -P ffmpeg >/dev/null; then run_line "$line"; else echo "left out without ffmpeg: $line"; fi ;;
    *) run_line "$line" ;;
  esac
done <<<"$lines"
lines=$(sed -n '/^## From C++/,/^## When/s/^    \(.*;\)$/\1/p' "$source/README.md")
[ -n "$lines" ] || { echo "FAILED: the README's lines of C++ were not found"; exit 1; }
while read -r line; do
  grep -qF -- "$line" "$source"/examples/*.cpp || { echo "FAILED: no example has: $line"; failures=$((failures + 1)); }
done <<<"$lines"
echo "$failures failures"
[ "$failures" -eq 0 ]

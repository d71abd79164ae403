#!/usr/bin/env bash
# The bytes of small runs are those of the table of this architecture, tests/hashes/ARCHITECTURE.txt.
# Usage: SOURCE BINARY [--update]: writes the table instead (CONTRIBUTING.md says when)
set -uo pipefail
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
table=$1/tests/hashes/$(uname -m).txt
work=$2/hashes_test
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
failures=0

# run NAME FILE ARGUMENTS: the hash of FILE, which the command writes. Without records, which name the version.
run() {
  local name=$1 file=$2
  shift 2
  "$pelage" "$@" --no-record >log 2>&1 </dev/null || { echo "FAILED: $name does not run: $(tail -1 log)"; exit 1; }
  printf '%-12s %s\n' "$name" "$(sha256sum <"$file" | cut -d' ' -f1)" >>hashes
}

sphere=(grow 'builtin:sphere?n=642' --size 0.25 --steps 30)
run rkc2 a.ply "${sphere[@]}" --stepper rkc2 -o a.ply
run sbdf2 b.ply "${sphere[@]}" --stepper sbdf2 -o b.ply
run loop c.ply "${sphere[@]}" --method loop -o c.ply
run linear d.ply "${sphere[@]}" --method linear --flat -o d.ply
run animal e.glb grow 'builtin:animal?n=2000' --size 0.1 --steps 20 -o e.glb
run recipe f.ply grow 'builtin:animal?n=1500' --recipe leopard --steps 10 -o f.ply
run cells g.ply grow 'builtin:sphere?n=642' --method cells --cells 600 --size 0.25 --steps 20 -o g.ply
run tile h.vti grow 'builtin:tile?n=64' --size 0.2 --steps 20 -o h.vti
run region i.vts grid horseshoe --nodes 31x11 -o i.vts
run solid j.vtu grow 'builtin:sphere?n=642' --solid --size 0.3 --steps 5 -o j.vtu
run motion k.ply grow 'builtin:sphere?n=642' --size 0.25 --growth 0.001 --steps 20 -o k.ply
run fair l.ply fair 'builtin:knot?n=1500' --noise 0.05 -o l.ply
run unwrap m.obj unwrap 'builtin:torus?n=1000' -o m.obj
run picture n.exr grow 'builtin:sphere?n=642' --size 0.25 --steps 10 --picture n.exr --picture-size 48
run texture o.png grow 'builtin:tile?n=48' --size 0.2 --steps 10 -o o.png

if [ "${3:-}" = --update ]; then
  mkdir -p "$(dirname "$table")" && cp hashes "$table" && echo "wrote $table"
  exit 0
fi
[ -e "$table" ] || { echo "there is no table for $(uname -m): nothing was compared"; exit 0; }
# Without fused multiplications the C library rounds sines and others differently.
grep -q '\bfma\b' /proc/cpuinfo || [ "$(uname -m)" != x86_64 ] || { echo "this processor has no FMA: nothing was compared"; exit 0; }
while read -r name hash; do
  was=$(awk -v name="$name" '$1 == name { print $2 }' "$table")
  [ "$was" = "$hash" ] || { echo "FAILED: $name has other bytes: $hash, where the table has ${was:-nothing}"; failures=$((failures + 1)); }
done <hashes
[ "$(wc -l <hashes)" = "$(wc -l <"$table")" ] || { echo "FAILED: the table has runs that are no longer there"; failures=$((failures + 1)); }
[ "$failures" -eq 0 ] || echo "where that is meant: bash tests/scripts/hashes_test.sh SOURCE BINARY --update, and say why in the commit"
echo "$failures failures"
[ "$failures" -eq 0 ]

#!/usr/bin/env bash
# Same input, same bytes: for one and several threads, and for Debug and Release. Usage: SOURCE BINARY
# The debug program is compared when it has been built since the last change (cmake --build --preset debug --target pelage_cli).
set -euo pipefail
source=$1
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$2/same_bits_test
rm -rf "$work" && mkdir -p "$work" && cd "$work"

# grow PROGRAM NAME THREADS ARGUMENTS...
grow() {
  local program=$1 name=$2 threads=$3
  shift 3
  "$program" grow "$@" --threads "$threads" -o "$name.ply,$name.glb" >"$name.log" 2>&1 || { cat "$name.log"; exit 1; }
}

same() {
  for extension in ply glb; do
    cmp "$1.$extension" "$2.$extension" || { echo "FAILED: $1 and $2 differ ($3)"; exit 1; }
  done
}

# The animal, a mesh with a boundary, and the two other steppers; enough unknowns for several chunks per loop.
cases=("builtin:animal?n=3000 --size 0.08 --steps 40"
  "builtin:plane?n=2500 --size 0.2 --steps 40 --model gray-scott"
  "builtin:sphere?n=642 --size 0.3 --steps 10 --stepper paper"
  "builtin:knot?n=3000 --size 0.3 --steps 10 --stepper explicit --step 0.01 --flat")
debug=$source/build/debug/bin/pelage
if [ -x "$debug" ]; then
  changed=$(cd "$source" && find src apps models recipes -newer "$debug" | sed -n 1p)
  [ -z "$changed" ] || { echo "the debug program is older than $changed: not compared"; debug=; }
fi
for i in "${!cases[@]}"; do
  read -ra arguments <<<"${cases[$i]}"
  grow "$pelage" one$i 1 "${arguments[@]}"
  grow "$pelage" two$i 2 "${arguments[@]}"
  same one$i two$i "one and two threads: ${cases[$i]}"
  if [ -x "$debug" ]; then
    grow "$debug" debug$i 2 "${arguments[@]}"
    same one$i debug$i "Release and Debug: ${cases[$i]}"
  fi
done
[ -x "$debug" ] && echo "threads and debug: the same bytes" || echo "threads: the same bytes; no debug build was compared"

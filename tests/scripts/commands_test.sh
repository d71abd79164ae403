#!/usr/bin/env bash
# The README's two commands, from any folder and in a checkout with a space in its name, with stand-ins for apt, cmake and
# ctest: which steps they take, what they say without root, and whose exit code they end with. Usage: SOURCE BINARY
set -uo pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

checkout="$work/a checkout"
mkdir -p "$checkout/build/release/bin" "$work/bin"
cp -r "$source/tools" "$source/.ci" "$checkout"

# stand_in FILE [COMMANDS]: a program that notes its name and arguments, then runs the commands.
stand_in() {
  printf '#!/bin/sh\necho "$(basename "$0") $*" >>"$STEPS"\n%s\n' "${2:-}" >"$1"
  chmod +x "$1"
}
export STEPS=$work/steps PATH="$work/bin:$PATH"
stand_in "$work/bin/cmake"
stand_in "$work/bin/ctest" 'echo "100% tests passed"; exit 8'
stand_in "$work/bin/apt-get"
stand_in "$work/bin/sudo" '"$@"'
stand_in "$work/bin/id" 'echo 1000'
stand_in "$checkout/build/release/bin/pelage"
installed() { stand_in "$work/bin/dpkg-query" "$1"; }

# run COMMAND...: from a folder elsewhere; leaves stdout, stderr, exit code and the steps other than queries.
run() {
  : >"$STEPS"
  (cd / && "$@") >"$work/stdout" 2>"$work/stderr"
  code=$?
  steps=$(grep -vE '^(dpkg-query|id) ' "$STEPS")
}
expect_steps() {
  local expected
  expected=$(printf '%s\n' "$@")
  [ "$steps" = "$expected" ] || fail "expected the steps"$'\n'"$expected"$'\n'"and got"$'\n'"$steps"
}

installed 'echo "install ok installed"'
run env JOBS=3 sh "$checkout/tools/test.sh"
[ $code -eq 8 ] || fail "test.sh ends with $code instead of ctest's 8"
[ "$(tail -n 1 "$work/stdout")" = "100% tests passed" ] || fail "test.sh does not end with ctest's lines"
test_steps=("cmake --preset release -DPELAGE_TESTS=ON -DPELAGE_BENCHMARKS=OFF -DPELAGE_PYTHON=ON -DPython_EXECUTABLE=/usr/bin/python3" "cmake --build --preset release --parallel 3"
  "ctest --preset release --parallel 3")
expect_steps "${test_steps[@]}"
run env JOBS=3 CDPATH=/usr "$checkout/.ci/run"
[ $code -eq 8 ] || fail ".ci/run ends with $code instead of ctest's 8"
expect_steps "${test_steps[@]}"
run env JOBS= sh "$checkout/tools/test.sh"
grep -q -- "--parallel $(nproc)" <<<"$steps" || fail "without JOBS not all cores are used: $steps"

run env JOBS=1 sh "$checkout/tools/demo.sh"
[ $code -eq 0 ] || fail "demo.sh ends with $code"
expect_steps "cmake --preset release -DPELAGE_TESTS=OFF -DPELAGE_BENCHMARKS=OFF" \
  "cmake --build --preset release --parallel 1" \
  "pelage grow --recipe demo -o out/demo.glb,out/demo.ply --picture out/demo.png"
[ -d "$checkout/out" ] || fail "demo.sh made no folder out in the checkout"

# A step that fails is the last one, and its exit code the command's.
stand_in "$work/bin/cmake" 'exit 5'
run sh "$checkout/tools/test.sh"
[ $code -eq 5 ] && [ "$(wc -l <<<"$steps")" -eq 1 ] || fail "test.sh went on after a fault ($code): $steps"

# What is missing is installed, by root alone.
installed 'case "$*" in *libosd-dev*) exit 1 ;; *) echo "install ok installed" ;; esac'
run sh "$checkout/tools/setup.sh"
expect_steps "sudo apt-get update -q" "apt-get update -q" \
  "sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends libosd-dev" \
  "apt-get install -y -q --no-install-recommends libosd-dev"
rm "$work/bin/sudo"
if ! command -v sudo >/dev/null; then
  run sh "$checkout/tools/demo.sh"
  [ $code -eq 1 ] && [ -z "$steps" ] || fail "without root demo.sh went on ($code): $steps"
  grep -qx "setup: as root, run: apt-get install libosd-dev" "$work/stderr" || fail "without root: $(cat "$work/stderr")"
fi

# Interrupted, the set-up leaves no file behind.
mkdir "$work/tmp"
stand_in "$work/bin/id" 'echo 0'
stand_in "$work/bin/apt-get" 'kill -INT $PPID; sleep 1'
run env TMPDIR="$work/tmp" sh "$checkout/tools/setup.sh"
[ $code -eq 130 ] && [ -z "$(ls "$work/tmp")" ] || fail "interrupted, setup.sh ends with $code and leaves $(ls "$work/tmp")"

[ $failures -eq 0 ] && echo "all right"
exit $((failures > 0))

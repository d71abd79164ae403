#!/usr/bin/env bash
# Readers, recipes, threads and linear systems under sanitizers, in the builds that `make sanitizers` makes beside this one;
# skipped where there are none. All tests: make asan, make tsan. Usage: SOURCE BINARY
set -euo pipefail
build=$1/build

run() {  # PRESET TEST...
  local preset=$1 test
  shift
  for test; do
    "$build/$preset/bin/${test}_test" --gtest_brief=1
    tests=$((${tests:-0} + 1))
  done
}
[[ -d $build/asan-quick/bin && -d $build/tsan-quick/bin ]] || { echo "skipped: not built"; exit 77; }
run asan-quick base linalg recipe io
run tsan-quick base linalg
echo "$tests programs are clean"

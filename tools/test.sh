#!/bin/sh
# From a bare Debian 12 to the closing lines and the exit code of ctest: installs what is missing, builds everything, and
# a part of it again under sanitizers, and runs every test. JOBS=N in the environment: so many compilers, and then tests,
# at a time (all cores).
set -eu
CDPATH="" cd -- "$(dirname -- "$0")/.."
jobs=${JOBS:-$(nproc)}
sh tools/setup.sh
cmake --preset release -DPELAGE_TESTS=ON -DPELAGE_BENCHMARKS=OFF
cmake --build --preset release --parallel "$jobs"
for sanitizer in asan-quick tsan-quick; do  # tests/scripts/sanitizers_test.sh runs what they build
  cmake --preset $sanitizer
  cmake --build --preset $sanitizer --parallel "$jobs"
done
exec ctest --preset release --parallel "$jobs"

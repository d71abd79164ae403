#!/bin/sh
# From a bare Debian 12 to the closing lines and the exit code of ctest: installs what is missing, builds everything and
# runs every test. JOBS=N in the environment: so many compilers, and then tests, at a time (all cores).
set -eu
CDPATH="" cd -- "$(dirname -- "$0")/.."
jobs=${JOBS:-$(nproc)}
# For the studio's page and its test; where node comes from elsewhere, it brings npm along.
page=chromium
command -v npm >/dev/null || page="$page nodejs npm"
python="pybind11-dev python3-dev python3-numpy python3-pytest python3-setuptools python3-wheel python3-venv mypy"
# shellcheck disable=SC2086  # the words of the lists are separate arguments
sh tools/setup.sh $page $python
# The system's own Python, whose packages these are.
cmake --preset release -DPELAGE_TESTS=ON -DPELAGE_BENCHMARKS=OFF -DPELAGE_PYTHON=ON -DPython_EXECUTABLE=/usr/bin/python3
cmake --build --preset release --parallel "$jobs"
exec ctest --preset release --parallel "$jobs"

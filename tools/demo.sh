#!/bin/sh
# From a bare Debian 12 to a coat on the built-in animal: installs what is missing, builds the program, and grows
# out/demo.glb, out/demo.ply and out/demo.png. JOBS=N in the environment: so many compilers at a time (all cores).
set -eu
CDPATH="" cd -- "$(dirname -- "$0")/.."
sh tools/setup.sh
cmake --preset release -DPELAGE_TESTS=OFF -DPELAGE_BENCHMARKS=OFF
cmake --build --preset release --parallel "${JOBS:-$(nproc)}"
mkdir -p out
echo "demo: growing a coat on the built-in animal"
exec build/release/bin/pelage grow --recipe demo -o out/demo.glb,out/demo.ply --picture out/demo.png

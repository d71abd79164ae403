#!/bin/sh
# From a bare Debian 12 to the studio's engine for browsers: installs what is missing and makes pelage-engine.js,
# pelage-engine.wasm and engine-worker.js in build/wasm/bin. JOBS=N in the environment: so many compilers at a time (all cores).
set -eu
CDPATH="" cd -- "$(dirname -- "$0")/.."
sh tools/setup.sh emscripten librange-v3-dev libfast-float-dev
cmake --preset wasm
cmake --build --preset wasm --parallel "${JOBS:-$(nproc)}"

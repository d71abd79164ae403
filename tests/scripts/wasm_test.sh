#!/usr/bin/env bash
# The studio's engine as WebAssembly (tools/wasm.sh) grows what the native program grows: numbers, files and fields of
# small runs, and the replies of both engines to the same requests.
# Usage: SOURCE BINARY
set -uo pipefail
wasm=$1/build/wasm/bin
command -v node >/dev/null || { echo "there is no node: nothing was compared"; exit 77; }
[ -e "$wasm/pelage-engine.wasm" ] || { echo "no $wasm/pelage-engine.wasm: nothing was compared"; exit 77; }
node "$1/tests/wasm/compare.mjs" "$2/bin/wasm_cases" "$wasm" || exit
node "$1/tests/wasm/engines.mjs" "$2/bin/pelage" "$wasm"

#!/bin/sh
# Builds the page of the studio (docs/studio.md) into DIR, or where `pelage studio` of the release looks for it; with the
# engine for browsers in it where tools/wasm.sh has made one, so that DIR works on any file server. Installs what is
# missing. Usage: studio.sh [DIR]
set -eu
page=$(realpath -m -- "${1:-$(dirname -- "$0")/../build/release/share/pelage/studio}")
CDPATH="" cd -- "$(dirname -- "$0")/.."
# Where node comes from elsewhere, it brings npm along.
command -v npm >/dev/null || sh tools/setup.sh nodejs npm
cd studio
[ node_modules/.package-lock.json -nt package-lock.json ] || npm ci --no-audit --no-fund --loglevel=error
npm run --silent build -- --outdir="$page"
if [ -e ../build/wasm/bin/pelage-engine.wasm ]; then
  cp ../build/wasm/bin/pelage-engine.js ../build/wasm/bin/pelage-engine.wasm ../build/wasm/bin/engine-worker.js "$page"
fi
echo "the page is in $page"

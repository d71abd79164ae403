#!/bin/sh
# Builds the site (docs/site.md) into DIR, or out/site: pages of all docs, gallery, figures, reference, and the studio, with
# the engine for browsers in it where tools/wasm.sh has made one. Any file server shows it, in any place of it. Needs the
# program (make build; PELAGE names another one); installs what else is missing. Usage: site.sh [DIR]
set -eu
site=$(realpath -m -- "${1:-$(dirname -- "$0")/../out/site}")
CDPATH="" cd -- "$(dirname -- "$0")/.."
pelage=$(realpath -m -- "${PELAGE:-build/release/bin/pelage}")
[ -x "$pelage" ] || { echo "site: there is no $pelage: make build makes it" >&2; exit 1; }
# What an earlier site had and this one has not must not stay; a folder of something else is left alone.
if [ -d "$site" ] && [ ! -e "$site/studio/index.html" ] && [ -n "$(ls -A "$site")" ]; then
  echo "site: $site holds something else than a site: name another folder" >&2
  exit 1
fi
rm -rf -- "$site"
sh tools/studio.sh "$site/studio"
cd site
[ node_modules/.package-lock.json -nt package-lock.json ] || npm ci --no-audit --no-fund --loglevel=error
node build.mjs "$site" "$pelage"
echo "the site is in $site"

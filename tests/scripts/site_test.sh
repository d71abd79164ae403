#!/usr/bin/env bash
# The site (docs/site.md): builds it, opens its pages in a browser that reaches nothing but one folder of one file server, and
# breaks links to see that the build names them. SITE_PAGES=all: accessibility of every page, not only of all written by hand and
# some of each kind that is generated. Usage: SOURCE BINARY
set -euo pipefail
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
for tool in npm chromium; do
  command -v $tool >/dev/null || { echo "there is no $tool: nothing was tested"; exit 77; }
done
site=$2/site_test
cd "$1"
PELAGE=$pelage sh tools/site.sh "$site"
SITE=$site CHROMIUM=$(command -v chromium) node --test tests/site/check.test.mjs tests/site/site.test.mjs
# A folder of something else is left alone.
mkdir -p "$site-other" && echo mine >"$site-other/mine"
if PELAGE=$pelage sh tools/site.sh "$site-other" 2>/dev/null || [ "$(cat "$site-other/mine")" != mine ]; then
  echo "FAILED: a folder of something else was emptied"
  exit 1
fi
rm -r "$site" "$site-other"

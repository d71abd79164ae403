#!/usr/bin/env bash
# The page of the studio: its types, its parts by themselves, and a part of the journey through it in a browser, on the real
# engine; all of the journey with JOURNEY=. (make test-page), six minutes. Usage: SOURCE BINARY
set -euo pipefail
pelage=$2/bin/pelage page=$2/share/pelage/studio
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
for tool in npm chromium; do
  command -v $tool >/dev/null || { echo "there is no $tool: nothing was tested"; exit 77; }
done
sh "$1/tools/studio.sh" "$page"
cd "$1"
node --test tests/studio/unit.test.mjs
PELAGE=$pelage PAGE=$page CHROMIUM=$(command -v chromium) node --test \
  --test-name-pattern="${JOURNEY:-a parameter moves|what the page exports as text}" tests/studio/journey.test.mjs

#!/usr/bin/env bash
# The server of the studio: whom it answers, what it bears. Usage: SOURCE BINARY
set -euo pipefail
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$2/studio_test
rm -rf "$work" && mkdir -p "$work"
python3 "$1/tests/scripts/studio_server.py" "$pelage" "$work"

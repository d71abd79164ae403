#!/usr/bin/env bash
# What users of other programs met, and what they may expect here; see cases.py. Usage: SOURCE BINARY
set -uo pipefail
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$2/cases_test
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
exec python3 "$1/tests/scripts/cases.py" "$pelage"

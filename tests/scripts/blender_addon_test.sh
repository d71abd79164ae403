#!/usr/bin/env bash
# What of the Blender add-on needs no Blender: its zip, its edits of recipes, and the program as its process. The rest is
# tested in Blender by tests/clients/run.sh. Usage: SOURCE BINARY
set -euo pipefail
source=$1
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$2/blender_addon_test
rm -rf "$work" && mkdir -p "$work/tmp"
export TMPDIR=$work/tmp PYTHONDONTWRITEBYTECODE=1

python3 "$source/tools/blender_addon.py" "$work/one.zip" >/dev/null
python3 "$source/tools/blender_addon.py" "$work/two.zip" >/dev/null
cmp "$work/one.zip" "$work/two.zip"
python3 "$source/tests/scripts/blender_addon.py" "$source" "$pelage" "$work"

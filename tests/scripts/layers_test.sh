#!/usr/bin/env bash
# The layer check passes on the project and catches an upward and a sideways include. Usage: SOURCE BINARY
set -euo pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

python3 "$source/tools/check_layers.py" "$source"

mkdir -p "$work"/{src/base,src/shape,src/run,include/pelage,apps/cli}
echo '#include "run/run.h"' >"$work/apps/cli/main.cpp"
echo '#include "base/error.h"' >"$work/src/shape/good.cpp"
python3 "$source/tools/check_layers.py" "$work" >/dev/null

expect_caught() {  # FILE INCLUDE
  echo "#include \"$2\"" >"$work/$1"
  if python3 "$source/tools/check_layers.py" "$work" >"$work/log"; then
    echo "not caught: $1 includes $2"
    exit 1
  fi
  grep -q "^$1:1: " "$work/log"
  rm "$work/$1"
}
expect_caught src/base/upward.h shape/topology.h
expect_caught src/shape/sideways.cpp react/model.h
expect_caught src/base/public.cpp pelage/triangle_mesh.h
expect_caught include/pelage/error.h run/run.h
expect_caught src/run/app.cpp apps/cli/options.h

#!/usr/bin/env bash
# The layer check passes on the project and catches upward and sideways includes and others' headers out of their place.
# Usage: SOURCE BINARY
set -euo pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

python3 "$source/tools/check_layers.py" "$source"

mkdir -p "$work"/{src/base,src/shape,src/io,src/look,src/render,src/run,src/verify,include/pelage,apps/cli}
echo '#include "run/run.h"' >"$work/apps/cli/main.cpp"
echo '#include "base/error.h"' >"$work/src/shape/good.cpp"
printf '#include <%s>\n' tbb/parallel_for.h cmath Eigen/Core >"$work/src/base/parallel.cpp"
printf '#include <%s>\n' unistd.h tiny_gltf.h >"$work/src/io/good.cpp"
python3 "$source/tools/check_layers.py" "$work" >/dev/null

expect_caught() {  # FILE INCLUDE
  local include="\"$2\""
  [[ $2 == "<"* ]] && include=$2
  echo "#include $include" >"$work/$1"
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
expect_caught src/verify/picture.cpp render/picture.h
expect_caught src/run/threads.h "<tbb/parallel_for.h>"
expect_caught src/look/rays.cpp "<embree3/rtcore.h>"
expect_caught src/shape/files.cpp "<unistd.h>"
expect_caught src/io/picture.cpp "<spng.h>"
expect_caught src/base/unknown.cpp "<boost/optional.hpp>"
expect_caught include/pelage/error.h "<Eigen/Core>"

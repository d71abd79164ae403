#!/usr/bin/env bash
# find_package(pelage) works from an install tree that was moved, without Embree, and the program grows a coat.
# Usage: SOURCE BINARY
set -euo pipefail
source=$1
binary=$2
work=$binary/install_test
rm -rf "$work"
cmake --install "$binary" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/moved"
cp -r "$source/examples/outside" "$work/example"
build_type=$(sed -n 's/^CMAKE_BUILD_TYPE:[A-Z]*=//p' "$binary/CMakeCache.txt")
sanitize=$(sed -n 's/^PELAGE_SANITIZE:[A-Z]*=//p' "$binary/CMakeCache.txt")
cmake -S "$work/example" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE="$build_type" \
  -DCMAKE_DISABLE_FIND_PACKAGE_embree=ON -DCMAKE_CXX_FLAGS="${sanitize:+-fsanitize=$sanitize}" -DCMAKE_PREFIX_PATH="$work/moved" >/dev/null
cmake --build "$work/build"
cd "$work/build"
./outside
[ -s coat.glb ]

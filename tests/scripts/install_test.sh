#!/usr/bin/env bash
# find_package(pelage) works from an install tree that was moved, without Embree, and the program grows a coat; with the
# component "render" the program draws one, too.
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
build() {  # FOLDER [OPTION...]
  cmake -S "$work/$1" -B "$work/$1/build" -G Ninja -DCMAKE_BUILD_TYPE="$build_type" \
    -DCMAKE_CXX_FLAGS="${sanitize:+-fsanitize=$sanitize}" -DCMAKE_PREFIX_PATH="$work/moved" "${@:2}" >/dev/null
  cmake --build "$work/$1/build"
  cd "$work/$1/build"
}

build example -DCMAKE_DISABLE_FIND_PACKAGE_embree=ON
./outside
[ -s coat.glb ]

mkdir "$work/picture"
cp "$source/examples/render.cpp" "$work/picture"
cat >"$work/picture/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(picture LANGUAGES CXX)
find_package(pelage 0.1 REQUIRED COMPONENTS render)
add_executable(picture render.cpp)
target_link_libraries(picture PRIVATE pelage::pelage pelage::render)
CMAKE
build picture
./picture
[ -s front.png ]

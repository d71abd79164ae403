#!/usr/bin/env bash
# The core builds without anything but Eigen, and includes only the standard library and Eigen.
# Usage: core_only_test.sh SOURCE BINARY
set -euo pipefail
source=$1
build=$2/core_only
cmake -S "$source" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DPELAGE_CORE_ONLY=ON -DPELAGE_WERROR=ON >/dev/null
cmake --build "$build"

# Other libraries' headers are installed system-wide, where the compiler finds them; hence a look at the text. Headers
# of the C++ standard library have neither a dot nor a slash in their names.
cd "$source/src"
if grep -rnE '^ *# *include *<[^>]*[./]' base linalg shape react discretise time run |
   grep -vE '<Eigen/|^base/parallel\.(h|cpp):[0-9]+:#include <tbb/'; then
  echo "the core may include the standard library and Eigen only (oneTBB through base/parallel.h)"
  exit 1
fi

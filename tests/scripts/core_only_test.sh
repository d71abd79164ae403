#!/usr/bin/env bash
# The core builds, links and computes with nothing but Eigen. Configured alone, it must have the commands of the full build
# for all sources but base/parallel.cpp, so that its other objects are those that are there already; only that one is
# compiled. All of them together with the tests of linalg must link without any other library, and the tests pass.
# (That its sources include the standard library and Eigen only is for layers_test.sh to say.) Usage: SOURCE BINARY
set -euo pipefail
source=$1
binary=$2
work=$2/core_only
cached() { sed -n "s/^$1:[A-Z]*=//p" "$binary/CMakeCache.txt"; }

rm -rf "$work"
settings=()
for name in CMAKE_BUILD_TYPE CMAKE_CXX_COMPILER CMAKE_CXX_FLAGS PELAGE_SANITIZE PELAGE_WERROR; do
  settings+=("-D$name=$(cached $name)")
done
cmake -S "$source" -B "$work" -G Ninja -DPELAGE_CORE_ONLY=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON "${settings[@]}" >/dev/null

# commands BUILD: source and command of every object of the core, without what is about precompiled headers.
commands() {
  python3 - "$1" <<'PYTHON'
import json, re, sys
for entry in json.load(open(sys.argv[1] + "/compile_commands.json")):
    if "pelage_core.dir/src/" in entry["command"]:
        command = re.sub(r" -(Winvalid-pch|include \S*cmake_pch\.hxx|Wno-array-bounds|Wno-stringop-over(flow|read))\b", "",
                         entry["command"].replace(sys.argv[1], ""))
        print(entry["file"], command[command.index(" "):])
PYTHON
}
commands "$binary" | sort >"$work/full"
commands "$work" | sort >"$work/alone"
different=$({ diff "$work/full" "$work/alone" || true; } | sed -n "s|^[<>] $source/\([^ ]*\).*|\1|p" | sort -u)
if [ "$different" != src/base/parallel.cpp ] || [ "$(wc -l <"$work/alone")" -lt 50 ]; then
  echo "these are compiled in another way without oneTBB: $different"
  exit 1
fi

parallel=CMakeFiles/pelage_core.dir/src/base/parallel.cpp.o
cmake --build "$work" --target "$parallel"
sanitize=$(cached PELAGE_SANITIZE)
cd "$binary"
mapfile -t objects < <(find CMakeFiles/pelage_core.dir/src tests/CMakeFiles/linalg_test.dir -name '*.cpp.o' |
  grep -vxF "$parallel")
"$(cached CMAKE_CXX_COMPILER)" ${sanitize:+"-fsanitize=$sanitize"} -o "$work/linalg_alone" "$work/$parallel" "${objects[@]}" \
  -lgtest_main -lgtest
"$work/linalg_alone" --gtest_brief=1

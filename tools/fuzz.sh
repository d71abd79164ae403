#!/bin/sh
# Random bytes for every reader of files, texts and command lines, under the sanitizers:
# tools/fuzz.sh SECONDS [READER...], for each of the readers, or of those that are named (tests/fuzz/corpus lists them).
# What crashes a reader, hangs it or makes it reserve memory stays in build/fuzz/found; put it into tests/fuzz/corpus.
# What a reader has learned stays in build/fuzz/inputs, so that the next call goes on from there; Ctrl-C ends it all.
set -u
cd "$(dirname "$0")/.." || exit 1
seconds=$1
shift
found=build/fuzz/found
mkdir -p "$found"
trap 'exit 130' INT
trap 'exit 143' TERM

# seeds READER: folders with inputs to start from.
seeds() {
  case $1 in
    model) echo models ;;
    recipe) echo recipes ;;
    region) echo regions ;;
    patches) echo patches ;;
  esac
}

failures=0
for reader in ${*:-$(ls tests/fuzz/corpus)}; do
  mkdir -p "build/fuzz/inputs/$reader"
  # The limits on time and memory are part of what is tested.
  # shellcheck disable=SC2046  # the folders are separate arguments
  if build/fuzz/bin/input_fuzzer --reader="$reader" -max_total_time="$seconds" -timeout=10 -malloc_limit_mb=1024 \
    -max_len=20000 -fork="${JOBS:-$(nproc)}" -artifact_prefix="$found/$reader-" \
    "build/fuzz/inputs/$reader" "tests/fuzz/corpus/$reader" $(seeds "$reader") >"build/fuzz/$reader.log" 2>&1; then
    echo "$reader: nothing found"
  else
    echo "$reader: found something, see build/fuzz/$reader.log"
    failures=1
  fi
done
exit $failures

#!/usr/bin/env bash
# Runs an example in an empty folder and looks for what it writes. Usage: PROGRAM FOLDER [FILE...]
set -euo pipefail
program=$1 folder=$2
shift 2
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program"
for file in "$@"; do
  [ -s "$file" ] || { echo "it wrote no $file"; exit 1; }
done

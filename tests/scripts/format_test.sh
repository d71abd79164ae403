#!/usr/bin/env bash
# All sources are in the house's format; skipped where clang-format is absent. Usage: SOURCE BINARY
set -euo pipefail
cd "$1"
command -v clang-format >/dev/null || { echo "skipped: no clang-format"; exit 77; }
find src include apps python tests bench examples \( -name '*.h' -o -name '*.cpp' \) -print0 2>/dev/null |
  xargs -0 clang-format --dry-run -Werror

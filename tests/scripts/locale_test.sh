#!/usr/bin/env bash
# Nothing in src/ follows the locale, and the check catches what would. Usage: SOURCE BINARY
set -euo pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

python3 "$source/tools/check_locale.py" "$source"

mkdir -p "$work/src/base"
printf '%s\n' '// std::stod("1,5")' 'const char* text = "printf(";' 'std::ostringstream good;' \
  'good.imbue(std::locale::classic());' 'auto name = std::to_string(3), digits = is_digit(c) ? "" : to_lower(c);' \
  >"$work/src/base/good.cpp"
python3 "$source/tools/check_locale.py" "$work" >/dev/null

while read -r line; do
  echo "$line" >"$work/src/base/bad.cpp"
  if python3 "$source/tools/check_locale.py" "$work" >"$work/log"; then
    echo "not caught: $line"
    exit 1
  fi
  grep -q "^src/base/bad.cpp:1: " "$work/log"
done <<'LINES'
if (std::isalnum(c)) ++n;
c = static_cast<char>(tolower(c));
std::snprintf(buffer, sizeof buffer, "%g", value);
x = std::stod(text);
x = strtod(text, &end);
n = atoi(text);
std::istringstream in(text);
std::ifstream file(path);
LINES

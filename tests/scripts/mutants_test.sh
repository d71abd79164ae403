#!/usr/bin/env bash
# The list of mutants is true to the sources, and what is not true is found. Usage: SOURCE BINARY
set -euo pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

python3 "$source/tools/mutants.py" --check "$source"

mkdir -p "$work/tools" "$work/src/shape" "$work/tests/shape"
printf 'a += 1;\nb += 2;\nb += 2;\n' >"$work/src/shape/a.cpp"

# found MESSAGE FILE TEXT WITH TEST: of a list that has this mutant alone.
found() {
  printf '[[mutant]]\narea = "x"\nfile = "%s"\ntext = "%s"\nwith = "%s"\nwhat = "y"\ntests = ["%s"]\n' "${@:2}" \
    >"$work/tools/mutants.toml"
  if python3 "$source/tools/mutants.py" --check "$work" 2>"$work/log"; then
    echo "not found: $1"
    exit 1
  fi
  grep -qF -- "$1" "$work/log" || { cat "$work/log"; exit 1; }
}
found "1 mutants; there should be" src/shape/a.cpp "a += 1" "a -= 1" shape_test
found "occurs 0 times" src/shape/a.cpp "a += 2" "a -= 1" shape_test
found "occurs 2 times" src/shape/a.cpp "b += 2" "b -= 2" shape_test
found "occurs 0 times" src/shape/b.cpp "a += 1" "a -= 1" shape_test
found "is nothing new" src/shape/a.cpp "a += 1" "a += 1" shape_test
found "no such tests: shap_test" src/shape/a.cpp "a += 1" "a -= 1" shap_test:Grid

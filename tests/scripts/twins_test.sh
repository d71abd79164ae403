#!/usr/bin/env bash
# No name is defined twice in the project, and the check catches twins of every kind. Usage: SOURCE BINARY
set -euo pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

python3 "$source/tools/check_twins.py" "$source"

mkdir -p "$work"/{src/shape,src/look,tests/shape,tests/look}
check() { python3 "$source/tools/check_twins.py" "$work" >"$work/log"; }
write() { printf 'namespace pelage {\n%s\n}\n' "$2" >"$work/$1"; }

# twins NAME ONE OTHER: both in namespace pelage, in two files.
twins() {
  write src/shape/one.h "$2"
  write src/look/other.h "$3"
  if check; then
    echo "not caught: $2 and $3"
    exit 1
  fi
  grep -qF "src/shape/one.h:2: $1 is defined in src/look/other.h:2, too" "$work/log" || { cat "$work/log"; exit 1; }
}
twins "type pelage::Range" "struct Range { double min = 0, mean = 0, max = 0; };" "struct Range {
  double low = 0, high = 1;
};"
twins "type pelage::Triangulation" "struct Triangulation { int faces; };" "enum class Triangulation { uniform, graded };"
twins "type pelage::A" "template <class T> class A final : B<T> { int x() { return 1; } };" "union A { int i; };"
twins "function pelage::f(const std :: string &, int)" "int f(const std::string& a, int b = g({1})) { return b; }" \
  "inline double f(const std::string& name, int) { return 1; }"
twins "function pelage::A::f() const" "int A::f() const { return '}'; }" "int A::f() const { return 2; }"
twins "function pelage::f(int)" "int f(int) { return 1; }" '/* { */ const char* brace = "{"; int f(int x) { return 2; }'
twins "constant pelage::most" "inline constexpr int most = 3;" "inline constexpr double most = 4;"

# alone ONE OTHER: no twins.
alone() {
  write src/shape/one.h "$1"
  write src/look/other.h "$2"
  check || { cat "$work/log"; exit 1; }
}
alone "namespace { struct Range { int i; }; }" "namespace { struct Range { double d; }; }"
alone "struct A { struct Part { int i; }; };" "struct B { struct Part { double d; }; };"
alone "int f(int x) { return x; }" "int f(double x) { return 1; }"
alone "struct A; enum class E : int; int f(int);" "struct A { int i; }; enum class E : int { one }; int f(int x) { return x; }"
alone "static int f() { return 1; }" "namespace other { int f() { return 2; } }"
alone "int one() { struct Local { int i; }; return 1; }" "int other() { struct Local { double d; }; return 1; }"

# Each folder of tests is a program of its own, made with the sources.
alone "" ""
write tests/shape/one.h "struct Sample { int i; };"
write tests/look/other.h "struct Sample { double d; };"
check
write src/shape/one.h "struct Sample { double d; };"
if check; then
  echo "not caught: a twin in the tests"
  exit 1
fi

#!/usr/bin/env bash
# The Python package: installed by pip into an environment of its own, with Debian's packages alone, and held against the
# program by its own tests. Skipped where the module is not built (PELAGE_PYTHON) or pytest is not there. Usage: SOURCE BINARY
set -euo pipefail
source=$1 binary=$2
python=/usr/bin/python3
ls "$binary"/python/pelage/_core*.so >/dev/null 2>&1 || { echo "skipped: the module is not built"; exit 77; }
for module in numpy pytest setuptools wheel venv; do
  $python -c "import $module" 2>/dev/null || { echo "skipped: no $module for $python"; exit 77; }
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# pip leaves folders beside the sources: these get their own.
mkdir "$work/source"
cp -R "$source"/{CMakeLists.txt,setup.py,python,README.md} "$work/source"
$python -m venv --system-site-packages "$work/env"
(cd "$work/source" && PELAGE_BUILD=$binary PIP_NO_INDEX=1 "$work/env/bin/pip" install -q --disable-pip-version-check .)
cd "$work"
PELAGE=$binary/bin/pelage "$work/env/bin/python" -m pytest -q -p no:cacheprovider --basetemp "$work/pytest" "$source/python/tests"

#!/usr/bin/env bash
# The plain programs of bench/ solve what Pelage solves, and bench/tables.py makes its tables. Usage: SOURCE BINARY
set -euo pipefail
source=$1
bin=$2/bin
for program in pelage plain measure; do
  [ -x "$bin/$program" ] || { echo "no $bin/$program: it is not part of this build"; exit 77; }
done
work=$2/bench_test
rm -rf "$work" && mkdir -p "$work" && cd "$work"
fail() { echo "FAILED: $*"; exit 1; }

# number FILE KEY...: of a JSON file, by the path of keys
number() { python3 -c 'import json, sys; d = json.load(open(sys.argv[1]))
for key in sys.argv[2:]: d = d[int(key) if isinstance(d, list) else key]
print(d)' "$@"; }
below() { python3 -c "import sys; sys.exit(not float('$1') < $2)"; }

# --- the same mesh, scheme and step: the same fields, but for rounding and the tolerance of the solver ------------
# agree MODEL SPECIES STEP UNTIL
agree() {
  "$bin/pelage" grow 'builtin:sphere?n=642' --model "$1" --size 1.1u --method linear --stepper sbdf2 --step "$3" \
    --until "$4" --stationary 0 --keep-shape --detail 0 --json -q -o ours.ply >ours.json
  "$bin/plain" 'builtin:sphere?n=642' --model "$1" --unit "$(number ours.json stages 0 length_unit)" --method sbdf2 \
    --real double --step "$3" --until "$4" --stationary 0 -o plain.ply >plain.json
  "$bin/measure" plain.ply --species "$2" --against ours.ply >measure.json
  below "$(number measure.json error)" 1e-5 || fail "$1: $(cat measure.json)"
  [ "$(number measure.json spots)" -gt 3 ] || fail "$1: no pattern has grown, the comparison shows nothing"

  # Two other schemes with small steps: their own errors of second and of first order remain.
  for method in "rkc2 --step $(python3 -c "print($3 / 4)")" euler; do
    "$bin/plain" 'builtin:sphere?n=642' --model "$1" --unit "$(number ours.json stages 0 length_unit)" --real double \
      --method $method --until "$4" --stationary 0 -o plain.ply >plain.json
    "$bin/measure" plain.ply --species "$2" --against ours.ply >measure.json
    below "$(number measure.json error)" 0.15 || fail "$1, $method: $(cat measure.json)"
    below 1e-9 "$(number measure.json error)" || fail "$1, $method: no difference at all"
  done
}
agree schnakenberg v,u 0.05 20
agree turing:production a,b 0.5 200
agree gray-scott:spots u,v 0.5 400

# --- every table, from tiny runs ---------------------------------------------------------------------------------
cp "$source/docs/performance.md" page.md
python3 "$source/bench/tables.py" --quick --bin "$bin" --baseline "$bin/pelage" --results results --page page.md \
  >tables.log 2>&1 || { cat tables.log; fail "tables.py"; }
python3 - <<'PYTHON' || fail "see above; $work"
import json, pathlib, re, sys
page = pathlib.Path("page.md").read_text()
for name in "growth", "error", "commands", "scaling", "kernels":
    rows = json.load(open(f"results/{name}.json"))["rows"]
    failed = [r for r in rows if "unknown option" not in r.get("failed", "unknown option")]
    if not rows or failed:
        sys.exit(f"{name}: {failed or 'no rows'}")
    made = page.split(f"<!-- table: {name} -->")[1].split("<!-- end -->")[0]
    if made.count("\n| ") < len([r for r in rows if "failed" not in r]):
        sys.exit(f"{name}: the page shows {made}")
    if not any("baseline_seconds" in r for r in rows) and name in ("growth", "error", "commands"):
        sys.exit(f"{name}: no row has the seconds of the baseline")
error = {r["what"]: r["error"] for r in json.load(open("results/error.json"))["rows"] if "error" in r}
if not error or not all(0 < e < 1 for e in error.values()):
    sys.exit(f"errors {error}")
if re.search(r"/(home|tmp|root|work|build)\b", page):
    sys.exit("the page names a folder of this machine")
if "<svg" not in pathlib.Path("performance-error.svg").read_text():
    sys.exit("no plot")
PYTHON

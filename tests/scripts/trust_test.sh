#!/usr/bin/env bash
# What becomes of the files when a run is killed, stopped, meets a full disk, another run, or its own inputs.
# Usage: SOURCE BINARY [KILLS]: so many rounds of kill -9 (default: 6)
set -uo pipefail
pelage=$2/bin/pelage
[ -x "$pelage" ] || { echo "no $pelage: the program is not part of this build"; exit 77; }
work=$2/trust_test
kills=${3:-6}
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
failures=0
fail() { echo "FAILED: $1"; failures=$((failures + 1)); }

# expect CODE WORDS ARGUMENTS
expect() {
  local code=$1 words=$2
  shift 2
  "$pelage" "$@" >log 2>&1 </dev/null
  local was=$?
  [ $was = "$code" ] || { fail "$*: exit code $was instead of $code"; tail -1 log; }
  grep -q -- "$words" log || { fail "$*: no \"$words\" in the message"; tail -1 log; }
}

# --- killed and resumed: two stages, checkpoints all the time ------------------------------------------------------
grown=(grow 'builtin:sphere?n=642' --recipe leopard --set large.size=0.2 --set rings.size=0.1 -q --every-minutes 1e-6)
outputs=(-o coat.ply,coat.glb --picture-size 64 --picture coat.png)
mkdir whole && (cd whole && "$pelage" "${grown[@]}" "${outputs[@]}" --checkpoint state) || fail "the unbroken run"

# One round: the run is sent a signal after so many seconds, and resumed until it is done.
round() {
  local signal=$1 delay=$2
  rm -rf broken && mkdir broken && cd broken || exit 1
  "$pelage" "${grown[@]}" "${outputs[@]}" --checkpoint state >../round.log 2>&1 </dev/null &
  local run=$!
  sleep "$delay"
  kill -s "$signal" $run 2>/dev/null
  wait $run 2>/dev/null
  local have
  have=$(ls | grep -c '^coat' | tr -d ' ')
  [ "$(ls | grep -c '^coat\.\(ply\|glb\|png\)$')" = 0 ] || [ "$(ls | grep -c '^coat\.\(ply\|glb\|png\)$')" = 3 ] ||
    fail "$signal after $delay s: a part of the outputs: $(ls)"
  if [ -e state ]; then "$pelage" resume state >../round.log 2>&1; else
    "$pelage" "${grown[@]}" "${outputs[@]}" --checkpoint state >../round.log 2>&1; fi
  [ $? = 0 ] || { fail "$signal after $delay s: it does not go on"; tail -1 ../round.log; }
  for file in coat.ply coat.glb coat.png; do
    cmp -s $file ../whole/$file || fail "$signal after $delay s ($have files there): $file differs"
  done
  [ -z "$(ls -A | grep -v '^coat\.\(ply\|glb\|png\)$' | grep -v '^state\(.previous\)\?$')" ] ||
    fail "$signal after $delay s left $(ls -A)"
  cd ..
}
for ((k = 0; k < kills; ++k)); do round KILL "$(awk "BEGIN { print 0.05 + 1.5 * $k / $kills }")"; done
for signal in INT TERM HUP; do round $signal 0.4; done

# --- damaged checkpoints ----------------------------------------------------------------------------------------
cp whole/state damaged && printf 'x' | dd of=damaged bs=1 seek=999 conv=notrunc status=none
expect 3 'damaged or cut short' resume damaged
cp whole/state damaged.previous
(cd whole && "$pelage" resume ../damaged >../log 2>&1) || fail "the checkpoint before the damaged one is not taken"
grep -q 'the one before it is taken' log || fail "no word of the earlier checkpoint: $(cat log)"
expect 3 'no checkpoint' resume "$1/README.md"
expect 3 'cannot be opened' resume nothing

# --- outputs and inputs that are the same file: before any work, and nothing is touched -------------------------------
"$pelage" grow 'builtin:sphere?n=162' --size 0.3 -q -o in.ply || fail "a small coat"
"$pelage" unwrap in.ply -q -o in.obj || fail "uv"
printf '[[stage]]\nname = "spots"\nmodel = "turing"\nsize = 0.3\n' >recipe.toml
cp in.ply kept.ply
small=(grow in.ply --size 0.3)
expect 2 'an input itself' "${small[@]}" -o ./in.ply
expect 2 'an input itself' "${small[@]}" -o a.ply --checkpoint in.ply
expect 2 'an input itself' grow in.ply --recipe recipe.toml -o a.ply --checkpoint recipe.toml
expect 2 'an input itself' fair in.ply -o in.ply
expect 2 'an input itself' field in.ply -o in.ply
expect 2 'an input itself' cells in.ply -o in.ply
expect 2 'an input itself' unwrap in.ply -o in.ply
expect 2 'two outputs' "${small[@]}" -o a.ply,a.ply
expect 2 'two outputs' "${small[@]}" -o a.ply --checkpoint a.ply
expect 2 'two outputs' "${small[@]}" --picture a.png --plot a.png
expect 2 'two outputs' "${small[@]}" -o a.ply --lines a.svg,a.svg
expect 2 'two outputs' fair in.ply -o a.ply,./a.ply
expect 2 'two outputs' cells in.ply -o a.ply -o a.ply
cp whole/state state.ply
expect 2 'the checkpoint itself' "${small[@]}" --resume state.ply -o state.ply
cmp -s in.ply kept.ply || fail "an input was changed"
expect 0 'wrote' fair in.ply -o in.ply --force
ln -s in.ply link.ply
expect 2 'an input itself' fair in.ply -o link.ply

# --- what is no file, and what cannot be written ----------------------------------------------------------------
mkfifo pipe.ply
expect 5 'no regular file' "${small[@]}" -o pipe.ply
[ -p pipe.ply ] || fail "a pipe was replaced"
if mknod null.ply c 1 3 2>/dev/null; then
  expect 5 'no regular file' "${small[@]}" -o null.ply
  [ -c null.ply ] || fail "a device was replaced"
fi
mkdir folder.ply
expect 5 'Is a directory' "${small[@]}" -o folder.ply
expect 5 'does not exist' "${small[@]}" -o nowhere/a.ply
# A limit on the size of files stands in for a full disk: the system reports both in the same way.
mkdir full && cp in.ply full/a.ply
(ulimit -f 60 && cd full && "$pelage" grow 'builtin:sphere?n=162' --size 0.3 -o b.vtp,a.ply --picture-size 32 --picture c.png >../log 2>&1)
[ $? = 5 ] || fail "a full disk: $(tail -1 log)"
grep -q 'cannot write' log || fail "a full disk: $(tail -1 log)"
[ "$(ls -A full)" = a.ply ] && cmp -s full/a.ply in.ply || fail "a full disk left $(ls -A full)"

# --- two runs at once --------------------------------------------------------------------------------------------
long=(grow 'builtin:sphere?n=642' --model gray-scott --size 0.05 --until 1e9 --stationary 0)
"$pelage" "${long[@]}" -o both.ply >/dev/null 2>&1 &
first=$!
for ((k = 0; k < 100; ++k)); do [ -e both.ply.pelage-partial ] && break; sleep 0.1; done
expect 5 'another run is writing' "${small[@]}" -o both.ply
kill -9 $first
wait $first 2>/dev/null
expect 0 'wrote' "${small[@]}" -o both.ply
ls -A | grep -q pelage-partial && fail "temporary files are left: $(ls -A)"

echo "$failures failures"
[ "$failures" -eq 0 ]

#!/bin/bash
# Maps, sheets and galleries go on where they were cut off, and end with the bytes of an unbroken run: parts_test.sh ROOT BUILD
set -u
pelage=$(realpath "$2")/bin/pelage
mkdir -p "$2/test-files/parts"
cd "$2/test-files/parts" || exit 1
rm -rf ./*
fail() {
  echo "$*" >&2
  exit 1
}

map=(map schnakenberg --x d=5:40 --y a=0.02:0.3 -n 4x4 --until 30 --threads 1 -q -o map.png)
sheet=(sheet --shapes 'builtin:sphere?n=642,builtin:torus' --models turing --seeds 1,2,3 --size 0.3 --picture-size 64 --threads 1 -q -o sheet.png)
gallery=(gallery turing schnakenberg brusselator --size 0.4 --picture-size 64 --threads 1 -q -o page)

# begin SIGNAL SECONDS WORDS...: lets a command run until its first part is on the disk and so many seconds more, sends the
# signal, and prints its exit code and what it said last.
begin() {
  python3 - "$1" "$2" "$pelage" "${@:3}" <<'PYTHON'
import glob, signal, subprocess, sys, time
signal.signal(signal.SIGINT, signal.default_int_handler)
run = subprocess.Popen(sys.argv[3:], stderr=subprocess.PIPE, text=True)
while run.poll() is None and not any(open(f, "rb").read() for f in glob.glob("**/*.pelage-parts", recursive=True)):
    time.sleep(0.005)
time.sleep(float(sys.argv[2]))
run.send_signal(getattr(signal, sys.argv[1]))
print(run.stderr.read(), run.wait())
PYTHON
}

# goes_on FILE WORDS...: for both signals.
goes_on() {
  "$pelage" "${@:2}" || fail "$2 failed"
  rm -rf whole && mkdir whole && cp -r "$1" whole/ && rm -r "$1"
  for signal in SIGKILL SIGINT; do
    said=$(begin $signal 0.05 "${@:2}")
    ls -- *.pelage-parts */*.pelage-parts 2>/dev/null | grep -q . || fail "$2 left no parts at $signal: $said"
    [ $signal = SIGKILL ] || grep -q 'interrupted.* are kept in .*, and the same command goes on from there' <<<"$said" ||
      fail "$2: $said"
    "$pelage" "${@:2}" || fail "$2 did not go on after $signal"
    diff -r "$1" "whole/$1" >/dev/null || fail "$2 after $signal is not what an unbroken run makes"
    [ -z "$(find . -name '*.pelage-*')" ] || fail "$2 left $(find . -name '*.pelage-*')"
    rm -r "$1"
  done
}
goes_on map.png "${map[@]}"
goes_on sheet.png "${sheet[@]}"
goes_on page "${gallery[@]}"

# A finished picture is kept as it is; one that was changed since is made anew.
begin SIGKILL 0 "${gallery[@]}" >/dev/null
touch -d 2001-01-01 page/*.png
first=$(ls page/*.png | head -1)
"$pelage" "${gallery[@]}" || fail "the gallery did not go on"
[ "$(find page -name '*.png' ! -newermt 2002-01-01)" = "$first" ] || fail "the picture that was finished was made again"
diff -r page whole/page || fail "the gallery that went on is another"
begin SIGKILL 0 "${gallery[@]}" >/dev/null
first=$(ls -t page/*.png | head -1)
echo changed >>"$first"
"$pelage" "${gallery[@]}" || fail "the gallery did not go on"
diff -r page whole/page || fail "a picture that was changed was kept"

# Another command takes over nothing.
begin SIGKILL 0 "${sheet[@]}" >/dev/null
"$pelage" "${sheet[@]}" --view top || fail "another sheet failed"
mv sheet.png after.png
"$pelage" "${sheet[@]}" --view top || fail "another sheet failed"
cmp sheet.png after.png || fail "a sheet took over tiles of another"

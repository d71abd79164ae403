#!/usr/bin/env bash
# Do the programs that people use open our files?   tests/clients/run.sh [FILE.{glb,ply,obj,vtp,vti,vts,exr}...]
# Installs what is missing (Debian packages through apt as root, npm packages into build/clients), prints one line per
# client and file, and exits with 1 if a client refuses a file or finds no mesh, no colours or no normals in it. Without
# files only what does not need any: the Blender add-on, the figure that goes from Blender through the program and back
# (docs/blender.md), and glTF as three.js shows it. A client that is missing and cannot be installed is skipped, and said to be.
set -u
here=$(cd "$(dirname "$0")" && pwd)
modules="$here/../../build/clients"
pelage="$here/../../build/release/bin/pelage"

packages="blender python3-numpy xvfb xauth"
[ $# -eq 0 ] || packages="$packages paraview python3-paraview chromium"
command -v node >/dev/null || packages="$packages nodejs"
command -v npm >/dev/null || packages="$packages npm"
sh "$here/../../tools/setup.sh" $packages
mkdir -p "$modules"
for module in gltf-validator three; do
  [ -d "$modules/node_modules/$module" ] ||
    npm install --prefix "$modules" --no-audit --no-fund --silent "$module"
done

failures=0
# report NAME FILE COMMAND...: the last line that begins with "ok", or all that the client said.
report() {
  local name=$1 file=$2 said
  shift 2
  there "$@" || { echo "$name is missing: skipped for $(basename "$file")"; return; }
  if said=$(NODE_MODULES="$modules/node_modules" timeout "${limit:-300}" bash -c '"$@"' _ "$@" "$file" 2>&1) && grep -q '^ok ' <<<"$said"; then
    printf '%-14s %-24s %s\n' "$name" "$(basename "$file")" "$(grep '^ok ' <<<"$said" | tail -n 1)"
  else
    printf '%-14s %-24s FAILED\n%s\n' "$name" "$(basename "$file")" "$(tail -n 20 <<<"$said")"
    failures=$((failures + 1))
  fi
}
# there COMMAND...: whether the programs and modules of the command are installed.
there() {
  local word
  for word in node blender pvpython; do
    [[ " $* " != *" $word "* ]] || type -P $word >/dev/null || return 1
  done
  case "$*" in
    *check_gltf.mjs) [ -d "$modules/node_modules/gltf-validator" ] ;;
    *check_three.mjs) [ -d "$modules/node_modules/three" ] && type -P chromium >/dev/null ;;
    *check_gltf_reading.mjs*) [ -d "$modules/node_modules/three" ] ;;
  esac
}
validator() { report gltf-validator "$1" node "$here/check_gltf.mjs"; }
three() { report three.js "$1" node "$here/check_three.mjs"; }
blender() { report Blender "$1" blender -b --factory-startup --python-exit-code 3 -P "$here/check_blender.py" --; }
exr() { report Blender "$1" blender -b --factory-startup --python-exit-code 3 -P "$here/check_exr.py" --; }
paraview() { report ParaView "$1" with_display pvpython --force-offscreen-rendering "$here/check_paraview.py"; }
# On a busy machine the virtual display is not always there in time: the client aborts before it reads the file.
with_display() { xvfb-run -a "$@" || { [ $? -eq 134 ] && sleep 2 && xvfb-run -a "$@"; }; }
export -f with_display

for file in "$@"; do
  [ -f "$file" ] || { echo "$file: no such file" >&2; failures=$((failures + 1)); continue; }
  file=$(realpath "$file")
  case "$file" in
    *.glb) validator "$file"; blender "$file"; three "$file" ;;
    *.ply) blender "$file"; paraview "$file"; three "$file" ;;
    *.obj) blender "$file"; paraview "$file"; three "$file" ;;
    *.vtp) paraview "$file"; three "$file" ;;
    *.vti|*.vts) paraview "$file" ;;
    *.exr) exr "$file" ;;
    *) echo "$file: no client is known for this format" >&2; failures=$((failures + 1)) ;;
  esac
done
# The other way round: scenes with skins, morph targets, sparse and quantised arrays and instances are read as three.js
# shows them.
scenes="$modules/scenes"
rm -rf "$scenes" && mkdir -p "$scenes"
python3 "$here/make_gltf.py" "$scenes" || failures=$((failures + 1))
for scene in "$scenes"/*.glb; do
  report "three.js" "$scene" node "$here/check_gltf_reading.mjs" "$pelage"
done
report "Blender" "$modules/round-trip" blender -b --factory-startup --python-exit-code 3 -P "$here/blender_round_trip.py" -- "$pelage"
tangents() { report Blender "$1" blender -b --factory-startup --python-exit-code 3 -P "$here/check_tangents.py" -- "$pelage"; }
tangents "$modules/tangents"
# The add-on, without a window and with one, in a user's folder of its own.
addon="$modules/addon"
rm -rf "$addon" && mkdir -p "$addon/scripts" "$addon/config"
export BLENDER_USER_SCRIPTS="$addon/scripts" BLENDER_USER_CONFIG="$addon/config"
python3 "$here/../../tools/blender_addon.py" "$addon/pelage_addon.zip" || failures=$((failures + 1))
limit=1200
addon_test() {  # SCRIPT FOLDER COMMAND...
  local script=$1 folder=$2
  shift 2
  report Blender "$folder" "$@" --factory-startup --python-exit-code 3 -P "$here/$script" -- "$pelage" "$addon/pelage_addon.zip"
}
addon_test blender_addon.py "$addon/without-window" blender -b
addon_test blender_window.py "$addon/with-window" with_display blender
[ "$failures" -eq 0 ] || { echo "$failures checks failed" >&2; exit 1; }

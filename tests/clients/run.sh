#!/usr/bin/env bash
# Do the programs that people use open our files?   tests/clients/run.sh FILE.{glb,ply,obj,vtp}...
# Installs what is missing (Debian packages through apt as root, npm packages into build/clients), prints one line per
# client and file, and exits with 1 if a client refuses a file or finds no mesh, no colours or no normals in it.
set -u
here=$(cd "$(dirname "$0")" && pwd)
modules="$here/../../build/clients"
[ $# -gt 0 ] || { echo "usage: $0 FILE.{glb,ply,obj,vtp}..." >&2; exit 2; }

packages="blender python3-numpy paraview python3-paraview xvfb xauth chromium"
command -v node >/dev/null || packages="$packages nodejs"
command -v npm >/dev/null || packages="$packages npm"
sh "$here/../../tools/setup.sh" $packages || exit 1
mkdir -p "$modules"
for module in gltf-validator three; do
  [ -d "$modules/node_modules/$module" ] ||
    npm install --prefix "$modules" --no-audit --no-fund --silent "$module" || exit 1
done

failures=0
# report NAME FILE COMMAND...: the last line that begins with "ok", or all that the client said.
report() {
  local name=$1 file=$2 said
  shift 2
  if said=$(NODE_MODULES="$modules/node_modules" timeout 300 bash -c '"$@"' _ "$@" "$file" 2>&1) && grep -q '^ok ' <<<"$said"; then
    printf '%-14s %-24s %s\n' "$name" "$(basename "$file")" "$(grep '^ok ' <<<"$said" | tail -n 1)"
  else
    printf '%-14s %-24s FAILED\n%s\n' "$name" "$(basename "$file")" "$(tail -n 20 <<<"$said")"
    failures=$((failures + 1))
  fi
}
validator() { report gltf-validator "$1" node "$here/check_gltf.mjs"; }
three() { report three.js "$1" node "$here/check_three.mjs"; }
blender() { report Blender "$1" blender -b --factory-startup --python-exit-code 3 -P "$here/check_blender.py" --; }
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
    *) echo "$file: no client is known for this format" >&2; failures=$((failures + 1)) ;;
  esac
done
# The other way round: scenes with skins, morph targets, sparse and quantised arrays and instances are read as three.js
# shows them.
pelage="$here/../../build/release/bin/pelage"
for seed in 1 2 3 4 5; do
  python3 "$here/make_gltf.py" "$modules/scene$seed.glb" $seed || failures=$((failures + 1))
  report "three.js" "$modules/scene$seed.glb" node "$here/check_gltf_reading.mjs" "$pelage"
done
[ "$failures" -eq 0 ] || { echo "$failures checks failed" >&2; exit 1; }

#!/bin/sh
# Installs the Debian packages that building and testing need and that are missing; further packages may be named as
# arguments. Asks for root only when something is missing; with everything in place it does not touch the network.
set -eu

packages="
  g++ cmake ninja-build python3
  libeigen3-dev libtbb-dev libembree-dev libtinygltf-dev libdraco-dev libmeshoptimizer-dev libstb-dev libdeflate-dev libmd-dev libpugixml-dev
  libspng-dev libturbojpeg0-dev fonts-dejavu-core
  libcli11-dev libcpp-httplib-dev libtomlplusplus-dev nlohmann-json3-dev
  libgtest-dev libosd-dev $*"

missing=""
for package in $packages; do
  # Where there is no dpkg at all, every package counts as missing.
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

if ! command -v apt-get >/dev/null; then
  echo "setup: this system has no apt-get; install the equivalents of:$missing" >&2
  exit 1
fi
as_root=""
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "setup: as root, run: apt-get install$missing" >&2; exit 1; }
  as_root="sudo"
fi

echo "setup: installing$missing"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
# shellcheck disable=SC2086  # the words of the lists are separate arguments
if ! { $as_root apt-get update -q && $as_root env DEBIAN_FRONTEND=noninteractive \
       apt-get install -y -q --no-install-recommends $missing; } >"$log" 2>&1 </dev/null; then
  tail -n 20 "$log" >&2
  echo "setup: apt-get failed; the lines above say why" >&2
  exit 1
fi

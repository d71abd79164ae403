#!/bin/sh
# Makes the pictures of the site (docs/site.md) that are kept in the repository: site/*.webp and site/figures/*.webp. What was
# grown before in out/figures stays; some ten minutes otherwise. Installs what is missing.
set -eu
CDPATH="" cd -- "$(dirname -- "$0")/.."
sh tools/setup.sh ffmpeg
pelage=build/release/bin/pelage
mkdir -p out/site-pictures site/figures
small() {  # PICTURE WIDTH TARGET: at most so wide
  ffmpeg -loglevel error -y -i "$1" -vf "scale='min($2,iw)':-2" -c:v libwebp -quality 82 "$3"
}
# The same things on a light and on a dark ground.
sed 's/^background = .*/background = "#1b1c1e"/' site/front.toml >out/site-pictures/dark.toml
for ground in light dark; do
  scene=site/front.toml
  [ $ground = light ] || scene=out/site-pictures/dark.toml
  "$pelage" render "$scene" --picture-size 1760 -o "out/site-pictures/$ground.png"
  small "out/site-pictures/$ground.png" 1760 "site/front-$ground.webp"
done
small docs/studio.png 1200 site/studio.webp
"$pelage" figures -o out/figures
for picture in $("$pelage" figures --json | sed -n 's/.*"picture": "\(.*\)\.png".*/\1/p'); do
  small "out/figures/$picture.png" 480 "site/figures/$picture.webp"
done

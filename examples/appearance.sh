#!/usr/bin/env bash
# Makes docs/pictures/appearance.png: ten plates that bear their loads and look like a picture.
# Needs imagemagick and fonts-dejavu-core (or FONT=file.ttf).
# Usage: bash examples/appearance.sh [lamella command, default build/quickstart/lamella]
set -euo pipefail
cd "$(dirname "$0")/.."
lamella=${1:-build/quickstart/lamella}
pictures=out/appearance
font=${FONT:-/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf}

mkdir -p "$pictures"
labelled=()
for image in blobs bricks net spots waves; do
    labelled+=(-label "picture: $image" "examples/inputs/$image.png")
done
for recipe in examples/appearance/*.toml; do
    name=$(basename "$recipe" .toml)
    "$lamella" optimize "$recipe" --quiet -o "$pictures/$name.txt"
    "$lamella" preview "$recipe" --cut none --azimuth 0 --elevation 89 --size 480 -o "$pictures/$name.png"
    convert "$pictures/$name.png" -fuzz 12% -trim +repage "$pictures/$name.png"
    labelled+=(-label "${name//_/ }" "$pictures/$name.png")
done
montage "${labelled[@]}" -geometry 240x150+6+6 -tile 5x -background white -fill '#333333' -font "$font" -pointsize 14 \
    -strip miff:- | convert miff:- +dither -colors 64 -strip png8:docs/pictures/appearance.png

#!/usr/bin/env bash
# Makes docs/pictures/gallery.png: a picture of every recipe in this folder, cut open as its header says, in one sheet.
# Pictures that are newer than their recipe are kept in out/gallery. Needs imagemagick and
# fonts-dejavu-core (or FONT=file.ttf).
# Usage: bash examples/gallery.sh [lamella command, default build/quickstart/lamella]
set -euo pipefail
cd "$(dirname "$0")/.."
lamella=${1:-build/quickstart/lamella}
pictures=out/gallery
sheet=docs/pictures/gallery.png
tile=200  # px
font=${FONT:-/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf}

mkdir -p "$pictures"
files=()
for recipe in examples/*.toml; do
    name=$(basename "$recipe" .toml)
    picture=$pictures/$name.png
    # The header's preview command says how the recipe is best seen.
    cut=$(sed -n 's/^#.*lamella preview.* --cut \([a-z]*\).*/\1/p' "$recipe" | head -n 1)
    if [ ! "$picture" -nt "$recipe" ]; then
        "$lamella" preview "$recipe" --cut "${cut:-x}" --size 320 -o "$picture"
    fi
    files+=(-label "$name" "$picture")
done
# 128 colours without dithering: a quarter of the bytes.
montage "${files[@]}" -geometry "${tile}x$tile+5+5" -tile 5x -background white -fill '#333333' \
    -font "$font" -pointsize 13 -strip miff:- | convert miff:- +dither -colors 128 -strip "png8:$sheet"
echo "$sheet: $((${#files[@]} / 3)) recipes, $(stat -c %s "$sheet") bytes"

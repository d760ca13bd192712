#!/usr/bin/env bash
# Makes docs/pictures/pattern_sheet.png: the pictures of examples/inputs as patterns on the skins of three bodies.
# Pictures that exist in out/patterns are kept. Needs imagemagick and fonts-dejavu-core (or FONT=file.ttf).
# Usage: bash examples/pattern_sheet.sh [lamella command, default build/quickstart/lamella]
set -euo pipefail
cd "$(dirname "$0")/.."
lamella=${1:-build/quickstart/lamella}
pictures=out/patterns
sheet=docs/pictures/pattern_sheet.png
tile=270  # px
font=${FONT:-/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf}
examples=("blobs 24" "bricks 36" "dots 40" "gravel 100" "membrane 36 --skin-invert")
bodies=("koala examples/models/koala_mm.obj"
    "ring --shape torus --shape-radius 20 --shape-tube 8"
    "box --shape box --shape-size 44,32,24")

mkdir -p "$pictures"
files=()
for body in "${bodies[@]}"; do
    read -r name shape <<<"$body"
    for example in "${examples[@]}"; do
        read -r image size more <<<"$example"
        picture=$pictures/${name}_$image.png
        # Words of `shape` and `more` are arguments of their own.
        # shellcheck disable=SC2086
        [ -e "$picture" ] || "$lamella" preview $shape --skin 1.2 --skin-pattern by-example --skin-strut 0.8 \
            --skin-image "examples/inputs/$image.png" --skin-image-size "$size" $more --cut none --size 320 -o "$picture"
        files+=(-label "$image" "$picture")
    done
done
montage "${files[@]}" -geometry "${tile}x$tile+5+5" -tile 5x -background white -fill '#333333' \
    -font "$font" -pointsize 16 -strip miff:- | convert miff:- +dither -colors 200 -strip "png8:$sheet"
echo "$sheet: $((${#files[@]} / 3)) skins, $(stat -c %s "$sheet") bytes"

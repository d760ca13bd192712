#!/usr/bin/env bash
# Makes docs/pictures/skins.png: one model with a closed skin, a frame, Voronoi windows and a picture's, side by side.
# Needs imagemagick and fonts-dejavu-core (or FONT=file.ttf).
# Usage: bash examples/skins.sh [lamella command, default build/quickstart/lamella]
set -euo pipefail
cd "$(dirname "$0")/.."
lamella=${1:-build/quickstart/lamella}
pictures=out/skins
font=${FONT:-/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf}
koala=examples/models/koala_mm.obj

mkdir -p "$pictures"
view() { "$lamella" preview --size 480 -o "$pictures/$1.png" "${@:2}"; }
view shell $koala --cell 5 --beam 0.35 --skin 0.8 --cut x
view frame examples/framed_koala.toml --cut x
view windows examples/voronoi_windows.toml --cut none
view picture $koala --skin 1.2 --skin-pattern image --skin-image examples/inputs/blobs.png --skin-image-size 30 \
    --skin-strut 0.8 --cut none
montage -label "closed skin over foam" $pictures/shell.png -label "frame that the foam grows out of" \
    $pictures/frame.png -label "Voronoi windows" $pictures/windows.png -label "windows from a picture" \
    $pictures/picture.png -geometry 440x440+5+5 -tile 2x -background white -fill '#333333' -font "$font" \
    -pointsize 18 -strip miff:- | convert miff:- +dither -colors 200 -strip png8:docs/pictures/skins.png

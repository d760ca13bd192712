#!/usr/bin/env bash
# Makes docs/pictures/supports.png: three models on the scaffolds that hold them while they are printed.
# Needs imagemagick.
# Usage: bash examples/supports.sh [lamella command, default build/quickstart/lamella]
set -euo pipefail
cd "$(dirname "$0")/.."
lamella=${1:-build/quickstart/lamella}
pictures=out/supports

mkdir -p "$pictures"
view() {
    "$lamella" preview "${@:2}" --printer marlin --layer-height 0.2 --support bridges --cut none --size 560 \
        -o "$pictures/$1.png"
}
view koala examples/models/koala_mm.obj --azimuth 60 --elevation 8
view fish tests/models/good/fish_mm.obj --azimuth 115 --elevation 6
view spot tests/models/good/spot_quads.obj --scale 30 --azimuth 40 --elevation 6
montage $pictures/koala.png $pictures/fish.png $pictures/spot.png -geometry 480x480+4+4 -tile 3x -background white \
    -strip miff:- | convert miff:- +dither -colors 200 -strip png8:docs/pictures/supports.png

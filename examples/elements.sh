#!/usr/bin/env bash
# Makes docs/pictures/elements.png: parts built of copies of leaves, rings, sticks and letters.
# Needs imagemagick and fonts-dejavu-core (or FONT=file.ttf).
# Usage: bash examples/elements.sh [lamella command, default build/quickstart/lamella]
set -euo pipefail
cd "$(dirname "$0")/.."
lamella=${1:-build/quickstart/lamella}
pictures=out/elements
font=${FONT:-/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf}

mkdir -p "$pictures"
cat > "$pictures/sticks.toml" <<'RECIPE'
[part]
mesh = "../../examples/models/koala_mm.obj"

[[element]]
length = 14
width = 3

[elements]
count = 160
iterations = 40
overlap = 0.3

[[load]]
box = [[-20, -40, 25], [20, 40, 40]]
force = [0, 0, -10]

[[anchor]]
face = "-z"
RECIPE
view() { "$lamella" preview --size 480 --cut none -o "$pictures/$1.png" "${@:2}"; }
view leaves examples/leaf_console.toml --elevation 70 --azimuth 0
view rings examples/ring_bracket.toml
view sticks "$pictures/sticks.toml"
view stool examples/letter_stool.toml --elevation 75 --azimuth 0
view shade examples/leaf_shade.toml
montage -label "60 leaves between a ledge and two feet" $pictures/leaves.png -label "45 rings from a wall to a load" \
    $pictures/rings.png -label "160 sticks that bear a weight on the back" $pictures/sticks.png \
    -label "75 letters under the seat of a stool" $pictures/stool.png \
    -label "170 leaves on the skin of a lamp shade" $pictures/shade.png -geometry 440x440+5+5 \
    -tile 3x -background white -fill '#333333' -font "$font" -pointsize 18 -strip miff:- |
    convert miff:- +dither -colors 200 -strip png8:docs/pictures/elements.png

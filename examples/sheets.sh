#!/usr/bin/env bash
# Makes docs/pictures/sheets.png: the first board of the plywood koala, its strokes widened to be seen.
# Needs librsvg2-bin and imagemagick.
# Usage: bash examples/sheets.sh [lamella command, default build/quickstart/lamella]
set -euo pipefail
cd "$(dirname "$0")/.."
lamella=${1:-build/quickstart/lamella}
mkdir -p out
"$lamella" slice examples/plywood_koala.toml -o out/plywood_koala --force
sed 's/stroke-width="0.01"/stroke-width="0.9"/' out/plywood_koala/sheet_001.svg |
    rsvg-convert --width 1200 --background-color white --output out/sheet.png /dev/stdin
convert out/sheet.png -trim +repage -bordercolor white -border 8 +dither -colors 32 -strip png8:docs/pictures/sheets.png

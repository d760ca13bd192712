#!/usr/bin/env bash
# Compares the supports of models, 0.2 mm layers, with those of PrusaSlicer (Debian's package; its grid and snug
# styles, else its defaults): volume and printing length, read from the G-code of both by the same program.
# Usage: bash tests/bench/support_material.sh LAMELLA MODEL[@SCALE]...
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
lamella=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
material() { awk -f "$here/support_material.awk" "$1"; }

echo "| model | points | bridges | a pillar under each point | PrusaSlicer, snug | PrusaSlicer, grid |"
echo "|---|---|---|---|---|---|"
for argument in "$@"; do
    model=${argument%@*}
    scale=1
    [[ $argument == *@* ]] && scale=${argument##*@}
    for kind in bridges pillars; do
        "$lamella" slice "$model" --scale "$scale" --printer marlin --layer-height 0.2 --support $kind -q \
            --plans "" -o "$work/$kind.gcode"
    done
    points=$("$lamella" supports "$model" --scale "$scale" --printer marlin --layer-height 0.2 -q --plans "" |
        awk '$1 == "supports" { print $2 }') || true
    for style in snug grid; do
        prusa-slicer --export-gcode --layer-height 0.2 --first-layer-height 0.2 --skirts 0 --scale "$scale" \
            --support-material --support-material-style $style --output "$work/$style.gcode" "$model" \
            > "$work/prusa.log" 2>&1 || { tail -3 "$work/prusa.log" >&2; exit 1; }
    done
    name=$(basename "$model")
    echo "| ${name%.*} | $points | $(material "$work/bridges.gcode") | $(material "$work/pillars.gcode") |" \
        "$(material "$work/snug.gcode") | $(material "$work/grid.gcode") |"
    rm -f "$work"/*.gcode
done

#!/usr/bin/env bash
# Cubes of foam as G-code, beside the slicers of Debian (packages cura-engine, cura, prusa-slicer, python3-skimage, time),
# which take the foam as a mesh: CuraEngine one capsule a beam, PrusaSlicer one closed surface of 0.15 mm marching
# cubes, for it crashes on the capsules. CPU seconds and peak memory of each program alone; making the mesh is not
# counted. Usage: bash tests/bench/filament_foam.sh LAMELLA [EDGE in mm]... ; PRUSA_LIMIT: edges above are left out, 20
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
lamella=$1
shift
edges=("$@")
[ ${#edges[@]} -gt 0 ] || edges=(10 20 30 40)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cura_definition=/usr/share/cura/resources/definitions/fdmprinter.def.json

# "12.3 s, 45 MB" of a command, or how it failed.
timed() {
    if /usr/bin/time -o "$work/time" -f '%U %S %M' "$@" > "$work/log" 2>&1; then
        awk '{ printf "%.3g s, %.0f MB", $1 + $2, $3 / 1024 }' "$work/time"
    else
        echo "failed: $(cat "$work/time" "$work/log" | tail -n 2 | tr '\n' ' ')"
    fi
}

echo "| cube | lamella | CuraEngine, capsules | PrusaSlicer, surface |"
echo "|---|---|---|---|"
for edge in "${edges[@]}"; do
    foam=(--shape box --shape-size "$edge,$edge,$edge" --cell 2 --beam 0.3 --seed 1)
    ours=$(timed "$lamella" slice "${foam[@]}" --printer marlin --layer-height 0.2 -q \
        -o "$work/ours.gcode")
    "$lamella" dump beams "${foam[@]}" -o "$work/beams.csv"
    /usr/bin/python3 "$here/foam_meshes.py" beams "$work/beams.csv" "$work/beams.stl"
    cura=$(timed CuraEngine slice -j "$cura_definition" -s layer_height=0.2 -s layer_height_0=0.2 -s line_width=0.45 \
        -s adhesion_type=none -s infill_sparse_density=100 -s machine_width=220 -s machine_depth=220 \
        -l "$work/beams.stl" -o "$work/cura.gcode")
    prusa="not run"
    if [ "$edge" -le "${PRUSA_LIMIT:-20}" ]; then
        "$lamella" slice "${foam[@]}" --printer png --layer-height 0.15 -q -o "$work/stack" \
            --printer-pixel 0.15 --printer-width $((edge * 7 + 10)) --printer-height $((edge * 7 + 10))
        /usr/bin/python3 "$here/foam_meshes.py" surface "$work/stack" 0.15 "$work/surface.stl"
        prusa=$(timed prusa-slicer --export-gcode --layer-height 0.2 --first-layer-height 0.2 --skirts 0 \
            --fill-density 100% --fill-pattern rectilinear --output "$work/prusa.gcode" "$work/surface.stl")
    fi
    echo "| $edge mm | $ours | $cura | $prusa |"
    rm -rf "$work"/*
done

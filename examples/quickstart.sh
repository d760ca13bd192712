#!/usr/bin/env bash
# From a fresh clone to layers: installs what is missing, builds the command, and turns a koala into a stack of masks, an SVG,
# a G-code file and a picture: a skin over Voronoi foam.
# Usage: bash examples/quickstart.sh [output folder, default out/]
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-out}

bash cmake/install_packages.sh cmake/packages-build.txt
echo "Building the lamella command (three to six minutes on two cores the first time)"
cmake -S . -B build/quickstart -G Ninja -DCMAKE_BUILD_TYPE=Release -DLAMELLA_TESTS=OFF >/dev/null
build=(cmake --build build/quickstart --target lamella_command)
[ -t 1 ] || build+=(-- --quiet)  # a terminal shows in one line how far it is
"${build[@]}"
lamella=build/quickstart/lamella

mkdir -p "$out"
"$lamella" slice examples/koala.toml -o "$out/koala" --force
"$lamella" slice examples/koala.toml --printer svg --layer-height 0.5 -o "$out/koala.svg" --force
"$lamella" slice examples/koala.toml --printer marlin --layer-height 0.2 -o "$out/koala.gcode" --force
"$lamella" preview examples/koala.toml --cut x -o "$out/koala.png"

echo
echo "Made from examples/models/koala_mm.obj:"
echo "  $out/koala/        $(find "$out/koala" -name '*.png' | wc -l) masks of 8K, with job.json that describes them"
echo "  $out/koala.svg     one group a layer, true millimetres"
echo "  $out/koala.gcode   for a Marlin printer"
echo "  $out/koala.png     a picture of it, cut open"

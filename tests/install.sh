#!/usr/bin/env bash
# Installs the library to a scratch folder and builds and runs a program against the installed package.
set -euo pipefail
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install build/release --prefix "$scratch/prefix" >/dev/null
cmake -S examples/embedding -B "$scratch/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_PREFIX_PATH="$scratch/prefix" >/dev/null
cmake --build "$scratch/build" | tail -n 1
"$scratch/build/print_areas"
"$scratch/prefix/bin/lamella" --version
# Needs the module for images, which must be found from where the program was installed to.
env -u LD_LIBRARY_PATH "$scratch/prefix/bin/lamella" preview --shape sphere --shape-radius 5 --size 64 -q -o "$scratch/ball.png"

#!/usr/bin/env bash
# Layers are the same bytes from every compiler and optimisation level: builds the hash program two more ways and compares.
# Usage: tests/same_bytes.sh [ways as "COMPILER TYPE"]
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- "g++ Debug" "clang++ Release"
for way in "$@"; do
    read -r compiler type <<<"$way"
    build=build/same-$compiler-$type
    cmake -S . -B "$build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE="$type" -DCMAKE_CXX_FLAGS_DEBUG=-O0 >/dev/null
    cmake --build "$build" --target lamella_hashes | tail -n 1
    "$build/tests/lamella_hashes" | diff tests/golden/hashes.txt -
    echo "same bytes: $compiler $type"
done

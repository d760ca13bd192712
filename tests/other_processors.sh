#!/usr/bin/env bash
# Layers are the same bytes on other processors: builds the hash program and the command for arm64 and armhf with Debian's
# cross compilers, runs them under qemu, and joins shards of both kinds of computer into one file.
# Usage: tests/other_processors.sh [arm64] [armhf], default both. Half an hour each on two cores, the first time.
set -euo pipefail
cd "$(dirname "$0")/.."
architectures=("$@")
[ $# -gt 0 ] || architectures=(arm64 armhf)
bash cmake/install_packages.sh cmake/packages-build.txt packaging/packages-tools.txt
cmake --preset release >/dev/null
cmake --build build/release --target lamella_command -- --quiet
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
own=build/release/lamella
job=(examples/koala.toml --layer-height 1 --printer svg -q)
"$own" slice "${job[@]}" -o "$scratch/whole.svg"

for arch in "${architectures[@]}"; do
    bash cmake/install_packages.sh "packaging/packages-$arch.txt"
    sysroot=$PWD/build/packages/sysroot-$arch
    bash packaging/sysroot.sh "$arch" "$sysroot"
    build=build/packages-$arch
    cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DLAMELLA_TESTS=ON \
        -DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON -DLAMELLA_LINKER= -DCMAKE_TOOLCHAIN_FILE="$PWD/packaging/toolchain.cmake" \
        -DLAMELLA_ARCH="$arch" -DLAMELLA_SYSROOT="$sysroot" >/dev/null
    cmake --build "$build" --target lamella_hashes lamella_command -- --quiet
    case $arch in arm64) emulator=qemu-aarch64-static ;; armhf) emulator=qemu-arm-static ;; esac
    emulated=("$emulator" -L "$sysroot")

    "${emulated[@]}" "$build/tests/lamella_hashes" | diff tests/golden/hashes.txt -
    echo "other processors: $arch makes the golden hashes"

    "$own" slice "${job[@]}" --layers 0:20 --shard "$scratch/own.shard"
    "${emulated[@]}" "$build/lamella" slice "${job[@]}" --layers 20:43 --shard "$scratch/other.shard"
    "$own" join "${job[@]}" --shards "$scratch/own.shard" "$scratch/other.shard" -o "$scratch/joined.svg"
    cmp "$scratch/whole.svg" "$scratch/joined.svg"
    rm "$scratch"/*.shard "$scratch/joined.svg"
    echo "other processors: a shard of $arch and one of $(dpkg --print-architecture) join to the same file"
done

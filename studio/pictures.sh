#!/usr/bin/env bash
# Makes src/start/pictures/: a picture of each example that the start page shows, cut open as its header says. Needs
# imagemagick. Usage: bash studio/pictures.sh [lamella command, default build/release/lamella] [names of examples]
set -euo pipefail
cd "$(dirname "$0")/.."
lamella=${1:-build/release/lamella}
shift || true
names=("$@")
# The list of CMakeLists.txt, which puts the recipes into the program.
[ ${#names[@]} -gt 0 ] || mapfile -t names < <(sed -n '/set(shipped_examples/,/)/p' CMakeLists.txt | grep -o '[a-z_]*\.toml')
folder=studio/src/start/pictures
mkdir -p "$folder"
picture=$(mktemp --suffix .png)
trap 'rm -f "$picture"' EXIT
for name in "${names[@]%.toml}"; do
    recipe=examples/$name.toml
    cut=$(sed -n 's/^#.*lamella preview.* --cut \([a-z]*\).*/\1/p' "$recipe" | head -n 1)
    "$lamella" preview -q "$recipe" --cut "${cut:-x}" --size 480 -o "$picture"
    convert "$picture" -resize 200x200 -strip -quality 65 "$folder/$name.webp"
done

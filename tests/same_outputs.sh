#!/usr/bin/env bash
# Compares the outputs of two builds of lamella, byte by byte: every recipe of examples/ as masks, SL1, SVG, G-code and 3MF,
# its check, and the program's tables. For changes that must not change a byte.
# Usage: tests/same_outputs.sh OLD_LAMELLA NEW_LAMELLA [recipes, default all of examples/]
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -ge 2 ] || { echo "usage: tests/same_outputs.sh OLD_LAMELLA NEW_LAMELLA [recipes]" >&2; exit 2; }
programs=("$(realpath "$1")" "$(realpath "$2")")
shift 2
recipes=("$@")
[ ${#recipes[@]} -gt 0 ] || recipes=(examples/*.toml)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# The hashes of all that one program makes of one recipe. What it refuses is part of the result: exit code and message.
hash_outputs() {
    local lamella=$1 recipe=$2 hashes=$3 folder
    folder=$(mktemp -d -p "$scratch")
    export XDG_CACHE_HOME=$scratch/$(basename "$folder")_cache  # no plan of an earlier run
    for output in masks:png out.sl1:sl1 out.svg:svg out.gcode:marlin out.3mf:3mf; do
        echo "$output" "$("$lamella" slice "$recipe" --printer "${output#*:}" --layer-height 0.4 --quiet --threads 1 \
            -o "$folder/${output%%:*}" 2>&1 | sed "s#$folder##g"; echo "exit ${PIPESTATUS[0]}")"
    done >"$folder/messages"
    "$lamella" check "$recipe" --json --quiet >"$folder/check.json" 2>&1 || echo "exit $?" >>"$folder/messages"
    (cd "$folder" && find . -type f | sort | xargs sha256sum) >"$hashes"
    rm -rf "$folder"
}
export -f hash_outputs
export scratch

for k in 0 1; do
    mkdir "$scratch/$k"
    for table in "keys" "printers" "materials" "--version"; do
        "${programs[$k]}" $table >"$scratch/$k/table_${table#--}" 2>&1
    done
    for printer in $("${programs[$k]}" printers | awk '/^  [a-z]/ { print $1 }'); do
        "${programs[$k]}" printers "$printer" >"$scratch/$k/printer_$printer" 2>&1 || true
    done
done
for recipe in "${recipes[@]}"; do
    for k in 0 1; do
        printf '%s\0%s\0%s\0' "${programs[$k]}" "$recipe" "$scratch/$k/$(basename "$recipe").sha256"
    done
done | xargs -0 -n 3 -P "$(nproc)" bash -c 'hash_outputs "$@"' hash_outputs
diff -r "$scratch/0" "$scratch/1"
echo "same outputs: $(cat "$scratch"/0/*.sha256 | wc -l) files of ${#recipes[@]} recipes"

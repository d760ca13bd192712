#!/usr/bin/env bash
# Lets other programs read what lamella writes: slicers, renderers and parsers from Debian and npm, none of which
# shares code with it. Usage: tests/formats.sh [lamella, default build/release/lamella] [checks, default all]
set -euo pipefail
cd "$(dirname "$0")/.."
lamella=$(realpath "${1:-build/release/lamella}")
[ $# -gt 0 ] && shift
bash cmake/install_packages.sh cmake/packages-formats.txt
command -v npm >/dev/null || bash cmake/install_packages.sh <(printf 'nodejs\nnpm\n')
work=$PWD/build/formats
mkdir -p "$work"
cp tests/formats/package.json tests/formats/*.mjs "$work"
(cd "$work" && npm install --no-package-lock --no-audit --no-fund --silent)
checks=("$@")
[ ${#checks[@]} -gt 0 ] || mapfile -t checks < <(cd tests/formats && ls check_*.mjs)
passed=0 failed=0
for check in "${checks[@]}"; do
    rm -rf "$work/out"
    mkdir -p "$work/out"
    if (cd "$work/out" && LAMELLA=$lamella SOURCES=$OLDPWD node "$work/$check"); then
        passed=$((passed + 1))
    else
        echo "formats: $check failed" >&2
        failed=$((failed + 1))
    fi
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]

#!/usr/bin/env bash
# Drives the studio's page in a browser: against a mock of the server, and against the program itself. The packages lie in
# build/studio_tests. Usage: tests/studio.sh [build directory, default build/release]
set -euo pipefail
cd "$(dirname "$0")/.."
build=$(realpath "${1:-build/release}")
[ -x "$build/lamella" ] || { echo "studio: $build has no lamella; build it first" >&2; exit 2; }
command -v npm >/dev/null || bash cmake/install_packages.sh <(printf 'nodejs\nnpm\n')
command -v chromium >/dev/null || bash cmake/install_packages.sh <(printf 'chromium\n')
work=build/studio_tests
mkdir -p "$work"
rm -rf "$work/src" "$work/test" "$work/mock"
cp -r studio/package.json studio/package-lock.json studio/tsconfig.json studio/build.mjs studio/src studio/test studio/mock "$work"
cd "$work"
npm ci --no-audit --no-fund --silent
npm run build --silent
export LAMELLA="$build/lamella" LAMELLA_MODELS="$OLDPWD/examples/models"
drive() { node --test --test-concurrency=1 --test-reporter=spec "$1"; }
failed=()
for file in test/*.test.mjs; do drive "$file" || failed+=("$file"); done
# Without a graphics card and beside other work a browser may miss an event: what fails twice is wrong.
for file in "${failed[@]}"; do
    echo "studio: $file once more"
    drive "$file"
done

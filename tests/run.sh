#!/usr/bin/env bash
# Builds and runs the whole test suite. Usage: tests/run.sh [preset, default release] [ctest options]
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
[ $# -gt 0 ] && shift
bash cmake/install_packages.sh cmake/packages-build.txt cmake/packages-test.txt
cmake --preset "$preset" >/dev/null
cmake --build "build/$preset" | tail -n 1
export TSAN_OPTIONS=${TSAN_OPTIONS:-suppressions=$PWD/tests/tsan.supp}
ctest --test-dir "build/$preset" --output-on-failure -j "$(nproc)" "$@"

#!/usr/bin/env bash
# Builds and runs the whole test suite. Usage: tests/run.sh [preset, default release] [ctest options]
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
[ $# -gt 0 ] && shift
bash cmake/install_packages.sh cmake/packages-build.txt cmake/packages-test.txt
cmake --preset "$preset" >/dev/null
build=(cmake --build "build/$preset")
[ -t 1 ] || build+=(-- --quiet)  # a terminal shows in one line how far it is
"${build[@]}"
# Suppressions name what the earlier access was in: a long history keeps its stack on a busy machine, too.
export TSAN_OPTIONS=${TSAN_OPTIONS:-suppressions=$PWD/tests/tsan.supp:history_size=7}
export LSAN_OPTIONS=${LSAN_OPTIONS:-suppressions=$PWD/tests/lsan.supp:print_suppressions=0}
ctest --test-dir "build/$preset" --output-on-failure -j "$(nproc)" "$@"

#!/usr/bin/env bash
# Builds and runs the benchmarks. Arguments go to Google Benchmark, e.g. --benchmark_filter=foam_spans_8k
set -euo pipefail
cd "$(dirname "$0")/.."
bash cmake/install_packages.sh cmake/packages-build.txt cmake/packages-test.txt
cmake -S . -B build/bench -G Ninja -DCMAKE_BUILD_TYPE=Release -DLAMELLA_TESTS=OFF -DLAMELLA_BENCH=ON >/dev/null
cmake --build build/bench --target lamella_bench lamella_png_bench | tail -n 1
build/bench/tests/bench/lamella_bench "$@"
build/bench/tests/bench/lamella_png_bench "$@"

#!/usr/bin/env bash
# Runs clang-tidy with .clang-tidy. Usage: tests/lint.sh [sources, default all, in the batches that the build compiles]
set -euo pipefail
cd "$(dirname "$0")/.."
build=build/lint
cmake -S . -B $build -G Ninja -DCMAKE_BUILD_TYPE=Release -DLAMELLA_TESTS=OFF -DLAMELLA_UNITY=$([ $# -eq 0 ] && echo ON || echo OFF) \
    -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ >/dev/null
# Generated sources alone: as a target, each would wait for all libraries before it.
for source in profile_texts.cpp shipped_materials.cpp shipped_foam_laws.cpp; do
    (cd $build && sh -c "$(ninja -t commands -s $source)")
done
if [ $# -eq 0 ]; then
    # Alone stand modules and programs, and the SIMD kernels: those include themselves once per target, which clang-tidy
    # reads as recursion.
    mapfile -t files < <(find $build/CMakeFiles -path '*/Unity/*.cxx' | sort; git ls-files 'engine/io/modules/*.cpp' 'app/ranks/modules/*.cpp' 'app/commands/main.cpp' 'app/commands/operator_new.cpp')
    set -- "${files[@]}"
fi
# Sources are headers of a batch. The compiler looks for reserved names, empty bodies and null texts in a fraction of the
# time that clang-tidy's own checks for them take: those are off in .clang-tidy.
printf '%s\n' "$@" | xargs -P "$(nproc)" -n 1 clang-tidy -p $build --quiet --checks=-bugprone-suspicious-include \
    --header-filter="^$PWD/(engine|procedural|printers|recipe|hosts|bindings|app)/.*" --extra-arg=-Wreserved-identifier 2>/dev/null
echo "lint: clang-tidy has nothing to say about $# sources or batches of them"

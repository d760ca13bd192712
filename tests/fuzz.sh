#!/usr/bin/env bash
# Fuzzes every reader for some time each, under the address and undefined-behaviour sanitizers, and keeps what reaches
# new code in build/fuzz/corpus. Usage: tests/fuzz.sh [seconds each, default 60] [targets, default all]
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
[ $# -gt 0 ] && shift
build=build/fuzz
cmake -S . -B $build -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1 -DNDEBUG" \
    -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DLAMELLA_TESTS=OFF -DLAMELLA_FUZZ=ON \
    -DLAMELLA_SANITIZE=address,undefined >/dev/null
targets=("$@")
[ ${#targets[@]} -gt 0 ] ||
    mapfile -t targets < <(sed -n 's/^foreach(format \(.*\))$/\1/p' tests/fuzz/CMakeLists.txt | tr ' ' '\n')
cmake --build $build --target "${targets[@]/#/fuzz_}" | tail -n 1
export LSAN_OPTIONS=suppressions=$PWD/tests/lsan.supp:print_suppressions=0
# What tests read already is where the fuzzers begin, beside small files made for them.
declare -A seeds=([stl]='*.stl' [obj]='*.obj' [ply]='*.ply' [3mf]='*.3mf' [attribute]='*.ply' [picture]='*.png' [recipe]='*.toml' [svg]='*.svg')
declare -A words=([attribute]=ply [volumetric]=model)
python3 tests/fuzz/seeds.py $build/seeds
for target in "${!seeds[@]}"; do
    mkdir -p "$build/seeds/$target"
    git ls-files "examples/${seeds[$target]}" "tests/models/${seeds[$target]}" |
        while read -r file; do find "$file" -size -16k -exec cp -t "$build/seeds/$target" {} +; done
done
run_target() {
    local corpus=$build/corpus/$1 findings=$build/findings/$1 known=$build/seeds/$1 options=()
    mkdir -p "$corpus" "$findings" "$known"
    for dictionary in tests/fuzz/"${words[$1]:-$1}".dict "$build/seeds/$1.dict"; do
        [ ! -f "$dictionary" ] || options+=("-dict=$dictionary")
    done
    "$build/tests/fuzz/fuzz_$1" -max_total_time="$seconds" -rss_limit_mb=4096 -timeout=60 -print_final_stats=1 \
        "${options[@]}" -artifact_prefix="$findings/" "$corpus" "$known" >"$build/$1.log" 2>&1 ||
        echo "fuzz: $1 found something, see $build/$1.log" >&2
    awk -v name="$1" '/stat::number_of_executed_units/ { print "fuzz: " name ": " $2 " runs" }' "$build/$1.log"
}
for target in "${targets[@]}"; do
    run_target "$target" &
    [ "$(jobs -rp | wc -l)" -lt "$(nproc)" ] || wait -n
done
wait
rm -rf /dev/shm/lamella_fuzz_*
! find $build/findings -type f | grep .

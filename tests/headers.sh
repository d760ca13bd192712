#!/usr/bin/env bash
# Compiles each header alone: whoever includes it needs no other before it.
# Usage: tests/headers.sh [headers, default those that are installed; all: every one, which takes ten minutes]
set -euo pipefail
cd "$(dirname "$0")/.."
build=build/headers
cmake -S . -B $build -G Ninja -DLAMELLA_TESTS=OFF -DLAMELLA_UNITY=OFF >/dev/null
# One set of flags that fits all: that of the command's sources.
flags=$(python3 - $build <<'PY'
import json, re, sys
flags = []
for entry in json.load(open(sys.argv[1] + "/compile_commands.json")):
    for flag in re.findall(r"-isystem \S+|-[IDW]\S+|-std=\S+", entry["command"]):
        if flag not in flags and "LAMELLA_MODULE_FOLDER" not in flag:
            flags.append(flag)
print(" ".join(flags).replace('\\"', '"'))
PY
)
export flags
if [ $# -eq 0 ]; then
    # shellcheck disable=SC2086 # flags are words
    mapfile -t headers < <(g++ $flags -I. -MM -x c++ bindings/lamella.hpp |
        grep -oE '(engine|procedural|printers|recipe|bindings)/[^ ]*')
    set -- "${headers[@]}"
elif [ "$*" = all ]; then
    # *-inl.h are parts of the SIMD kernels, compiled once per target.
    mapfile -t headers < <(git ls-files 'engine/*.h' 'procedural/*.h' 'printers/*.h' 'recipe/*.h' 'hosts/*.h' 'bindings/*.h' 'app/*.h' | grep -v -- '-inl\.h$' | sort -u)
    set -- "${headers[@]}"
fi
printf '%s\n' "$@" | xargs -P "$(nproc)" -I{} sh -c 'echo "#include \"{}\"" | g++ $flags -I. -fsyntax-only -x c++ - || exit 255'
echo "headers: each of $# compiles alone"

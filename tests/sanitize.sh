#!/usr/bin/env bash
# Runs the test suite under the address and undefined-behaviour sanitizers, and what uses threads under the thread
# sanitizer. Takes an hour or two. Usage: tests/sanitize.sh [asan|tsan, default both]
set -euo pipefail
cd "$(dirname "$0")/.."
kinds=("$@")
[ ${#kinds[@]} -gt 0 ] || kinds=(asan tsan)
# The command finds its modules beside itself only where LD_LIBRARY_PATH says so: the sanitizer's loader looks first.
for kind in "${kinds[@]}"; do
    export LD_LIBRARY_PATH=$PWD/build/$kind
    case $kind in
        # Frames are larger: std::regex, which tests read files with, recurses once a character.
        asan) ulimit -s 131072; bash tests/run.sh asan ;;
        tsan) bash tests/run.sh tsan -R 'thread|parallel|stream|ranks|pipeline|cancel|processes|at once' ;;
        *) echo "tests/sanitize.sh: there is no '$kind'; accepted: asan, tsan" >&2; exit 2 ;;
    esac
done

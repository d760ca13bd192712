#!/usr/bin/env bash
# Sends jobs and files to stand-ins of network hosts, written from the hosts' published texts, and breaks what can break.
# Usage: tests/hosts.sh [build directory, default build/release]; LAMELLA_HOST_FAULTS=200 and LAMELLA_HOST_STREAMS=20 for
# more runs than a change needs.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$(realpath "${1:-build/release}")
[ -x "$build/lamella" ] || { echo "hosts: $build has no lamella; build it first" >&2; exit 2; }
command -v npm >/dev/null || bash cmake/install_packages.sh <(printf 'nodejs\nnpm\n')
command -v openssl >/dev/null || bash cmake/install_packages.sh <(printf 'openssl\n')
work=build/host_tests
mkdir -p "$work"
rm -rf "$work/standins" "$work/test"
cp -r tests/hosts/package.json tests/hosts/package-lock.json tests/hosts/standins tests/hosts/test "$work"
cd "$work"
npm ci --no-audit --no-fund --silent
export LAMELLA="$build/lamella"
node --test --test-reporter=spec test/

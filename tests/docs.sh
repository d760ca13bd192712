#!/usr/bin/env bash
# Checks the documentation: runs its commands and recipes, follows its links, looks for the sources that it names, and
# measures its pages.
# Usage: tests/docs.sh [lamella binary, default build/release/lamella] [pages, default *.md and all docs/**/*.md]
#
# Blocks are marked by the words behind the fence:
#   ```sh                    runs with `set -e`, in a scratch folder of its page that looks like the repository's root
#   ```sh exits-1            the same, and has to end with exit code 1
#   ```sh no-run             is not run; the line above says why: <!-- not run: needs a printer -->
#   ```toml recipe [FILE]    a whole recipe: `lamella info` has to take it; later blocks of the page find it as FILE
set -euo pipefail
cd "$(dirname "$0")/.."
lamella=${1:-build/release/lamella}
[ $# -gt 0 ] && shift
exec python3 tests/docs/blocks.py "$lamella" "$@"

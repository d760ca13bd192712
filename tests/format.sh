#!/usr/bin/env bash
# Checks that every source file is formatted by .clang-format.
set -euo pipefail
cd "$(dirname "$0")/.."
git ls-files '*.h' '*.cpp' | xargs clang-format --dry-run --Werror
echo "format: every file is as clang-format wants it"

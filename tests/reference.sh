#!/usr/bin/env bash
# Compares docs/reference with what the program says of itself. Usage: tests/reference.sh [lamella, default
# build/release/lamella] [--update: writes the pages anew]
set -euo pipefail
cd "$(dirname "$0")/.."
lamella=${1:-build/release/lamella}
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
"$lamella" keys --markdown >"$made/recipe.md"
{
    printf '# Commands\n\nMade by `tests/reference.sh LAMELLA --update` from the help of each command. Options that stand for\n'
    printf 'keys of a recipe are in [recipe.md](recipe.md).\n'
    for command in $("$lamella" --help | sed -n '/^Subcommands:/,$p' | awk '/^  [a-z]/ && !/lamella/ { print $1 }'); do
        printf '\n## lamella %s\n\n```text\n' "$command"
        "$lamella" "$command" --help | sed 's/[[:space:]]*$//' | cat -s
        printf '```\n'
    done
} >"$made/cli.md"
if [ "${2:-}" = --update ]; then
    mkdir -p docs/reference
    cp "$made"/*.md docs/reference/
elif ! diff -r docs/reference "$made"; then
    echo "reference: docs/reference is not what the program says; bash tests/reference.sh $lamella --update" >&2
    exit 1
fi
echo "reference: docs/reference is what the program says"

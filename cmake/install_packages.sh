#!/usr/bin/env bash
# Installs the Debian packages named in the given lists, those that are missing; says which. Works as root or by sudo.
set -euo pipefail

missing=()
for list in "$@"; do
    while read -r package; do
        [ -n "$package" ] || continue
        dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q '^install ok installed' || missing+=("$package")
    done <"$list"
done
if [ ${#missing[@]} -eq 0 ]; then
    exit 0
fi
echo "Installing these Debian packages: ${missing[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "Please install them as root, then run this again." >&2; exit 3; }
    as_root=(sudo)
fi
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null

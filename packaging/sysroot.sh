#!/usr/bin/env bash
# Unpacks what Lamella is built against for another Debian architecture into a folder; nothing of it is installed or run.
# Usage: packaging/sysroot.sh arm64|armhf FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
arch=$1
folder=$2
[ -e "$folder/complete" ] && exit 0
# The tools run here, the libraries belong to the other architecture.
packages=$(grep -vxE 'cmake|g\+\+|ninja-build|pkg-config' cmake/packages-build.txt | paste -sd,)
rm -rf "$folder"
mmdebstrap --variant=extract --architectures="$arch" --aptopt='APT::Install-Recommends "false"' \
    --skip=cleanup/apt --include="$packages,catch2" --quiet bookworm "$folder" "${LAMELLA_MIRROR:-http://deb.debian.org/debian}"
# Links by whole paths would lead out of the folder.
find "$folder" -lname '/*' -print0 | while IFS= read -r -d '' link; do
    ln -sfnr "$folder$(readlink "$link")" "$link"
done
touch "$folder/complete"

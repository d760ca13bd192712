#!/usr/bin/env bash
# Writes what dpkg would know of the packages of a sysroot, as far as dpkg-shlibdeps asks: which package has a library,
# and which version a symbol needs. Usage: packaging/admin_folder.sh SYSROOT FOLDER
set -euo pipefail
sysroot=$(realpath "$1")
admin=$2
[ -e "$admin/status" ] && exit 0
rm -rf "$admin"
mkdir -p "$admin/info" "$admin/updates"
control=$(mktemp -d)
trap 'rm -rf "$control"' EXIT
for package in "$sysroot"/var/cache/apt/archives/*.deb; do
    rm -rf "${control:?}"/*
    dpkg-deb --control "$package" "$control"
    # Only packages with shared libraries are asked for.
    [ -e "$control/shlibs" ] || [ -e "$control/symbols" ] || continue
    name=$(sed -n 's/^Package: //p' "$control/control"):$(sed -n 's/^Architecture: //p' "$control/control")
    grep -q '^Multi-Arch: same' "$control/control" || name=${name%:*}
    { echo 'Status: install ok installed'; cat "$control/control"; echo; } >>"$admin/status.part"
    for part in shlibs symbols; do
        [ ! -e "$control/$part" ] || cp "$control/$part" "$admin/info/$name.$part"
    done
    dpkg-deb --fsys-tarfile "$package" | tar -t | sed -n "s|^\./|$sysroot/|p" >"$admin/info/$name.list"
done
echo 1 >"$admin/info/format"
mv "$admin/status.part" "$admin/status"

#!/usr/bin/env bash
# dpkg-shlibdeps as CPack calls it. Modules are left out: what they need is recommended and not required. For another
# architecture, LAMELLA_SYSROOT has the libraries, and LAMELLA_ADMIN says which packages they belong to.
set -euo pipefail
arguments=()
for argument in "$@"; do
    case $argument in
        *lamella_images.so | *lamella_mpi.so) ;;
        *) arguments+=("$argument") ;;
    esac
done
if [ -n "${LAMELLA_SYSROOT:-}" ]; then
    for folder in "$LAMELLA_SYSROOT"/lib/*-linux-gnu* "$LAMELLA_SYSROOT"/usr/lib/*-linux-gnu*; do
        arguments=("-l$folder" "${arguments[@]}")
    done
    arguments=("--admindir=$LAMELLA_ADMIN" "${arguments[@]}")
fi
exec dpkg-shlibdeps "${arguments[@]}"

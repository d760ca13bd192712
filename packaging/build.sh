#!/usr/bin/env bash
# Builds packages of Lamella into build/packages/: Debian packages of each architecture named, a portable archive and a
# Python wheel of each. Usage: packaging/build.sh [amd64] [arm64] [armhf], default all three. The computer's own is built
# as usual, the others with Debian's cross compilers. Everything comes from Debian.
set -euo pipefail
cd "$(dirname "$0")/.."
own=$(dpkg --print-architecture)
architectures=("$@")
[ $# -gt 0 ] || architectures=(amd64 arm64 armhf)
bash cmake/install_packages.sh cmake/packages-build.txt packaging/packages-tools.txt
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct)}
export SOURCE_DATE_EPOCH
out=$PWD/build/packages
mkdir -p "$out"

for arch in "${architectures[@]}"; do
    build=build/packages-$arch
    options=(-G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DLAMELLA_PACKAGES=ON -DLAMELLA_LINKER=
        -DLAMELLA_TESTS=OFF -DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON
        "-DCMAKE_EXE_LINKER_FLAGS_INIT=-Wl,-z,relro,-z,now" "-DCMAKE_SHARED_LINKER_FLAGS_INIT=-Wl,-z,relro,-z,now"
        "-DCMAKE_MODULE_LINKER_FLAGS_INIT=-Wl,-z,relro,-z,now")
    unset LAMELLA_SYSROOT LAMELLA_ADMIN
    if [ "$arch" != "$own" ]; then
        bash cmake/install_packages.sh "packaging/packages-$arch.txt"
        export LAMELLA_SYSROOT=$out/sysroot-$arch LAMELLA_ADMIN=$out/admin-$arch
        bash packaging/sysroot.sh "$arch" "$LAMELLA_SYSROOT"
        bash packaging/admin_folder.sh "$LAMELLA_SYSROOT" "$LAMELLA_ADMIN"
        options+=("-DCMAKE_TOOLCHAIN_FILE=$PWD/packaging/toolchain.cmake" "-DLAMELLA_ARCH=$arch"
            "-DLAMELLA_SYSROOT=$LAMELLA_SYSROOT")
    fi
    echo "Building for $arch"
    cmake -S . -B "$build" "${options[@]}" >/dev/null
    cmake --build "$build" --target lamella_command lamella_c lamella_images -- --quiet
    rm -rf "$build/debs"
    (cd "$build" && cpack -G DEB -B "$PWD/debs" -D SHLIBDEPS_EXECUTABLE="$OLDPWD/packaging/shlibdeps.sh" >cpack.log) ||
        { cat "$build/cpack.log" >&2; exit 3; }
    cp "$build"/debs/*.deb "$out/"

    rm -rf "$build/stage"
    DESTDIR=$build/stage cmake --install "$build" --strip >/dev/null
    python3 packaging/portable.py --stage "$build/stage/usr" --arch "$arch" --output "$out"
    cp "$build"/packages/*.yaml "$out/"
    python3 packaging/wheel.py --stage "$build/stage/usr" --arch "$arch" --output "$out"
done
(cd "$out" && ls -l ./*.deb ./*.tar.gz ./*.whl)

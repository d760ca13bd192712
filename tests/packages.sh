#!/usr/bin/env bash
# Checks the packages of this computer's architecture, as `bash packaging/build.sh amd64` made them: lintian, validators,
# a clean minimal Debian in which they are installed, used and removed, the portable archive beside nothing but glibc, and
# the wheel in a fresh environment. Needs root, for chroot. Usage: tests/packages.sh [folder, default build/packages]
set -euo pipefail
cd "$(dirname "$0")/.."
packages=$(realpath "${1:-build/packages}")
bash cmake/install_packages.sh packaging/packages-tools.txt packaging/packages-test.txt
arch=$(dpkg --print-architecture)
scratch=$(mktemp -d)
trap 'rm -rf --one-file-system "$scratch"' EXIT
fail() { echo "packages: $*" >&2; exit 1; }
debs=("$packages"/*_"$arch".deb "$packages"/*_all.deb)
[ ${#debs[@]} -eq 4 ] || fail "${#debs[@]} Debian packages instead of 4 in $packages"

lintian --fail-on error --tag-display-limit 0 "${debs[@]}" 2>&1 | sed '/running with root privileges/d'
echo "packages: lintian finds no error"

mkdir "$scratch/unpacked"
for deb in "${debs[@]}"; do dpkg-deb -x "$deb" "$scratch/unpacked"; done
share=$scratch/unpacked/usr/share
desktop-file-validate "$share"/applications/*.desktop
appstreamcli validate --no-net "$share"/metainfo/*.xml
xmllint --noout "$share"/mime/packages/*.xml
cp -r "$share/mime" "$scratch/mime"
XDG_DATA_DIRS=$scratch update-mime-database "$scratch/mime"
(cd "$scratch" && flatpak-builder --show-manifest "$packages"/*.yaml >/dev/null)
# The program that the services start is not installed here.
sed "s|/usr/bin/lamella|/bin/true|" -i "$scratch"/unpacked/usr/lib/systemd/user/*.service
XDG_RUNTIME_DIR=$scratch SYSTEMD_UNIT_PATH=$scratch/unpacked/usr/lib/systemd/user: systemd-analyze --user --man=no verify \
    "$scratch"/unpacked/usr/lib/systemd/user/*.service
for page in "$share"/man/man1/*.1.gz; do
    [ -z "$(man --warnings -E UTF-8 -l -Tutf8 -Z "$page" 2>&1 >/dev/null)" ] || fail "man warns of $page"
done
echo "packages: menu entry, metainfo, types, services and pages are valid"

root=$scratch/root
mmdebstrap --quiet --variant=minbase bookworm "$root" "${LAMELLA_MIRROR:-http://deb.debian.org/debian}"
in_root() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"; }
in_root apt-get -qq update
# What installing changes for good: lists, caches and logs of apt, of the linker and of the users' databases.
files() { (cd "$root" && find . -xdev \( -path ./var/lib/apt -o -path ./var/cache -o -path ./var/log -o -path ./root \
    -o -path ./tmp -o -path ./var/lib/dpkg \) -prune -o -print | LC_ALL=C sort); }
files >"$scratch/before"
size_before=$(du -sxk "$root" | cut -f 1)
cp "${debs[@]}" "$root/tmp/"
[ -z "$(in_root sh -c 'command -v gcc g++ cc cmake make' || true)" ] || fail "the clean root has compilers"
begin=$SECONDS
in_root sh -c "apt-get install -qq --no-install-recommends /tmp/lamella_*.deb /tmp/liblamella1_*.deb \
    /tmp/python3-lamella_*.deb" >"$scratch/install.log" 2>&1 || { tail -n 20 "$scratch/install.log" >&2; exit 1; }
in_root apt-get clean
echo "packages: installed in $((SECONDS - begin)) s," \
    "$((($(du -sxk "$root" | cut -f 1) - size_before) / 1024)) MiB with all they need"

# The commands of the quick start.
in_root sh -ec '
    cd /root
    koala=/usr/share/lamella/examples/koala.toml
    lamella slice $koala -q -o koala
    lamella slice $koala -q --printer svg --layer-height 0.5 -o koala.svg
    lamella slice $koala -q --printer marlin --layer-height 0.2 -o koala.gcode
    lamella preview $koala -q --cut x -o koala.png
    ls koala | grep -c "png$" | grep -qx 854
    test -s koala.svg -a -s koala.gcode'
pngcheck -q "$root/root/koala.png"
cp "$root/root/koala.png" "$packages/koala-of-the-clean-root.png"
in_root python3 -c '
import lamella
job = lamella.Recipe.read("/usr/share/lamella/examples/sphere_foam.toml").build()
section = job.section(job.layer_z(job.layer_count // 2))
assert len(section.contours(tolerance=0.02)) > 10'
echo "packages: the quick start runs in a clean minimal Debian, and Python reads sections"

in_root sh -c "apt-get purge -qq lamella liblamella1 python3-lamella && apt-get autoremove -qq --purge" >/dev/null 2>&1
files >"$scratch/after"
diff "$scratch/before" "$scratch/after" || fail "files are left, or missing, after the packages were removed"
echo "packages: removed, nothing is left"

# An empty root with glibc: what a bare system has.
bare=$scratch/bare
mkdir -p "$bare/lib64" "$bare/tmp" "$bare/root"
for library in ld-linux-x86-64.so.2 libc.so.6 libm.so.6 libdl.so.2 libpthread.so.0 librt.so.1 libresolv.so.2; do
    path=$(find /lib64 /lib/x86_64-linux-gnu -maxdepth 1 -name "$library" | head -n 1)
    mkdir -p "$bare/lib/x86_64-linux-gnu"
    cp -L "$path" "$bare/lib/x86_64-linux-gnu/"
done
cp -L /lib64/ld-linux-x86-64.so.2 "$bare/lib64/"
tar -xzf "$packages"/lamella-*-linux-x86_64.tar.gz -C "$bare"
program=$(cd "$bare" && ls -d lamella-*)
# The loader asks /proc where the program lies, and there is none here.
bare_lamella() { LD_ORIGIN_PATH=/$program/bin chroot "$bare" "/$program/bin/lamella" "$@"; }
bare_lamella --version
bare_lamella slice "/$program/share/lamella/examples/koala.toml" -q --layer-height 1 --printer svg -o /root/koala.svg
bare_lamella preview "/$program/share/lamella/examples/koala.toml" -q --size 200 -o /root/koala.png
pngcheck -q "$bare/root/koala.png"
echo "packages: the portable archive runs beside glibc alone"

/usr/bin/python3 -m venv --system-site-packages "$scratch/venv"  # numpy is the system's
"$scratch/venv/bin/pip" install --quiet --no-index --no-deps "$packages"/lamella-*x86_64.whl
(cd "$scratch" && env -u LAMELLA_LIBRARY -u PYTHONPATH "$scratch/venv/bin/python" - "$OLDPWD/examples/sphere_foam.toml") <<'PYTHON'
import sys

import lamella
import numpy

assert lamella.__file__.startswith(sys.prefix), lamella.__file__
job = lamella.Recipe.read(sys.argv[1]).build()
section = job.section(job.layer_z(job.layer_count // 2))
points = [numpy.asarray(contour) for contour in section.contours(tolerance=0.02)]
assert len(points) > 10 and all(p.shape[1] == 2 for p in points)
print(f"packages: the wheel gives {len(points)} contours of a section as arrays")
PYTHON

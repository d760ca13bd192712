#!/usr/bin/env bash
# Installs the library to a scratch folder, and builds and runs programs and a plugin against the installed package.
set -euo pipefail
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install build/release --prefix "$scratch/prefix" >/dev/null
cmake -S examples/embedding -B "$scratch/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_PREFIX_PATH="$scratch/prefix" >/dev/null
cmake --build "$scratch/build" | tail -n 1
"$scratch/build/print_areas"
"$scratch/build/foam_in_polygons"
"$scratch/build/sphere_stack" "$scratch/ball.svg"

echo "install: the C++ headers that are public, all at once, and no more than they include"
[ "$(find "$scratch/prefix/include/lamella" -name '*.h' | wc -l)" -lt 130 ]
echo '#include <lamella/lamella.hpp>
int main() { return lamella::make_sphere({0, 0, 0}, 5)->value({0, 0, 0}) == -5 ? 0 : 1; }' >"$scratch/public.cpp"
g++ -std=c++20 -fsyntax-only -I"$scratch/prefix/include" -I"$scratch/prefix/include/lamella" "$scratch/public.cpp"

echo "install: nothing but the C interface is exported, under its version"
library=$scratch/prefix/lib/$(gcc -print-multiarch 2>/dev/null || true)
[ -e "$library/liblamella.so" ] || library=$(dirname "$(find "$scratch/prefix" -name liblamella.so | head -n 1)")
# Some linkers export the version itself as a name, others do not.
nm -D --defined-only "$library/liblamella.so" | awk '$3 != "LAMELLA_1" && $3 != "LAMELLA_1@@LAMELLA_1" { print $3 }' |
    sort >"$scratch/exported"
grep -oE '^LAMELLA_API [^(]*' bindings/lamella.h | awk '{ sub(/.*[ *]/, ""); print $0 "@@LAMELLA_1" }' |
    sort >"$scratch/declared"
diff "$scratch/declared" "$scratch/exported"

echo "install: with pkg-config, as C99 and as C++17"
export PKG_CONFIG_PATH=$library/pkgconfig
for build in "gcc -std=c99 -x c" "g++ -std=c++17 -x c++"; do
    echo '#include <lamella.h>
int main(void) { return lamella_abi_version() == LAMELLA_ABI_VERSION ? 0 : 1; }' |
        $build -Wall -Wextra -Werror -pedantic $(pkg-config --cflags lamella) - -o "$scratch/version" \
            -x none $(pkg-config --libs lamella) -Wl,-rpath,"$library"
    "$scratch/version"
done

echo "install: nothing is leaked or read wrongly, and many calls need no more memory than some"
# libhwy times itself at its start by an instruction that valgrind knows on some machines only: here it does not.
echo 'namespace hwy::platform { unsigned long TimerResolution() { return 1; } }' |
    g++ -std=c++17 -shared -fPIC -x c++ - -o "$scratch/no_timer.so"
LD_PRELOAD=$scratch/no_timer.so valgrind -q --error-exitcode=9 --leak-check=full "$scratch/build/foam_in_polygons" >/dev/null
gcc -std=c99 -O2 -Wall -Wextra -Werror -pedantic $(pkg-config --cflags lamella) tests/bindings/many_calls.c \
    $(pkg-config --libs lamella) -Wl,-rpath,"$library" -o "$scratch/many_calls"
"$scratch/many_calls" 10000

echo "install: Python"
python=$(command -v /usr/bin/python3 || command -v python3)
PYTHONPATH=$scratch/prefix/lib/python3/dist-packages LAMELLA_LIBRARY=$library/liblamella.so \
    "$python" examples/python/masks.py examples/sphere_foam.toml | tail -n 1

echo "install: a printer of one's own"
cmake -S examples/plugin -B "$scratch/plugin" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_PREFIX_PATH="$scratch/prefix" >/dev/null
cmake --build "$scratch/plugin" | tail -n 1
"$scratch/prefix/bin/lamella" slice --shape box --shape-size 4,5,3 --layer-height 1 -q \
    --plugin "$scratch/plugin/libarea_table.so" -o "$scratch/box.areas"
# Corners may be cut by the printer's tolerance, 0.02 mm: each by less than its square.
tail -n 1 "$scratch/box.areas" |
    awk -F, '{ print "area_table:", $0; exit !($1 == 2 && $2 == 1 && $3 > 20 - 4 * 0.0004 && $3 <= 20 && $4 == 1) }'

"$scratch/prefix/bin/lamella" --version
# Needs the module for images, which must be found from where the program was installed to.
env -u LD_LIBRARY_PATH "$scratch/prefix/bin/lamella" preview --shape sphere --shape-radius 5 --size 64 -q -o "$scratch/ball.png"

echo "install: completion of shells, and manual pages"
bash tests/completion.sh "$scratch/prefix"

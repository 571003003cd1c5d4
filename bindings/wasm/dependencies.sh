#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the libraries of the wasm preset in build/wasm-deps, from Debian's source packages. apt checks signatures and
# sums. A second run builds only missing libraries. Needs the Debian packages emscripten and dpkg-dev and, for libraries
# of headers alone, the packages of `lab`. Needs no root.
set -eu

root=$(dirname -- "$(readlink -f -- "$0")")/../..
mkdir -p "$root/build/wasm-deps/apt/lists" "$root/build/wasm-deps/source" "$root/build/wasm-deps/include" "$root/build/wasm-deps/lib"
deps=$(readlink -f "$root/build/wasm-deps")
features='-fwasm-exceptions -msimd128 -mbulk-memory -w'
small="-Oz $features" # a page loads them
# Debian's tools of emscripten look for modules of node here. node 18 and later take `fetch` for the file system.
export NODE_PATH=/usr/share/nodejs NODE_OPTIONS=--no-experimental-fetch

fail() {
  printf 'dependencies: %s\n' "$*" >&2
  exit 1
}
command -v emcc >/dev/null || fail "emcc is missing; as root, run: apt-get install -y --no-install-recommends emscripten"
command -v dpkg-source >/dev/null || fail "dpkg-source is missing; as root, run: apt-get install -y dpkg-dev"
for folder in eigen3/Eigen boost nlohmann CLI; do
  [ -d "/usr/include/$folder" ] || fail "/usr/include/$folder is missing; \`./lab build\` installs its package"
  ln -sfn "/usr/include/$folder" "$deps/include/${folder##*/}"
done

# This machine's sources of packages, for source packages.
release=$(. /etc/os-release && echo "$VERSION_CODENAME")
mkdir -p "$deps/apt/parts"
for list in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
  grep -qsE "^(Suites:|deb )(.* )?$release( |$)" "$list" || continue
  sed 's/^Types:.*/Types: deb-src/; s/^deb /deb-src /' "$list" >"$deps/apt/parts/${list##*/}"
done
apt() {
  apt-get -qq -o "Dir::State::Lists=$deps/apt/lists" -o Dir::Etc::SourceList=/dev/null \
    -o "Dir::Etc::SourceParts=$deps/apt/parts" -o APT::Sandbox::User= "$@"
}

# source NAME: the newest source package, unpacked and patched, in source/NAME.
source() {
  [ ! -d "$deps/source/$1" ] || return 0
  rm -rf "$deps/source/new"
  mkdir "$deps/source/new"
  (cd "$deps/source/new" && apt source --download-only "$1" && dpkg-source --no-check -x ./*.dsc "$deps/source/new/tree" >/dev/null)
  mv "$deps/source/new/tree" "$deps/source/$1"
}
# archive NAME COMPILER FILES..: lib/libNAME.a, compiled in the current folder.
archive() {
  name=$1 compiler=$2
  shift 2
  rm -rf "objects-$name"
  mkdir "objects-$name"
  printf '%s\n' "$@" | xargs -P "$(nproc)" -I{} sh -c '"$@" -o "objects-$0/$(basename {}).o"' "$name" \
    $compiler -I. -I"$deps/include" -c {}
  emar rcs "$deps/lib/lib$name.a" "objects-$name"/*.o
}
missing() { [ ! -f "$deps/lib/lib$1.a" ]; }

apt update
for name in lua5.4 zlib pugixml xxhash libmd libzip gmp mpfr4; do source "$name"; done

if missing lua; then
  cd "$deps/source/lua5.4/src"
  echo '#define DEB_HOST_MULTIARCH "wasm32"' >"$deps/include/lua5.4-deb-multiarch.h"
  cp lua.h luaconf.h lualib.h lauxlib.h lua.hpp "$deps/include"
  archive lua "em++ -O2 $features -x c++ -std=c++17" $(ls ./*.c | grep -vE '/(lua|luac)\.c$')
fi
if missing z; then
  cd "$deps/source/zlib"
  cp zlib.h zconf.h "$deps/include"
  archive z "emcc $small" ./*.c
fi
if missing pugixml; then
  cd "$deps/source/pugixml/src"
  cp pugixml.hpp pugiconfig.hpp "$deps/include"
  archive pugixml "em++ $small" pugixml.cpp
fi
if missing xxhash; then
  cd "$deps/source/xxhash"
  cp xxhash.h "$deps/include"
  archive xxhash "emcc $small" xxhash.c
fi
if missing md; then
  cd "$deps/source/libmd"
  cp include/md5.h include/sha2.h "$deps/include"
  : >src/config.h
  archive md "emcc $small -Iinclude -Isrc" src/md5.c src/sha2.c
fi
# Configuring takes minutes on one processor: libzip beside MPFR.
zip() {
  cd "$deps/source/libzip"
  # emscripten 3.1.6 reads the sizes of types as 9.
  emcmake cmake -S . -B build -DCMAKE_C_FLAGS="$small" -DBUILD_SHARED_LIBS=OFF \
    -DBUILD_TOOLS=OFF -DBUILD_REGRESS=OFF -DBUILD_EXAMPLES=OFF -DBUILD_DOC=OFF -DENABLE_BZIP2=OFF -DENABLE_LZMA=OFF \
    -DENABLE_OPENSSL=OFF -DENABLE_GNUTLS=OFF -DENABLE_MBEDTLS=OFF -DHAVE_SIZEOF_OFF_T=1 -DSIZEOF_OFF_T=8 \
    -DHAVE_SIZEOF_SIZE_T=1 -DSIZEOF_SIZE_T=4 -DZLIB_LIBRARY="$deps/lib/libz.a" -DZLIB_INCLUDE_DIR="$deps/include" \
    -DCMAKE_INSTALL_PREFIX="$deps" >configure.out 2>&1 || fail "cmake failed: $PWD/configure.out"
  cmake --build build --parallel --target install >make.out 2>&1 || fail "make failed: $PWD/make.out"
}
beside=
! missing zip || { zip & beside=$!; }
# With mini-gmp, an eighth of GMP, and with GMP's header for limbs of 32 bits, which Boost reads.
if missing mpfr; then
  sed 's/@GMP_LIMB_BITS@/32/; s/@GMP_NAIL_BITS@/0/; s/@DEFN_LONG_LONG_LIMB@//; s/@HAVE_HOST_CPU_FAMILY_power[a-z]*@/0/
       s/@LIBGMP_DLL@/0/; s/@CC@/emcc/; s/@CFLAGS@//' "$deps/source/gmp/gmp-h.in" >"$deps/include/gmp.h"
  cd "$deps/source/mpfr4"
  CFLAGS=$small emconfigure ./configure --quiet --host=none --build=none --disable-shared --prefix="$deps" \
    --disable-thread-safe --with-mini-gmp="$deps/source/gmp/mini-gmp" >configure.out 2>&1 ||
    fail "configure failed: $PWD/configure.out"
  emmake make -j "$(nproc)" -C src install >make.out 2>&1 || fail "make failed: $PWD/make.out"
fi
[ -z "$beside" ] || wait "$beside"

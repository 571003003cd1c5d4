#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# find_package(asperity): the build is installed somewhere, and examples/library is built against what lies there,
# with nothing of the source tree in its reach.
#
#   tests/package/library.sh BUILD SOURCE FOLDER
set -eu
build=$1
source=$2
folder=$3
. "$source/tests/scripts/runner/saying.sh"
rm -rf "$folder"
mkdir -p "$folder"
cp -R "$source/examples/library" "$folder/own"
cd "$folder"

cmake --install "$build" --prefix "$folder/installed" > output 2>&1 || { cat output; fail "it was not installed"; }
grep -rl --include='*.cmake' -e "$source" -e "$build" installed && fail "what is installed names where it was built"
grep -rlw register_bytes installed/include && fail "an installed header depends on the vector width"
(cd installed/include/asperity && grep -rhoE '^#include "[^"]+"' . | cut -d '"' -f 2 | sort -u | xargs ls > /dev/null) ||
  fail "an installed header includes one that is not installed"
ends 0 "Generating done" cmake -S own -B build -DCMAKE_PREFIX_PATH="$folder/installed" -DCMAKE_BUILD_TYPE=Release
ends 0 " press" cmake --build build
build/press > touches
cat touches
# Not a test of the physics: a percentage, and a certificate that held.
grep -qE '^[0-9]+\.[0-9]{2} % of the tile touches, to [0-9]e-(0[6-9]|1[0-9])$' touches || fail "press did not say how much touches"
# The script twin has the same digest.
ends 0 " % of the tile touches" installed/bin/asperity run --out twin own/press.lua
[ "$(grep -xE '[0-9a-f]{32}' output)" = "$(tail -n 1 touches)" ] || fail "press.lua has another digest than press.cpp"
# Another floor alone, and a version that is not there.
sed -i 's/asperity::engine/asperity::specimen/' own/CMakeLists.txt
ends 0 " press" cmake --build build
sed -i 's/asperity [0-9.]* REQUIRED/asperity 7.0 REQUIRED/' own/CMakeLists.txt
ends 1 "compatible with requested version" cmake -S own -B other -DCMAKE_PREFIX_PATH="$folder/installed"

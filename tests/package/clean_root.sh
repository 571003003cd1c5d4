#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The Debian packages in a root that holds nothing but Debian: they install with what they say they need, and there
# the program, a figure of the source paper, a lesson and the module for lua5.4 work. Needs root and mmdebstrap, and
# Debian's archive as apt knows it.
#
#   tests/package/clean_root.sh FOLDER
set -euo pipefail
cd "$(dirname -- "$0")/../.."
folder=$1
rm -rf "$folder"
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
fail() { echo "clean root: $*" >&2; exit 1; }
. tests/package/debian_root.sh

# As the tests' build is made where CI says how: what is compiled the same way twice is compiled once.
# shellcheck disable=SC2086  # a list of words
cmake --preset package ${ASPERITY_CMAKE_FLAGS:-} > /dev/null
cmake --build --preset package --parallel "$(nproc)"
cpack --preset package > "$folder/cpack.log" 2>&1 || { cat "$folder/cpack.log"; fail "the packages were not made"; }
sh tests/package/levels.sh build/package/asperity "$folder/levels"
sh tests/package/library.sh "$PWD/build/package" "$PWD" "$folder/library"

root=$folder/root
debian_root "$root"
cp build/package/packages/asperity_*.deb "$root/tmp/"
inside() { chroot "$root" "$@"; }
export LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive
inside sh -c 'apt-get install -qq -y --no-install-recommends /tmp/asperity_*.deb lua5.4' > "$folder/install.log" 2>&1 ||
  { tail -n 40 "$folder/install.log"; fail "the package does not install"; }

inside asperity version | tee "$folder/version"
grep -qxF "$(build/package/asperity version | grep vectors)" "$folder/version" || fail "the program loads another numeric library"
# As somebody who is not root, in a folder of theirs.
inside useradd --create-home visitor
visitor() { inside su - visitor -c "$*"; }
visitor asperity run /usr/share/doc/asperity/examples/paper/fig9_flattening.lua --out figure > "$folder/figure.txt" 2>&1 ||
  { cat "$folder/figure.txt"; fail "the figure failed"; }
grep -F "could not be stored" "$folder/figure.txt" && fail "its results were not kept"
tail -n 3 "$folder/figure.txt"
ls "$root"/home/visitor/figure/*.svg > /dev/null || fail "the figure drew nothing"
visitor asperity lesson tilt --run --out lesson > "$folder/lesson.txt" 2>&1 || { cat "$folder/lesson.txt"; fail "the lesson failed"; }
grep -F "expectations hold" "$folder/lesson.txt" || { cat "$folder/lesson.txt"; fail "the lesson checked nothing"; }
if [ -f build/package/page/index.html ]; then
  [ -f "$root/usr/share/asperity/page/index.html" ] || fail "the page was built and is not in the package"
fi
if [ -f build/site/index.html ]; then
  [ -f "$root/usr/share/asperity/site/index.html" ] || fail "the documents' site was built and is not in the package"
fi
said=$(visitor "lua5.4 -e 'local lab = require \"asperity\"; print(lab.surface.sine{ cells = 8, size = 1, amplitude = 2 }:roughness().amplitude)'")
[ "$said" = 4.0 ] || fail "the module in lua5.4 said $said"
visitor "lua5.4 -e 'require(\"asperity\").surface.flat{ cells = 8, size = 1 }:write \"flat.h5\"'" || fail "HDF5 from the module"
echo "clean root: all is well"

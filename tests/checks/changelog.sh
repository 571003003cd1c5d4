#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# One version everywhere: CMakeLists.txt, CITATION.cff, the page's package and its lock, the example that is built on the
# library; CHANGELOG.md begins with it.
# usage: changelog.sh [the project's folder]
set -eu
cd "${1:-$(dirname -- "$0")/../..}"

version=$(sed -n 's/^project(asperity VERSION \([0-9.]*\) .*/\1/p' CMakeLists.txt)
wrong=0
complain() { echo "$*" >&2; wrong=1; }

[ -n "$version" ] || complain "CMakeLists.txt names no version"
cited=$(sed -n 's/^version: //p' CITATION.cff)
[ "$cited" = "$version" ] || complain "CITATION.cff is of version $cited, CMakeLists.txt of $version"
for file in package.json package-lock.json; do
  named=$(sed -n -e '1,/"version":/s/^ *"version": "\([0-9.]*\)",*$/\1/p' "bindings/web/page/$file")
  [ "$named" = "$version" ] || complain "bindings/web/page/$file is of version $named, CMakeLists.txt of $version"
done
wanted=$(sed -n 's/^find_package(asperity \([0-9.]*\) .*/\1/p' examples/library/CMakeLists.txt)
[ "$wanted" = "${version%.*}" ] || complain "examples/library wants asperity $wanted, and this is version $version"
first=$(sed -n 's/^## //p' CHANGELOG.md | head -n 1)
[ "$first" = "$version" ] || complain "CHANGELOG.md begins with $first, and this is version $version"
[ $wrong = 0 ] || exit 1
echo "version $version everywhere, and CHANGELOG.md tells of it"

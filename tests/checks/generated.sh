#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The pages of docs/ that the program writes about itself are those that this program would write.
# usage: generated.sh PROGRAM [the project's folder]
set -eu
program=$(readlink -f -- "$1")
cd "${2:-$(dirname -- "$0")/../..}"

written=$(mktemp)
trap 'rm -f "$written"' EXIT
stale=0
check() {
  "$program" help "$2" >"$written"
  diff -u --label "$1 as it stands" --label "$1 as the program writes it" "$1" "$written" || {
    echo "$1 is stale: run ./lab docs"
    stale=1
  }
}
check docs/reference.md --reference
check docs/asperity.d.lua --types
check docs/asperity.1 --manual
check docs/asperity.bash --completion
[ $stale = 0 ] || exit 1
echo "the generated pages are fresh"

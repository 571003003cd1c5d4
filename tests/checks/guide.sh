#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The Lua blocks of each guide, one after the other, are a script that runs.
# usage: guide.sh PROGRAM [the project's folder]
set -eu
program=$(readlink -f -- "$1")
cd "${2:-$(dirname -- "$0")/../..}"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for guide in guide experimenter replayer; do
  awk '/^```lua$/ { on = 1; next } /^```/ { on = 0 } on' "docs/$guide.md" >"$work/$guide.lua"
  [ -s "$work/$guide.lua" ] || { echo "docs/$guide.md has no block of Lua" && exit 1; }
  "$program" run --out "$work/$guide" "$work/$guide.lua" >"$work/$guide.txt"
done
echo "the guides' blocks run"

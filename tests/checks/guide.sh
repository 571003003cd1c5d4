#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every Lua block of the tour, the card and the topic pages runs when pasted alone. The blocks of experimenter.md and replayer.md, one
# after the other, are a script that runs.
# usage: guide.sh PROGRAM [the project's folder]
set -eu
program=$(readlink -f -- "$1")
cd "${2:-$(dirname -- "$0")/../..}"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for guide in experimenter replayer; do
  awk '/^```lua$/ { on = 1; next } /^```/ { on = 0 } on' "docs/$guide.md" >"$work/$guide.lua"
  [ -s "$work/$guide.lua" ] || { echo "docs/$guide.md has no block of Lua" && exit 1; }
  "$program" run --out "$work/$guide" "$work/$guide.lua" >"$work/$guide.txt"
done
for page in tour card surfaces maps contact friction tables laws errors cost ensembles protocols runs cluster classroom security; do
  [ -f "docs/$page.md" ] || { echo "docs/$page.md is missing" && exit 1; }
  awk -v to="$work/$page" '/^```lua$/ { on = 1; n++; next } /^```/ { on = 0 } on { print > (to "-" n ".lua") }' "docs/$page.md"
  for block in "$work/$page"-*.lua; do
    [ -f "$block" ] || continue
    "$program" run --out "${block%.lua}" "$block" >"$block.txt" 2>&1 || {
      echo "docs/$page.md: its block ${block##*-} fails:"
      cat "$block.txt"
      exit 1
    }
  done
done
echo "the blocks of every page run"

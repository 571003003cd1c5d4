#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The README's first script is examples/quick_start.lua, and the output it shows is what that prints.
# usage: readme.sh PROGRAM [the project's folder]
set -eu
program=$(readlink -f -- "$1")
cd "${2:-$(dirname -- "$0")/../..}"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# block LANGUAGE: the first fenced block of that language.
block() { awk -v fence="\`\`\`$1" '$0 == fence { on = 1; next } on && /^```/ { exit } on' README.md; }

block lua >"$work/shown.lua"
sed -n '/^local lab =/,$p' examples/quick_start.lua >"$work/example.lua"
diff -u --label README.md --label examples/quick_start.lua "$work/shown.lua" "$work/example.lua"

block text >"$work/shown.txt"
"$program" run --out "$work/run" examples/quick_start.lua >"$work/output.txt"
diff -u --label README.md --label "what the script prints" "$work/shown.txt" "$work/output.txt"
# Its counts: edges of docs/stability.md, and quantities of docs/accuracy.md, whose last section is no quantity.
stands() { tr '\n' ' ' <README.md | grep -qF -- "$1" || { echo "README.md does not say: $1" && exit 1; }; }
stands "fail in silence, $(grep -c '^| \[' docs/stability.md) of them"
case $(($(grep -l '^  number = [0-9]' examples/accuracy/*.lua | wc -l) - 1)) in
  7) stands "does so for seven quantities" ;;
  *) echo "examples/accuracy has other quantities than the README counts" && exit 1 ;;
esac
echo "the README shows the script and what it prints"

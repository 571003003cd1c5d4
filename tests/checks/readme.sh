#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The README has at most 130 lines. Its first script is examples/quick_start.lua, of at most 15 lines, and prints nothing. Ra
# after the first and the last press is the one that the README states. Its script with a file prints one number.
# usage: readme.sh PROGRAM [the project's folder]
set -eu
program=$(readlink -f -- "$1")
cd "${2:-$(dirname -- "$0")/../..}"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# block LANGUAGE [K]: the first fenced block of that language, or the K-th.
block() { awk -v fence="\`\`\`$1" -v k="${2:-1}" '$0 == fence && !--k { on = 1; next } on && /^```/ { exit } on' README.md; }

block lua >"$work/shown.lua"
sed -n '/^local lab =/,$p' examples/quick_start.lua >"$work/example.lua"
diff -u --label README.md --label examples/quick_start.lua "$work/shown.lua" "$work/example.lua"

fail() { echo "$1" && exit 1; }
[ "$(wc -l <README.md)" -le 130 ] || fail "README.md has more than 130 lines"
[ "$(wc -l <"$work/shown.lua")" -le 15 ] || fail "the first script of README.md has more than 15 lines"
stands() { tr '\n' ' ' <README.md | grep -qF -- "$1" || fail "README.md does not say: $1"; }

"$program" run --out "$work/run" examples/quick_start.lua >"$work/output.txt"
[ ! -s "$work/output.txt" ] || fail "examples/quick_start.lua prints"
ra() { awk -F, -v row="$1" 'NR == row { printf "%.2f", 1e6 * $2 }' "$work/run/events.csv"; }
stands "Ra falls from $(ra 2) um after the first press to $(ra 9) um after the eighth"

# The second script, with a scan of its own.
block lua 2 >"$work/ra.lua"
printf 'local lab = require "asperity"\nlab.surface.sine{ cells=16, size="1 mm", amplitude="1 um" }:write "scan.x3p"\n' >"$work/scan.lua"
"$program" run --out "$work/scan" "$work/scan.lua" && cp "$work/scan/scan.x3p" "$work"
(cd "$work" && "$program" run --out ra ra.lua >output.txt)
grep -qE '^[0-9.]+e-0[67]$' "$work/output.txt" || fail "the script with a file does not print Ra: $(cat "$work/output.txt")"

stands "has $(grep -c '^| \[' docs/stability.md) hard cases"
echo "the README shows the script and its result"

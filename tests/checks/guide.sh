#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The Lua blocks of docs/guide.md, one after the other, are a script that runs.
# usage: guide.sh PROGRAM [the project's folder]
set -eu
program=$(readlink -f -- "$1")
cd "${2:-$(dirname -- "$0")/../..}"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
awk '/^```lua$/ { on = 1; next } /^```/ { on = 0 } on' docs/guide.md >"$work/guide.lua"
"$program" run --out "$work/run" "$work/guide.lua" >"$work/output.txt"
echo "the guide's blocks run"

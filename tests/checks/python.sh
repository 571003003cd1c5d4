#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The blocks of docs/python.md: its script runs, its Python reads that run, and prints what the page shows. Skipped
# (77) where no Python here has h5py.
# usage: python.sh PROGRAM [the project's folder]
set -eu
program=$(readlink -f -- "$1")
cd "${2:-$(dirname -- "$0")/../..}"
python=
for candidate in python3 /usr/bin/python3; do
  if $candidate -c 'import h5py' 2>/dev/null; then python=$candidate; fi
done
if [ -z "$python" ]; then
  echo "skipped: no Python here has h5py (Debian's package python3-h5py)"
  exit 77
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# block LANGUAGE: the fenced blocks of that language.
block() { awk -v fence="\`\`\`$1" '$0 == fence { on = 1; next } /^```/ { on = 0 } on' docs/python.md; }
block lua >"$work/presses.lua"
block python >"$work/read.py"
block text >"$work/shown.txt"
cd "$work"
"$program" run --out found presses.lua
$python read.py >printed.txt
diff -u --label docs/python.md --label "what its Python prints" shown.txt printed.txt
echo "the page's Python reads the page's run"

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every reader gives the values of files.txt for every file of the tests.
#
#   files.sh PROGRAM FOLDER [--write]    the program; an empty place for its run; record the values anew
set -eu
program=$(realpath "$1") place=$(realpath -m "$2")
cd "$(dirname -- "$0")/../.."
rm -rf "$place"
find examples/data tests/data tests/fuzz/corpus -type f ! -name '*.lua' | LC_ALL=C sort |
  xargs -d '\n' "$program" run --trust --out "$place" tests/guards/files.lua -- > "$place.txt" 2> "$place.err" ||
  { cat "$place.err"; exit 1; }
[ "${3:-}" != --write ] || cp "$place.txt" tests/guards/files.txt
diff tests/guards/files.txt "$place.txt" || { echo "a reader gives other values (< before, > now)"; exit 1; }
echo "$(wc -l < "$place.txt") files hold the values that they held"

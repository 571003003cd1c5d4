#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The worked example of docs/contributor.md: every block under `<!-- file: PATH -->` is laid out and compiles as that
# file of this tree would. Skipped (77) where there is no clang-format 14.
# usage: contributor.sh COMPILER [the project's folder]
set -eu
compiler=$1
cd "${2:-$(dirname -- "$0")/../..}"
clang_format=
for candidate in clang-format-14 clang-format; do
  "$candidate" --version 2>/dev/null | grep -q 'version 14\.' && clang_format=$candidate && break
done
if [ -z "$clang_format" ]; then
  echo "skipped: clang-format 14 is not installed"
  exit 77
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp .clang-format "$work"
awk -v work="$work" '
  /^<!-- file: / { path = work "/" $3; folder = path; sub(/\/[^\/]*$/, "", folder); system("mkdir -p " folder); next }
  path != "" && $0 == "```cpp" { on = 1; next }
  on && /^```/ { on = 0; close(path); path = ""; next }
  on { print > path }' docs/contributor.md
files=$(find "$work" -name '*.[ch]pp')
[ -n "$files" ] || { echo "docs/contributor.md has no file to compile" && exit 1; }
"$clang_format" --dry-run --Werror $files
for file in $(find "$work" -name '*.cpp'); do
  "$compiler" -std=c++20 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror -fsyntax-only -I"$work" -I. "$file"
done
echo "the worked example of docs/contributor.md compiles"

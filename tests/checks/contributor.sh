#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The worked examples of docs/contributor.md are laid out as the sources are; tests/contributor compiles and runs them.
# Skipped (77) where there is no clang-format 14.
# usage: contributor.sh [the project's folder]
set -eu
cd "${1:-$(dirname -- "$0")/../..}"
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
tests/contributor/extract.sh "$work" "$PWD"
files=$(find "$work" -name '*.[ch]pp')
[ -n "$files" ] || { echo "docs/contributor.md has no worked example" && exit 1; }
"$clang_format" --dry-run --Werror $files
echo "the worked examples of docs/contributor.md are laid out as .clang-format says"

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every C++ file is laid out as .clang-format says, by the version whose taste the tree was laid out
# with: another one breaks lines elsewhere, so there the check is skipped (exit status 77).
# usage: format.sh [the project's folder]
set -eu
cd "${1:-$(dirname -- "$0")/../..}"

for clang_format in clang-format-14 clang-format; do
  "$clang_format" --version 2>/dev/null | grep -q 'version 14\.' && break
  clang_format=
done
if [ -z "$clang_format" ]; then
  echo "skipped: clang-format 14 is not installed"
  exit 77
fi
find engine bindings tests bench \( -name '*.cpp' -o -name '*.hpp' \) -print0 |
  xargs -0 "$clang_format" --dry-run --Werror
echo "every C++ file is laid out as .clang-format says"

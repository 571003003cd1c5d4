#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The worked examples of docs/contributor.md as files: a block of C++ under `<!-- file: PATH -->` becomes that file below
# FOLDER, and one under `<!-- row: PATH -->` a row at the end of the first table or list of that source.
# usage: extract.sh FOLDER [the project's folder]
set -eu
folder=$1
cd "${2:-$(dirname -- "$0")/../..}"
mkdir -p "$folder"
awk -v folder="$folder" '
  /^<!-- (file|row): / {
    path = $3
    is_row = $2 == "row:"
    target = folder "/" path (is_row ? ".row" : "")
    place = target
    sub(/\/[^\/]*$/, "", place)
    system("mkdir -p " place)
    next
  }
  path != "" && $0 == "```cpp" { on = 1; next }
  on && /^```/ { on = 0; close(target); path = ""; next }
  on { print > target }' docs/contributor.md
find "$folder" -name '*.row' | while read -r row; do
  path=${row#"$folder"/}
  path=${path%.row}
  end='^};$'
  grep -q 'end of the list' "$path" && end='end of the list'
  awk -v row="$row" -v end="$end" '
    $0 ~ end && !done { while ((getline line < row) > 0) print line; done = 1 }
    { print }' "$path" > "$folder/$path"
  rm "$row"
done

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The numbers of docs/teacher.md are those of the lessons: every line of a block under `<!-- lesson: NAME -->` is a
# line that `asperity lesson NAME --run` prints, or where it begins or ends with "…" the end or beginning of one, or between
# the two a part of one.
# usage: teacher.sh PROGRAM [the project's folder]
set -eu
program=$(readlink -f -- "$1")
cd "${2:-$(dirname -- "$0")/../..}"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
awk -v work="$work" '
  /^<!-- lesson: / { name = $3; next }
  name != "" && $0 == "```text" { on = 1; next }
  on && /^```/ { on = 0; name = ""; next }
  on { print > (work "/" name ".txt") }' docs/teacher.md
stale=0 count=0
for shown in "$work"/*.txt; do
  name=$(basename "$shown" .txt)
  "$program" lesson "$name" --run --out "$work/$name" >"$work/$name.out"
  count=$((count + 1))
  while IFS= read -r line; do
    part=${line#… }
    part=${part% …}
    awk -v line="$line" -v part="$part" '
      BEGIN { from = line ~ /^… /; to = line ~ / …$/ }
      { at = index($0, part) }
      at && (from || at == 1) && (to || substr($0, length($0) - length(part) + 1) == part) { found = 1 }
      END { exit !found }' "$work/$name.out" || {
      echo "docs/teacher.md says of the lesson $name, and it does not print: $line"
      stale=1
    }
  done <"$shown"
done
lessons=$(find scripts/lessons -name '*.lua' | wc -l)
[ "$count" = "$lessons" ] || { echo "docs/teacher.md has the numbers of $count lessons, and there are $lessons" && stale=1; }
[ $stale = 0 ] || exit 1
echo "the teacher's page shows what the lessons print"

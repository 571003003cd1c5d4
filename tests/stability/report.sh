#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Writes docs/stability.md and its charts from the hard cases of tests/stability/cases.
# usage: report.sh PROGRAM                run every case, then write the page (PROGRAM, or a folder it was built in)
#        report.sh --check RUNS [FOLDER]  does docs/stability.md of the project's FOLDER say what the runs found?
# A page of another machine may differ by rounding: numbers of 1e-9 and less, and any by a factor of four (iterations of a solve to the last digit).
set -eu
here=$(dirname -- "$(readlink -f -- "$0")")

# page RUNS: the page from the parts that the runs have left, in the order of their numbers.
page() {
  cat "$here/page.md"
  printf '\n| case | edge swept | worst error, or refusal | verdict |\n| --- | --- | --- | --- |\n'
  cat "$1"/*/row.md | sort -n | sed 's/^[0-9]*//'
  for row in "$1"/*/row.md; do
    printf '%s %s\n' "$(sed 's/|.*//' "$row")" "$(dirname -- "$row")"
  done | sort -n | while read -r number folder; do
    printf '\n'
    cat "$folder/section.md"
  done
  printf '\n'
  cat "$here/found.md"
}

# The same text, and the same numbers but for rounding.
agree() {
  awk -v other="$2" '
    function words(line) { gsub(/[0-9.]+(e[-+]?[0-9]+)?/, "#", line); return line }
    function near(a, b,   most) {
      if (a == b) return 1
      a += 0; b += 0; if (a < 0) a = -a; if (b < 0) b = -b
      most = a > b ? a : b
      if (most < 1.01e-9 && (a == 0 || a > 1e-25) && (b == 0 || b > 1e-25)) return 1
      return (a > b ? a - b : b - a) <= 0.75 * most
    }
    {
      mine = $0
      if ((getline theirs < other) <= 0) { bad = 1; exit }
      if (mine == theirs) next
      if (words(mine) != words(theirs)) { print "< " mine "\n> " theirs; bad = 1; exit }
      while (match(mine, /[0-9.]+(e[-+]?[0-9]+)?/)) {
        a = substr(mine, RSTART, RLENGTH); mine = substr(mine, RSTART + RLENGTH)
        match(theirs, /[0-9.]+(e[-+]?[0-9]+)?/)
        b = substr(theirs, RSTART, RLENGTH); theirs = substr(theirs, RSTART + RLENGTH)
        if (!near(a, b)) { print "line " NR ": " a " and " b " in\n> " $0; bad = 1 }
      }
    }
    END { if (!bad && (getline theirs < other) > 0) bad = 1; exit bad }' "$1"
}

if [ "${1:-}" = --check ]; then
  runs=$2
  project=${3:-$here/../..}
  page "$runs" >"$runs/stability.md"
  for chart in "$runs"/*/*.svg; do
    [ -f "$project/docs/pictures/stability/$(basename -- "$chart")" ] || {
      echo "docs/pictures/stability/$(basename -- "$chart") is missing: run tests/stability/report.sh PROGRAM"
      exit 1
    }
  done
  if cmp -s "$runs/stability.md" "$project/docs/stability.md"; then
    echo "docs/stability.md is what these runs write"
  elif agree "$runs/stability.md" "$project/docs/stability.md"; then
    echo "docs/stability.md is what these runs write, but for rounding"
  else
    echo "docs/stability.md is stale: run tests/stability/report.sh PROGRAM"
    exit 1
  fi
  exit
fi

[ $# = 1 ] || {
  echo "usage: report.sh PROGRAM" >&2
  exit 2
}
program=$(readlink -f -- "$1")
[ ! -d "$program" ] || program=$program/asperity
runs=$(mktemp -d)
trap 'rm -rf "$runs"' EXIT
cd "$here/../.."
failed=0
for script in tests/stability/cases/*.lua; do
  name=$(basename -- "$script" .lua)
  sh "$here/run_case.sh" "$program" "$script" "$runs/$name" >"$runs/$name.output" 2>&1 || {
    echo "$name fails:"
    cat "$runs/$name.output"
    failed=1
  }
done
mkdir -p docs/pictures/stability
rm -f docs/pictures/stability/*.svg
cp "$runs"/*/*.svg docs/pictures/stability/
page "$runs" >docs/stability.md
echo "docs/stability.md and docs/pictures/stability are written"
exit $failed

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Writes docs/stability.md, docs/stability/ and their charts from the hard cases of tests/stability/cases.
# usage: report.sh PROGRAM                run every case, then write the pages (PROGRAM, or its build folder)
#        report.sh --check RUNS [FOLDER]  compare the pages of the project's FOLDER with the runs
# Pages of another machine may differ by rounding: numbers of 1e-9 and less, and any by a factor of four (iterations of a
# solve to the last digit).
set -eu
here=$(dirname -- "$(readlink -f -- "$0")")

# pages RUNS FOLDER: the table stability.md and a page of each case, stability/NAME.md, into the folder.
pages() {
  mkdir -p "$2/stability"
  {
    cat "$here/page.md"
    printf '\n| case | edge swept | worst error, or refusal | verdict |\n| --- | --- | --- | --- |\n'
    cat "$1"/*/row.md | sort -n | sed 's/^[0-9]*//'
  } >"$2/stability.md"
  for page in "$1"/*/page.md; do
    cp "$page" "$2/stability/$(basename -- "$(dirname -- "$page")").md"
  done
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
  written=$(mktemp -d)
  trap 'rm -rf "$written"' EXIT
  pages "$runs" "$written"
  for chart in "$runs"/*/*.svg; do
    [ -f "$project/docs/pictures/stability/$(basename -- "$chart")" ] || {
      echo "docs/pictures/stability/$(basename -- "$chart") is missing: run tests/stability/report.sh PROGRAM"
      exit 1
    }
  done
  stale=0
  for page in stability.md $(cd "$written" && echo stability/*.md); do
    if [ ! -f "$project/docs/$page" ] || { ! cmp -s "$written/$page" "$project/docs/$page" &&
      ! agree "$written/$page" "$project/docs/$page"; }; then
      echo "docs/$page is stale: run tests/stability/report.sh PROGRAM"
      stale=1
    fi
  done
  exit "$stale"
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
find docs/stability -name '*.md' ! -name found.md ! -name random_scenes.md -delete
pages "$runs" docs
echo "docs/stability.md, docs/stability and docs/pictures/stability are written"
exit $failed

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Writes docs/accuracy.md and its charts from the studies of examples/accuracy, in half a minute on a machine
# that does nothing else.
# usage: report.sh PROGRAM          run every study, then write the page (PROGRAM, or a folder it was built in)
#        report.sh --check FOLDER   does the page of the project's FOLDER have a part and a chart of every study?
set -eu
here=$(dirname -- "$(readlink -f -- "$0")")

if [ "${1:-}" = --check ]; then
  status=0
  for script in "$2"/examples/accuracy/*.lua; do
    name=$(basename -- "$script" .lua)
    grep -qF "Script: \`examples/accuracy/$name.lua\`." "$2/docs/accuracy.md" && continue
    echo "docs/accuracy.md has no part of examples/accuracy/$name.lua: run examples/accuracy/report.sh PROGRAM"
    status=1
  done
  for chart in $(sed -n 's/.*](\(pictures\/accuracy\/[a-z_]*\.svg\)).*/\1/p' "$2/docs/accuracy.md"); do
    [ -f "$2/docs/$chart" ] && continue
    echo "docs/$chart is missing: run examples/accuracy/report.sh PROGRAM"
    status=1
  done
  exit $status
fi

[ $# = 1 ] || { echo "usage: report.sh PROGRAM" >&2; exit 2; }
program=$(readlink -f -- "$1")
[ ! -d "$program" ] || program=$program/asperity
runs=$(mktemp -d)
trap 'rm -rf "$runs"' EXIT
cd "$here/../.."
for script in examples/accuracy/*.lua; do
  name=$(basename -- "$script" .lua)
  echo "$name" >&2
  case $name in
    contact_area) finer=finest=2048 ;;
    plastic_volume) finer=finest=512 ;;
    cells_or_seeds) finer=faces=64 ;;
    *) finer= ;;
  esac
  "$program" run --out "$runs/$name" "$script" -- budget=120 $finer >"$runs/$name.output" || {
    cat "$runs/$name.output" >&2
    exit 1
  }
done
mkdir -p docs/pictures/accuracy
rm -f docs/pictures/accuracy/*.svg
cp "$runs"/*/*.svg docs/pictures/accuracy/
{
  # The text, with table N of the output of cells_or_seeds for the line "(table N)"; the first one as Markdown.
  awk 'function cells(line) {
      gsub(/bound \[%\]/, "bound_[%]", line); gsub(/one face/, "one_face", line); gsub(/the recipe/, "the_recipe", line)
      gsub(/ +/, " | ", line); gsub(/_/, " ", line)
      return substr(line, 2) " |\n" (rows++ ? "" : "|---:|---|---:|---:|---:|---:|---:|\n") }
    FNR == NR { if (/^the notebook: /) n++; else if (/^  /) { sub(/ +$/, ""); table[n] = table[n] (n == 1 ? cells($0) : $0 "\n") }; next }
    /^\(table [0-9]\)$/ { $0 = $2 == "1)" ? substr(table[1], 1, length(table[1]) - 1) : "```\n" table[$2 + 0] "```" }
    { print }' "$runs/cells_or_seeds.output" "$here/page.md"
  printf '\nMachine: %s, %s processors; %s; %s.\n' \
    "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)" "$(nproc)" \
    "$("$program" version | head -n 1 | tr -s ' ')" "$(date -u +%Y-%m-%d)"
  for section in "$runs"/*/section_*.md; do
    printf '%s %s\n' "$(basename -- "$section")" "$section"
  done | sort | while read -r _ section; do
    printf '\n'
    cat "$section"
  done
} >docs/accuracy.md
echo "docs/accuracy.md and docs/pictures/accuracy are written"

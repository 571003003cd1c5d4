#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The reasons of the lessons quote the results of the lessons, also after the changes they propose. checks:teacher tests the
# numbers of docs/teacher.md.
set -eu
. "$(dirname "$0")/beginning.sh"
lessons=$root/scripts/lessons
docs=$root/docs
! grep -n "section of a hair" "$lessons"/04_*.lua || fail "a hundredth of a hair"
! grep -n "What is not higher, or not elsewhere" "$lessons"/08_*.lua || fail "lesson 8"
! grep -n "more red" "$docs/teacher.md" || fail "the colours of the page"
! grep -n "my_guess.*or \"nothing\"" "$lessons"/*.lua || fail "guesses that were not made"
# Theory between 1.6 and 2.5 and what is found here between them, in the text and in the chart alike.
"$program" run "$lessons"/04_*.lua --out four > output 2>&1
says "2.5 (that of Bush, Gibson and Thomas); here it is 2.4" output
for turned_at in 66 130; do
  grep -q "^local turned_at = " "$lessons"/08_*.lua || fail "lesson 8 has no turned_at"
  mkdir "turned-$turned_at"
  sed "s/^local turned_at = [0-9]*/local turned_at = $turned_at/" "$lessons"/08_*.lua > "turned-$turned_at/lesson.lua"
  "$program" run "turned-$turned_at/lesson.lua" --out "turned-$turned_at/run" > output 2>&1 ||
    { cat output; fail "lesson 8, turned at $turned_at"; }
  ! grep "no row matches" output || fail "lesson 8, turned at $turned_at"
done
for third in 20 99.9 100 110 140; do
  "$program" run --knob third="$third kN" "$lessons"/08_*.lua --out "third-$third" > output 2>&1 ||
    { cat output; fail "lesson 8, third hold of $third kN"; }
done
for change in 06:alpha=0 07:within=0.01 09:cut=0 09:cut=0.4 09:cut=0.7; do
  "$program" run --knob "${change#*:}" "$lessons"/"${change%%:*}"_*.lua --out "$change" > output 2>&1 ||
    { cat output; fail "lesson $change"; }
done

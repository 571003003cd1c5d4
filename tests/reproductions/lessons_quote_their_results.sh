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
for change in "third = 110" "turned_at = 66" "turned_at = 130"; do
  name=${change%% *}
  grep -q "$name = " "$lessons"/08_*.lua || fail "lesson 8 has no $name"
  mkdir "$name-${change##* }"
  sed "s/\\b$name = [0-9]*/$change/" "$lessons"/08_*.lua > "$name-${change##* }/lesson.lua"
  "$program" run "$name-${change##* }/lesson.lua" --out "$name-${change##* }/run" > output 2>&1 ||
    { cat output; fail "lesson 8, $change"; }
  ! grep "no row matches" output || fail "lesson 8, $change"
done

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A guess under a name that the lesson does not ask for was compared with nothing, and nobody was told: in each lesson whose
# guess is a table it is an error before anything is computed, which names the key and those there are.
set -eu
. "$(dirname "$0")/beginning.sh"
tables=0
for lesson in "$root"/scripts/lessons/*.lua; do
  keys=$(sed -n 's/^local my_guess = { \(.*\) }.*/\1/p' "$lesson")
  [ -n "$keys" ] || continue
  tables=$((tables + 1))
  first=${keys%%=*}
  for command in check run; do
    for wrong in "${first}s=1" "1"; do
      sed "s/^\(local my_guess = { \).* }/\1$wrong }/" "$lesson" > lesson.lua
      set --
      [ $command = check ] || set -- --out "out$tables-$wrong"
      ! "$program" $command "$@" lesson.lua > output 2>&1 || { cat output; fail "$command of $lesson with $wrong"; }
      case $wrong in 1) told='`[1]`' ;; *) told="\`${first}s\`" ;; esac
      says "my_guess has $told, which the lesson does not ask for; its names are $first and " output
      ! grep "^You said" output || fail "$lesson went on"
    done
    sed 's/^local my_guess = {.*}/local my_guess = 5/' "$lesson" > lesson.lua
    ! "$program" check lesson.lua > output 2>&1 || fail "a number for $lesson"
    says "my_guess is 5; give its values by name, as in { $first=nil, " output
  done
  # As the page writes them.
  choice=$(sed -n 's/^guess.choices(my_guess, \("[^"]*"\).*/\1/p' "$lesson")
  sed "s/^\(local my_guess = { \)$first=nil/\1$first=${choice:-0.5}/" "$lesson" > lesson.lua
  grep -q "$first=${choice:-0.5}" lesson.lua || fail "$lesson was not changed"
  "$program" check lesson.lua > output 2>&1 || { cat output; fail "check of $lesson with a guess"; }
done
[ $tables = 7 ] || fail "$tables lessons have tables, and seven were looked for"
choices=0
for lesson in $(grep -l "^guess.choices(" "$root"/scripts/lessons/*.lua); do
  choices=$((choices + 1))
  sed 's/=nil/="mroe"/; s/^local my_guess = nil/local my_guess = "mroe"/' "$lesson" > lesson.lua
  ! "$program" check lesson.lua > output 2>&1 || fail "an unknown choice for $lesson"
  says 'my_guess is `mroe`; choose one of "' output
done
[ $choices = 5 ] || fail "$choices lessons have choices, and five were looked for"

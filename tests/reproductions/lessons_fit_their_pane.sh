#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Lessons are at most 72 columns wide, the width of their pane. Each paragraph of their reasons is printed as one line,
# which the reader's window wraps.
set -eu
. "$(dirname "$0")/beginning.sh"
wide=$(awk 'length > 72 { print FILENAME ":" FNR ": " length }' "$root"/scripts/lessons/*.lua)
[ -z "$wide" ] || fail "lessons are wider than 72 columns: $wide"
"$program" lesson real_area --run > printed 2> /dev/null
says "Why: " printed
! grep "^Why: .\{0,400\}$" printed || fail "a paragraph is not one line"
[ "$(grep -c "^And that is why friction .*Bowden and Tabor's\.$" printed)" = 1 ] || fail "the last paragraph is not one line"

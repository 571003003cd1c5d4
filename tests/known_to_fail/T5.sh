#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# T5: lessons are up to 120 columns wide in a pane of 45 to 70. Wanted: code of at most 72 columns, and prose printed as one
# line a paragraph. The work on the page that is alive owns it.
set -eu
. "$(dirname "$0")/../reproductions/beginning.sh"
wide=$(cat "$root"/scripts/lessons/*.lua | awk 'length > 72' | wc -l)
claim() { if [ "$2" = 0 ]; then echo "holds: $1"; else echo "does not hold: $1 ($2)"; fi; }
claim "lessons fit 72 columns" "$wide"
"$program" lesson real_area --run > printed 2> /dev/null
says "Why: " printed
claim "a paragraph is a line" "$(grep -c "^Why: .\{0,120\}$" printed)"

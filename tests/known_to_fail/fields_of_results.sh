#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Fields of results that nothing documents: those of roughness, raise, fractal_dimension, law:on, lab.exact and tip_effect
# are "table" in reference, help and editor. Wanted: each with its dimension and a sentence, from one list, in completion
# too. The work on the house owns it.
set -eu
. "$(dirname "$0")/../reproductions/beginning.sh"
"$program" help --types > types
claim() { if [ "$2" = 0 ]; then echo "holds: $1"; else echo "does not hold: $1 ($2)"; fi; }
for call in roughness raise fractal_dimension on hertz; do
  grep -q "function [A-Za-z_.:]*[.:]$call(" types || { echo "no $call"; exit 1; }
  tables=$(awk -v call="[.:]$call[(]" '
    /^---/ { if (/@return/) last = $2; next }
    $0 ~ call && last == "table" { n++ }
    END { print n + 0 }' types)
  claim "the result of $call has a type" "$tables"
done

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Fields of results that nothing documented: those of roughness, raise, fractal_dimension, law:on, lab.exact and tip_effect
# were "table" in reference, help and editor. Wanted: each with its dimension and a sentence, from one list.
set -eu
. "$(dirname "$0")/beginning.sh"
"$program" help --types > types
for call in roughness raise fractal_dimension on hertz; do
  grep -q "function [A-Za-z_.:]*[.:]$call(" types || { echo "no $call"; exit 1; }
  tables=$(awk -v call="[.:]$call[(]" '
    /^---/ { if (/@return/) last = $2; next }
    $0 ~ call && last == "table" { n++ }
    END { print n + 0 }' types)
  [ "$tables" = 0 ] || { echo "the result of $call is a table without a type"; exit 1; }
done

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# If gnuplot lacks the handles to open its fonts, the picture is the same or a warning appears.
set -eu
. "$(dirname "$0")/beginning.sh"
command -v gnuplot > /dev/null 2>&1 || skip "there is no gnuplot"
cat > s.lua <<'LUA'
require "asperity".surface.sine{ cells=16, size=1e-3, amplitude=1e-6 }:picture("r.png", { view="relief" })
LUA
"$program" run s.lua --out plain 2> /dev/null
for handles in $(whole "3 4 5 6 7 8 9 10 12 16 20" "6 8"); do
  status=0
  (ulimit -n $handles; "$program" run --threads 1 --out fs-$handles s.lua) > output 2>&1 || status=$?
  [ $status != 0 ] || cmp -s plain/r.png fs-$handles/r.png || says gnuplot output
done
